// Commands for work in the background of the server: `argmesh operations`.
#include <google/protobuf/util/time_util.h>

#include <memory>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/json.h"
#include "client/cli/text_table.h"
#include "client/error_status.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;
using google::protobuf::util::TimeUtil;

constexpr char kGroupDetails[] =
    R"(Imports, reindexes, snapshots and verifications work in the background of the
server, whoever started them. Where the server asks for keys: one of the role
admin that is bound to no collection.)";

constexpr char kListDetails[] =
    R"(Those that run and those that have ended, by id. The server remembers the last
1000, until it is stopped.

Examples:
  argmesh operations list
  argmesh operations list --json)";

constexpr char kCancelDetails[] =
    R"(Asks it to stop and does not wait: the list says when it has. What it has done
stays done.

Examples:
  argmesh operations cancel 1f0c7c1e-7a52-4b0e-9d3b-0c8f6f1f2a11)";

std::string_view StateOf(const Operation& operation) {
  if (!operation.done()) return "running";
  if (!operation.has_error()) return "done";
  const absl::Status status = ToStatus(operation.error());
  return absl::IsCancelled(status) ? "cancelled" : "failed";
}

v1::OperationMetadata MetadataOf(const Operation& operation) {
  v1::OperationMetadata metadata;
  operation.metadata().UnpackTo(&metadata);
  return metadata;
}

Json ToJson(const Operation& operation) {
  const v1::OperationMetadata metadata = MetadataOf(operation);
  Json json = {{"operation", ResourceId(operation.name())},
               {"method", metadata.method()},
               {"resource", metadata.resource()},
               {"state", StateOf(operation)},
               {"create_time", TimeUtil::ToString(metadata.create_time())},
               {"items", metadata.items()},
               {"items_done", metadata.items_done()},
               {"items_failed", metadata.items_failed()}};
  if (metadata.has_end_time()) {
    json["end_time"] = TimeUtil::ToString(metadata.end_time());
  }
  if (operation.has_error()) {
    json["error"] = ErrorToJson(ToStatus(operation.error()));
  }
  return json;
}

absl::StatusOr<int> List(const Session& session) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const auto operations, client->ListOperations());
  Json list = Json::array();
  TextTable table({"operation", "method", "resource", "state", "begun",
                   ">items", ">done", ">failed"});
  for (const Operation& operation : operations) {
    const v1::OperationMetadata metadata = MetadataOf(operation);
    list.push_back(ToJson(operation));
    table.AddRow({ResourceId(operation.name()), metadata.method(),
                  metadata.resource(), std::string(StateOf(operation)),
                  TimeUtil::ToString(metadata.create_time()),
                  absl::StrCat(metadata.items()),
                  absl::StrCat(metadata.items_done()),
                  absl::StrCat(metadata.items_failed())});
  }
  if (session.options.json) {
    session.Print({{"operations", std::move(list)}});
  } else {
    session.out << table.ToString();
  }
  return kExitOk;
}

absl::StatusOr<int> Cancel(const Session& session, const std::string& id) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_RETURN_IF_ERROR(
      client->CancelOperation(absl::StrCat("operations/", id)));
  if (session.options.json) {
    session.Print({{"cancelled", id}});
  } else {
    session.out << absl::StrFormat("%s is asked to stop\n", id);
  }
  return kExitOk;
}

}  // namespace

void AddOperationsCommands(CLI::App& app, CommandSet& commands) {
  CLI::App* group = commands.AddGroup(
      app, {"operations", "Show and cancel what the server does at length.",
            kGroupDetails});
  commands.Add(*group, {"list", "Show the operations.", kListDetails}, List);
  const auto id = std::make_shared<std::string>();
  commands
      .Add(*group, {"cancel", "Cancel one of them.", kCancelDetails},
           [id](const Session& session) { return Cancel(session, *id); })
      ->add_option("id", *id, "Id of the operation")
      ->required()
      ->type_name("ID");
}

}  // namespace argmesh
