#include "core/access/key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_format.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kDigestDigits = 64;
constexpr mode_t kOwnerOnly = 0600;

absl::Status Invalid(std::string_view where, std::string_view why) {
  return absl::InvalidArgumentError(
      absl::StrFormat("%s: %s", std::string(where), std::string(why)));
}

absl::Status FileFailure(std::string_view what, const std::string& path) {
  const std::string why = std::system_category().message(errno);
  return errno == ENOENT
             ? absl::NotFoundError(absl::StrFormat("%s: %s", path, why))
             : absl::UnavailableError(absl::StrFormat(
                   "cannot %s %s: %s", std::string(what), path, why));
}

absl::StatusOr<std::string> TextOf(const Json& key, const char* field,
                                   const std::string& where) {
  const auto it = key.find(field);
  if (it == key.end() || !it->is_string()) {
    return Invalid(where, std::string("field ") + field + " is not a text");
  }
  return it->get<std::string>();
}

absl::StatusOr<absl::Time> TimeOf(const Json& key, const char* field,
                                  const std::string& where) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text, TextOf(key, field, where));
  absl::Time time;
  std::string error;
  if (!absl::ParseTime(absl::RFC3339_full, text, &time, &error)) {
    return Invalid(
        where, std::string(field) + " \"" + text + "\" is no RFC 3339 time");
  }
  return time;
}

absl::StatusOr<Sha256Digest> DigestOf(const Json& key,
                                      const std::string& where) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           TextOf(key, "sha256", where));
  if (text.size() != kDigestDigits ||
      text.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return Invalid(where, "sha256 is not 64 hexadecimal digits");
  }
  const std::string bytes = absl::HexStringToBytes(text);
  Sha256Digest digest;
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

absl::StatusOr<std::vector<std::string>> CollectionsOf(
    const Json& key, const std::string& where) {
  const auto it = key.find("collections");
  if (it == key.end()) return std::vector<std::string>();
  // An empty list would read like "none" and mean "all".
  if (!it->is_array() || it->empty()) {
    return Invalid(where, "collections is no list of at least one id");
  }
  std::vector<std::string> collections;
  for (const Json& item : *it) {
    if (!item.is_string() || !IsIdentifier(item.get<std::string>())) {
      return Invalid(where, "collections has " + item.dump() +
                                ", which is no collection id");
    }
    collections.push_back(item.get<std::string>());
  }
  return collections;
}

absl::Status CheckFields(const Json& object,
                         const std::vector<std::string>& known,
                         const std::string& where) {
  if (!object.is_object()) return Invalid(where, "is no object");
  for (const auto& [name, value] : object.items()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return Invalid(where, "unknown field \"" + name + "\"");
    }
  }
  return absl::OkStatus();
}

// A whole number; `limit` is 0 where the field is missing.
absl::Status ReadCount(const Json& key, const char* field,
                       const std::string& where, int& limit) {
  const auto it = key.find(field);
  if (it == key.end()) return absl::OkStatus();
  if (!it->is_number_integer() || it->get<int64_t>() < 0 ||
      it->get<int64_t>() > kMaxKeyCalls) {
    return Invalid(where, absl::StrFormat("%s is no whole number up to %d",
                                          field, kMaxKeyCalls));
  }
  limit = it->get<int>();
  return absl::OkStatus();
}

absl::StatusOr<KeyLimits> LimitsOf(const Json& key, const std::string& where) {
  KeyLimits limits;
  if (const auto rate = key.find("requests_per_second"); rate != key.end()) {
    if (!rate->is_number()) {
      return Invalid(where, "requests_per_second is no number");
    }
    limits.requests_per_second = rate->get<double>();
  }
  ARGMESH_RETURN_IF_ERROR(ReadCount(key, "burst", where, limits.burst));
  ARGMESH_RETURN_IF_ERROR(
      ReadCount(key, "concurrent_calls", where, limits.concurrent_calls));
  if (const absl::Status status = CheckKeyLimits(limits); !status.ok()) {
    return Invalid(where, std::string(status.message()));
  }
  return limits;
}

absl::StatusOr<ApiKey> KeyOf(const Json& json, size_t index) {
  std::string where = absl::StrFormat("key %d", index + 1);
  ARGMESH_RETURN_IF_ERROR(
      CheckFields(json,
                  {"id", "sha256", "role", "collections", "requests_per_second",
                   "burst", "concurrent_calls", "create_time", "expire_time"},
                  where));
  ApiKey key;
  ARGMESH_ASSIGN_OR_RETURN(key.id, TextOf(json, "id", where));
  if (!IsIdentifier(key.id)) {
    return Invalid(where, "id \"" + key.id + "\" is no id");
  }
  where = "key \"" + key.id + "\"";
  ARGMESH_ASSIGN_OR_RETURN(key.secret_sha256, DigestOf(json, where));
  ARGMESH_ASSIGN_OR_RETURN(const std::string role, TextOf(json, "role", where));
  const absl::StatusOr<AccessRole> parsed = ParseAccessRole(role);
  if (!parsed.ok()) {
    return Invalid(where, std::string(parsed.status().message()));
  }
  key.role = *parsed;
  ARGMESH_ASSIGN_OR_RETURN(key.collections, CollectionsOf(json, where));
  ARGMESH_ASSIGN_OR_RETURN(key.limits, LimitsOf(json, where));
  ARGMESH_ASSIGN_OR_RETURN(key.create_time, TimeOf(json, "create_time", where));
  if (json.contains("expire_time")) {
    ARGMESH_ASSIGN_OR_RETURN(key.expire_time,
                             TimeOf(json, "expire_time", where));
  }
  return key;
}

std::string TimeText(absl::Time time) {
  return absl::FormatTime(absl::RFC3339_sec, time, absl::UTCTimeZone());
}

Json ToJson(const ApiKey& key) {
  Json json = {{"id", key.id},
               {"sha256", ToHex(key.secret_sha256)},
               {"role", std::string(AccessRoleName(key.role))}};
  if (!key.collections.empty()) json["collections"] = key.collections;
  if (key.limits.requests_per_second > 0) {
    json["requests_per_second"] = key.limits.requests_per_second;
    json["burst"] = key.limits.burst;
  }
  if (key.limits.concurrent_calls > 0) {
    json["concurrent_calls"] = key.limits.concurrent_calls;
  }
  json["create_time"] = TimeText(key.create_time);
  if (key.expire_time != absl::InfiniteFuture()) {
    json["expire_time"] = TimeText(key.expire_time);
  }
  return json;
}

// Written and synced under another name, then renamed.
absl::Status WriteWhole(const std::string& path, const std::string& text,
                        mode_t mode) {
  const std::string unfinished = path + ".part";
  ::unlink(unfinished.c_str());
  const int descriptor =
      ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) return FileFailure("write", unfinished);
  const bool written = ::fchmod(descriptor, mode) == 0 &&
                       ::write(descriptor, text.data(), text.size()) ==
                           static_cast<ssize_t>(text.size()) &&
                       ::fsync(descriptor) == 0;
  absl::Status status =
      written ? absl::OkStatus() : FileFailure("write", unfinished);
  ::close(descriptor);
  if (!status.ok()) return status;
  return std::rename(unfinished.c_str(), path.c_str()) == 0
             ? absl::OkStatus()
             : FileFailure("write", path);
}

}  // namespace

absl::StatusOr<KeyRing> ParseKeys(std::string_view json) {
  const Json root = Json::parse(json, nullptr, /*allow_exceptions=*/false);
  if (root.is_discarded()) {
    return absl::InvalidArgumentError("the key file is not JSON");
  }
  ARGMESH_RETURN_IF_ERROR(CheckFields(root, {"keys"}, "the key file"));
  const auto keys = root.find("keys");
  if (keys == root.end() || !keys->is_array()) {
    return absl::InvalidArgumentError("the key file has no list \"keys\"");
  }
  if (keys->size() > kMaxKeys) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "the key file has %d keys, the limit is %d", keys->size(), kMaxKeys));
  }
  KeyRing ring;
  for (size_t i = 0; i < keys->size(); ++i) {
    ARGMESH_ASSIGN_OR_RETURN(ApiKey key, KeyOf((*keys)[i], i));
    std::string id = key.id;
    if (!ring.emplace(id, std::move(key)).second) {
      return Invalid("key \"" + id + "\"", "there are two of it");
    }
  }
  return ring;
}

std::string FormatKeys(const KeyRing& keys) {
  Json list = Json::array();
  for (const auto& [id, key] : keys) list.push_back(ToJson(key));
  return Json{{"keys", list}}.dump(2) + "\n";
}

absl::StatusOr<KeyRing> ReadKeyFile(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return FileFailure("read", path);
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "%s may be written by others than its owner: chmod go-w it", path));
  }
  if (static_cast<size_t>(status.st_size) > kMaxKeyFileBytes) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s has %d bytes, the limit is %d", path,
                        status.st_size, kMaxKeyFileBytes));
  }
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) return absl::UnavailableError("cannot read " + path);
  absl::StatusOr<KeyRing> keys = ParseKeys(text);
  if (keys.ok()) return keys;
  return absl::InvalidArgumentError(path + ": " +
                                    std::string(keys.status().message()));
}

absl::Status WriteKeyFile(const std::string& path, const KeyRing& keys) {
  struct stat status {};
  const mode_t mode = ::stat(path.c_str(), &status) == 0
                          ? (status.st_mode & ALLPERMS)
                          : kOwnerOnly;
  return WriteWhole(path, FormatKeys(keys), mode);
}

}  // namespace argmesh
