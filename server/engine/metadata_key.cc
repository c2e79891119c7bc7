#include "server/engine/metadata_key.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/numbers.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/request_rules.h"

namespace argmesh {
namespace {

absl::Status KeysInvalid(const std::string& why) {
  return MakeError(ErrorReason::kFieldInvalid, "metadata_keys " + why,
                   {{"field", "metadata_keys"}});
}

std::optional<MetadataValue> ReadNumber(std::string_view text) {
  // SimpleAtod also takes spaces, infinities and hexadecimals.
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) {
    return std::nullopt;
  }
  double number = 0;
  const bool read =
      absl::SimpleAtod(absl::string_view(text.data(), text.size()), &number);
  if (!read || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace

std::string_view MetadataTypeName(MetadataType type) {
  switch (type) {
    case MetadataType::kString:
      return "STRING";
    case MetadataType::kNumber:
      return "NUMBER";
    case MetadataType::kBool:
      return "BOOL";
  }
  return "UNKNOWN";
}

std::optional<MetadataValue> ReadMetadataValue(MetadataType type,
                                               std::string_view text) {
  switch (type) {
    case MetadataType::kString:
      return std::string(text);
    case MetadataType::kNumber:
      return ReadNumber(text);
    case MetadataType::kBool:
      if (text == "true") return true;
      if (text == "false") return false;
  }
  return std::nullopt;
}

const MetadataKey* FindMetadataKey(const std::vector<MetadataKey>& keys,
                                   std::string_view key) {
  const auto found =
      std::find_if(keys.begin(), keys.end(),
                   [key](const MetadataKey& k) { return k.key == key; });
  return found == keys.end() ? nullptr : &*found;
}

absl::Status CheckMetadataKeys(const std::vector<MetadataKey>& keys) {
  if (keys.size() > kMaxMetadataKeys) {
    return KeysInvalid(absl::StrFormat("has %d keys, more than %d", keys.size(),
                                       kMaxMetadataKeys));
  }
  for (const MetadataKey& key : keys) {
    if (key.key.empty()) return KeysInvalid("has an empty key");
    ARGMESH_RETURN_IF_ERROR(
        CheckText("metadata_keys", key.key, kMaxMetadataKeyBytes));
    if (FindMetadataKey(keys, key.key) != &key) {
      return KeysInvalid("has \"" + key.key + "\" twice");
    }
  }
  return absl::OkStatus();
}

absl::Status CheckDeclaredValues(
    const std::vector<MetadataKey>& keys,
    const std::map<std::string, std::string>& metadata) {
  for (const MetadataKey& key : keys) {
    const auto entry = metadata.find(key.key);
    if (entry == metadata.end() || ReadMetadataValue(key.type, entry->second)) {
      continue;
    }
    return MakeError(
        ErrorReason::kFieldInvalid,
        absl::StrFormat("metadata \"%s\" is \"%.100s\", but the collection "
                        "declares it a %s",
                        key.key, entry->second,
                        std::string(MetadataTypeName(key.type))),
        {{"field", "metadata"}, {"key", key.key}});
  }
  return absl::OkStatus();
}

}  // namespace argmesh
