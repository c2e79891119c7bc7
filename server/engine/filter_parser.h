// The recursive descent parser of MetadataFilter, which has the grammar and the
// errors.
#ifndef ARGMESH_SERVER_ENGINE_FILTER_PARSER_H_
#define ARGMESH_SERVER_ENGINE_FILTER_PARSER_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/metadata_filter.h"

namespace argmesh {

// For one Parse.
class FilterParser {
 public:
  // Both must outlive it.
  FilterParser(std::string_view text, const std::vector<MetadataKey>& keys)
      : text_(text), keys_(keys) {}

  // None for a text of nothing but spaces.
  absl::StatusOr<std::optional<FilterNode>> Parse();

 private:
  absl::StatusOr<FilterNode> Conjunction();
  absl::StatusOr<FilterNode> Disjunction();
  absl::StatusOr<FilterNode> Negation();
  absl::StatusOr<FilterNode> Primary();
  absl::StatusOr<FilterNode> Term();
  absl::Status ReadOperatorAndValue(FilterTerm& term);
  absl::StatusOr<FilterOperator> Operator(const MetadataKey& key);
  absl::StatusOr<std::string> Text(std::string_view expected);
  absl::StatusOr<std::string> Quoted();

  // Joins what `next` reads, as long as `keyword` follows.
  template <typename Next>
  absl::StatusOr<FilterNode> Joined(FilterNode::Kind kind,
                                    std::string_view keyword, const Next& next);

  void SkipSpaces();
  bool Take(std::string_view symbol);
  bool TakeKeyword(std::string_view keyword);
  std::string_view PeekWord() const;
  absl::Status Expected(std::string_view what) const;
  absl::Status Invalid(size_t position, const std::string& why) const;

  const std::string_view text_;
  const std::vector<MetadataKey>& keys_;
  size_t at_ = 0;
  int depth_ = 0;
  int terms_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_FILTER_PARSER_H_
