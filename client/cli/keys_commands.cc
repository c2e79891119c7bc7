// The API keys of a server: `argmesh keys create | limit | list | revoke`. They
// work on the file, on the server's machine; the server reads it on SIGHUP.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/time/clock.h"
#include "client/cli/command_set.h"
#include "client/cli/text_table.h"
#include "core/access/key_file.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kGroupDetails[] =
    R"(The file is what `argmeshd --keys FILE` reads, at its start and on SIGHUP. It
holds hashes: a key is shown once, when it is made.

Rotate a key with two live ones: create the new one, move the callers, revoke the
old one.)";

constexpr char kCreateDetails[] =
    R"(Roles: read searches and reads; write also makes collections, adds, changes and
removes shapes; admin also removes collections and runs the server.

Examples:
  argmesh keys create --file keys.json ci --role write --collection parts
  argmesh keys create --file keys.json ops --role admin --days 365)";

constexpr char kListKeysDetails[] = R"(Examples:
  argmesh keys list --file keys.json)";

constexpr char kLimitDetails[] =
    R"(Takes the place of the limits before; without options the key has none. Counts
once the server reads the file again. Calls beyond are refused with
KEY_LIMIT_EXCEEDED and the time after which to try again.

Examples:
  argmesh keys limit --file keys.json ci --rate 20 --burst 40 --concurrent 4
  argmesh keys limit --file keys.json ci)";

constexpr char kRevokeDetails[] =
    R"(The key counts until the server reads the file again.

Examples:
  argmesh keys revoke --file keys.json ci && pkill -HUP argmeshd)";

struct KeysArguments {
  std::string file;
  std::string id;
  std::string role = "read";
  std::vector<std::string> collections;
  int days = 0;  // 0: for ever
  KeyLimits limits;
};

absl::StatusOr<KeyRing> ReadOrEmpty(const std::string& file) {
  absl::StatusOr<KeyRing> keys = ReadKeyFile(file);
  if (absl::IsNotFound(keys.status())) return KeyRing();
  return keys;
}

// A rate without a burst: a second's calls at once.
absl::StatusOr<KeyLimits> LimitsOf(const KeysArguments& arguments) {
  KeyLimits limits = arguments.limits;
  if (limits.requests_per_second > 0 && limits.burst == 0) {
    limits.burst = static_cast<int>(
        std::ceil(std::min(limits.requests_per_second, kMaxKeyRate)));
  }
  const absl::Status status = CheckKeyLimits(limits);
  if (!status.ok()) return UsageError(std::string(status.message()));
  return limits;
}

std::string TextOf(const KeyLimits& limits) {
  std::vector<std::string> parts;
  if (limits.requests_per_second > 0) {
    parts.push_back(absl::StrFormat("%g/s, %d at once",
                                    limits.requests_per_second, limits.burst));
  }
  if (limits.concurrent_calls > 0) {
    parts.push_back(absl::StrFormat("%d concurrent", limits.concurrent_calls));
  }
  return parts.empty() ? "none" : absl::StrJoin(parts, "; ");
}

Json LimitsToJson(const KeyLimits& limits) {
  return {{"requests_per_second", limits.requests_per_second},
          {"burst", limits.burst},
          {"concurrent_calls", limits.concurrent_calls}};
}

std::string ExpiryOf(const ApiKey& key) {
  return key.expire_time == absl::InfiniteFuture()
             ? "never"
             : absl::FormatTime("%Y-%m-%dT%H:%M:%SZ", key.expire_time,
                                absl::UTCTimeZone());
}

std::string CollectionsOf(const ApiKey& key) {
  return key.collections.empty() ? "all" : absl::StrJoin(key.collections, ",");
}

absl::Status CheckArguments(const KeysArguments& arguments) {
  std::vector<std::string> ids = arguments.collections;
  ids.push_back(arguments.id);
  for (const std::string& id : ids) {
    if (!IsIdentifier(id)) {
      return UsageError(absl::StrFormat(
          "\"%s\" is no id: a-z, 0-9 and '-', beginning with a letter", id));
    }
  }
  return absl::OkStatus();
}

absl::Status NoSuchKey(const KeysArguments& arguments) {
  return absl::NotFoundError(
      absl::StrFormat("%s has no key %s", arguments.file, arguments.id));
}

absl::StatusOr<int> CreateKey(const Session& session,
                              const KeysArguments& arguments) {
  ARGMESH_RETURN_IF_ERROR(CheckArguments(arguments));
  ARGMESH_ASSIGN_OR_RETURN(KeyRing keys, ReadOrEmpty(arguments.file));
  if (keys.contains(arguments.id)) {
    return absl::AlreadyExistsError(
        absl::StrFormat("%s has a key %s", arguments.file, arguments.id));
  }
  if (keys.size() >= kMaxKeys) {
    return absl::ResourceExhaustedError(
        absl::StrFormat("%s has %d keys, the limit", arguments.file, kMaxKeys));
  }
  const std::string secret = MakeKeySecret();
  ApiKey key;
  key.id = arguments.id;
  key.secret_sha256 = HashKeySecret(secret);
  ARGMESH_ASSIGN_OR_RETURN(key.role, ParseAccessRole(arguments.role));
  key.collections = arguments.collections;
  ARGMESH_ASSIGN_OR_RETURN(key.limits, LimitsOf(arguments));
  key.create_time = absl::Now();
  if (arguments.days > 0) {
    key.expire_time = key.create_time + absl::Hours(24) * arguments.days;
  }
  keys.emplace(key.id, key);
  ARGMESH_RETURN_IF_ERROR(WriteKeyFile(arguments.file, keys));
  const std::string text = KeyText(key.id, secret);
  if (session.options.json) {
    session.Print({{"id", key.id},
                   {"key", text},
                   {"role", arguments.role},
                   {"collections", key.collections},
                   {"limits", LimitsToJson(key.limits)},
                   {"expires", ExpiryOf(key)}});
  } else {
    session.out << text << '\n';
    session.Note("keep it: it is not shown again");
  }
  return kExitOk;
}

absl::StatusOr<int> ListKeys(const Session& session,
                             const KeysArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const KeyRing keys, ReadKeyFile(arguments.file));
  Json list = Json::array();
  TextTable table({"id", "role", "collections", "limits", "expires", ""});
  for (const auto& [id, key] : keys) {
    const bool expired = key.expire_time <= absl::Now();
    const std::string role(AccessRoleName(key.role));
    list.push_back({{"id", id},
                    {"role", role},
                    {"collections", key.collections},
                    {"limits", LimitsToJson(key.limits)},
                    {"expires", ExpiryOf(key)},
                    {"expired", expired}});
    table.AddRow({id, role, CollectionsOf(key), TextOf(key.limits),
                  ExpiryOf(key), expired ? "expired" : ""});
  }
  if (session.options.json) {
    session.Print({{"keys", std::move(list)}});
  } else {
    session.out << table.ToString();
  }
  return kExitOk;
}

absl::StatusOr<int> LimitKey(const Session& session,
                             const KeysArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const KeyLimits limits, LimitsOf(arguments));
  ARGMESH_ASSIGN_OR_RETURN(KeyRing keys, ReadKeyFile(arguments.file));
  const auto key = keys.find(arguments.id);
  if (key == keys.end()) return NoSuchKey(arguments);
  key->second.limits = limits;
  ARGMESH_RETURN_IF_ERROR(WriteKeyFile(arguments.file, keys));
  if (session.options.json) {
    session.Print({{"id", arguments.id}, {"limits", LimitsToJson(limits)}});
  } else {
    session.out << arguments.id << " limits: " << TextOf(limits)
                << "; send the server a SIGHUP\n";
  }
  return kExitOk;
}

absl::StatusOr<int> RevokeKey(const Session& session,
                              const KeysArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(KeyRing keys, ReadKeyFile(arguments.file));
  if (keys.erase(arguments.id) == 0) return NoSuchKey(arguments);
  ARGMESH_RETURN_IF_ERROR(WriteKeyFile(arguments.file, keys));
  if (session.options.json) {
    session.Print({{"revoked", arguments.id}});
  } else {
    session.out << arguments.id << " revoked; send the server a SIGHUP\n";
  }
  return kExitOk;
}

void AddFileOption(CLI::App* command, KeysArguments& arguments) {
  command->add_option("--file,-f", arguments.file, "The key file")
      ->required()
      ->type_name("FILE");
}

void AddIdArgument(CLI::App* command, KeysArguments& arguments) {
  command->add_option("id", arguments.id, "Name of the key")
      ->required()
      ->type_name("ID");
}

void AddLimitOptions(CLI::App* command, KeyLimits& limits) {
  command
      ->add_option("--rate", limits.requests_per_second,
                   "Calls a second on the average; 0: no limit")
      ->type_name("R")
      ->capture_default_str();
  command
      ->add_option("--burst", limits.burst,
                   "Calls at once after a rest (default: those of a second)")
      ->type_name("N");
  command
      ->add_option("--concurrent", limits.concurrent_calls,
                   "Calls and streams under way at a time; 0: no limit")
      ->type_name("N")
      ->capture_default_str();
}

void AddCreateOptions(CLI::App* command, KeysArguments& arguments) {
  command->add_option("--role", arguments.role, "What the key may do")
      ->check(CLI::IsMember({"read", "write", "admin"}))
      ->capture_default_str();
  command
      ->add_option("--collection,-c", arguments.collections,
                   "Only in these collections, ids with commas")
      ->delimiter(',')
      ->type_name("IDS");
  command
      ->add_option("--days", arguments.days, "Valid for so long; 0: for ever")
      ->check(CLI::Range(0, 36500))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void AddKeysCommands(CLI::App& app, CommandSet& commands) {
  CLI::App* group = commands.AddGroup(
      app, {"keys", "Manage the API keys of a server.", kGroupDetails});
  const auto arguments = std::make_shared<KeysArguments>();
  const auto add = [&](const CommandText& text, auto body) {
    CLI::App* command =
        commands.Add(*group, text, [arguments, body](const Session& session) {
          return body(session, *arguments);
        });
    AddFileOption(command, *arguments);
    return command;
  };
  CLI::App* create =
      add({"create", "Make a key and show it.", kCreateDetails}, CreateKey);
  AddIdArgument(create, *arguments);
  AddCreateOptions(create, *arguments);
  AddLimitOptions(create, arguments->limits);
  CLI::App* limit =
      add({"limit", "Set what a key may use.", kLimitDetails}, LimitKey);
  AddIdArgument(limit, *arguments);
  AddLimitOptions(limit, arguments->limits);
  add({"list", "Show the keys of a file.", kListKeysDetails}, ListKeys);
  AddIdArgument(add({"revoke", "Remove a key.", kRevokeDetails}, RevokeKey),
                *arguments);
}

}  // namespace argmesh
