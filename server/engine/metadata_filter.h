// Filters over declared metadata: a subset of AIP-160.
//
//   filter      = [ conjunction ]                  empty: everything
//   conjunction = disjunction { "AND" disjunction }
//   disjunction = negation { "OR" negation }       binds tighter than AND
//   negation    = [ "NOT" | "-" ] primary
//   primary     = "(" conjunction ")" | term
//   term        = key ( "=" | "!=" | "<" | "<=" | ">" | ">=" | ":" ) value
//               | key ":*"                         the key is there
//   key, value  = word | string
//   word        = letters, digits, any character beyond ASCII, _ . - + / @ # %
//   string      = "…" or '…'; a backslash takes the next character as it is
//
// a:v is a = v. Values are read as the type of the key: text is ordered byte by
// byte, a BOOL has no order. A term about a key that a shape has not is false,
// `!=` too; NOT of it is true.
//
// Fails    kInvalidArgument FILTER_INVALID  with metadata `field`, `position`
//          (bytes before the place) and what was expected there; also beyond
//          the limits below
//          kInvalidArgument FILTER_KEY_UNDECLARED  and `key`
// Thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_METADATA_FILTER_H_
#define ARGMESH_SERVER_ENGINE_METADATA_FILTER_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "server/engine/metadata_key.h"

namespace argmesh {

inline constexpr size_t kMaxFilterBytes = 4096;
inline constexpr int kMaxFilterTerms = 64;
inline constexpr int kMaxFilterDepth = 16;  // parentheses within each other

enum class FilterOperator {
  kEqual,
  kNotEqual,
  kLess,
  kLessOrEqual,
  kGreater,
  kGreaterOrEqual,
  kPresent,
};

struct FilterTerm {
  MetadataKey key;
  FilterOperator op = FilterOperator::kEqual;
  MetadataValue value;  // of the key's type; nothing for kPresent
};

struct FilterNode {
  enum class Kind { kAnd, kOr, kNot, kTerm };
  Kind kind = Kind::kTerm;
  std::vector<FilterNode> children;  // one for kNot, none for kTerm
  FilterTerm term;
};

class MetadataFilter {
 public:
  static absl::StatusOr<MetadataFilter> Parse(
      std::string_view filter, const std::vector<MetadataKey>& keys);

  MetadataFilter() = default;  // everything
  explicit MetadataFilter(FilterNode root) : root_(std::move(root)) {}

  bool Matches(const std::map<std::string, std::string>& metadata) const;

  // None: everything.
  const std::optional<FilterNode>& root() const { return root_; }

 private:
  std::optional<FilterNode> root_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_METADATA_FILTER_H_
