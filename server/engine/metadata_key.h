// The metadata that a collection declares: keys whose values have a type and
// can be filtered by.
//
// Metadata is text. A value of a declared key must read as one of its type:
//   STRING  any text, compared byte by byte
//   NUMBER  a finite decimal number such as 3, -0.5 or 1e6
//   BOOL    true or false
// Metadata of other keys is stored and answered, but not typed nor indexed.
#ifndef ARGMESH_SERVER_ENGINE_METADATA_KEY_H_
#define ARGMESH_SERVER_ENGINE_METADATA_KEY_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "absl/status/status.h"

namespace argmesh {

enum class MetadataType { kString = 1, kNumber = 2, kBool = 3 };

struct MetadataKey {
  std::string key;
  MetadataType type = MetadataType::kString;

  friend bool operator==(const MetadataKey&, const MetadataKey&) = default;
};

// Text, number or bool, in the order of MetadataType.
using MetadataValue = std::variant<std::string, double, bool>;

inline constexpr size_t kMaxMetadataKeys = 32;  // of a collection

// "STRING"
std::string_view MetadataTypeName(MetadataType type);

// None when `text` is no value of the type.
std::optional<MetadataValue> ReadMetadataValue(MetadataType type,
                                               std::string_view text);

// Null when it is not declared.
const MetadataKey* FindMetadataKey(const std::vector<MetadataKey>& keys,
                                   std::string_view key);

// FIELD_INVALID: too many, one twice, empty, too long or not UTF-8.
absl::Status CheckMetadataKeys(const std::vector<MetadataKey>& keys);

// FIELD_INVALID: the value of a declared key has not its type.
absl::Status CheckDeclaredValues(
    const std::vector<MetadataKey>& keys,
    const std::map<std::string, std::string>& metadata);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_METADATA_KEY_H_
