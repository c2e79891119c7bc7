// Commands about the server itself: info and health.
#include <memory>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/text_table.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kInfoDetails[] = R"(Examples:
  argmesh info
  argmesh info --json)";

constexpr char kHealthDetails[] =
    R"(One attempt, for probes of containers: exit code 0 when it is SERVING, 1 when it
answers something else, 3 when nothing answers.

Examples:
  argmesh health --timeout 2
  argmesh health --service argmesh.v1.SearchService)";

absl::StatusOr<int> ShowInfo(const Session& session) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::GetServerInfoResponse info,
                           client->GetServerInfo());
  Json json = {{"server", client->target()}};
  json.update(ToJson(info));
  if (session.options.json) {
    session.Print(json);
    return kExitOk;
  }
  TextTable table({"field", "value"});
  const auto add = [&table](const std::string& prefix, const Json& values) {
    for (const auto& [key, value] : values.items()) {
      if (value.is_object()) continue;
      table.AddRow({prefix + key, value.is_string() ? value.get<std::string>()
                                                    : value.dump()});
    }
  };
  add("", json);
  add("limits.", json["limits"]);
  session.out << table.ToString();
  return kExitOk;
}

absl::StatusOr<int> CheckHealth(const Session& session,
                                const std::string& service) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const std::string health,
                           client->CheckHealth(service));
  if (session.options.json) {
    session.Print({{"service", service}, {"status", health}});
  } else {
    session.out << health << '\n';
  }
  return health == "SERVING" ? kExitOk : kExitFailed;
}

}  // namespace

void AddInfoCommand(CLI::App& app, CommandSet& commands) {
  commands
      .Add(app, {"info", "Show what the server is and holds.", kInfoDetails},
           ShowInfo)
      ->alias("stats");
}

void AddHealthCommand(CLI::App& app, CommandSet& commands) {
  const auto service = std::make_shared<std::string>();
  CLI::App* command = commands.Add(
      app, {"health", "Ask whether the server serves.", kHealthDetails},
      [service](const Session& session) {
        return CheckHealth(session, *service);
      });
  command
      ->add_option("--service", *service,
                   "One gRPC service instead of the whole server")
      ->type_name("NAME");
}

}  // namespace argmesh
