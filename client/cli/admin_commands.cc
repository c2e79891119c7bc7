// Commands of operators: `argmesh admin snapshot ...` and `argmesh admin
// verify`.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "client/cli/command_set.h"
#include "client/cli/text_table.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kAdminDetails[] =
    R"(Where the server asks for keys: one of the role admin that is bound to no
collection.)";

constexpr char kSnapshotDetails[] =
    R"(A snapshot is one tar archive with the catalog and every mesh, sealed with a
SHA-256. `argmeshd --data FOLDER --restore FILE` puts it in the place of what is in
FOLDER; a damaged one is refused before anything changes.)";

constexpr char kCreateDetails[] = R"(Waits until it is made.

Examples:
  argmesh admin snapshot create before-upgrade)";

constexpr char kListDetails[] = R"(Examples:
  argmesh admin snapshot list)";

constexpr char kDownloadDetails[] =
    R"(The file appears when it is whole and its SHA-256 is the server's.

Examples:
  argmesh admin snapshot download before-upgrade --out before-upgrade.tar)";

constexpr char kDeleteDetails[] = R"(Examples:
  argmesh admin snapshot delete before-upgrade)";

constexpr char kVerifyDetails[] =
    R"(Compares the checksum of everything stored. Exit code 1 when something is damaged.

Examples:
  argmesh admin verify
  argmesh admin verify cups)";

struct SnapshotArguments {
  std::string id;
  std::string out;
};

std::string NameOf(const SnapshotArguments& arguments) {
  return absl::StrCat("snapshots/", arguments.id);
}

std::string TimeOf(const v1::Snapshot& snapshot) {
  return absl::FormatTime(
      "%Y-%m-%dT%H:%M:%SZ",
      absl::FromUnixSeconds(snapshot.create_time().seconds()),
      absl::UTCTimeZone());
}

Json SnapshotToJson(const v1::Snapshot& snapshot) {
  return {{"name", snapshot.name()},
          {"create_time", TimeOf(snapshot)},
          {"size_bytes", snapshot.size_bytes()},
          {"sha256", snapshot.sha256()}};
}

void Show(const Session& session, const v1::Snapshot& snapshot) {
  if (session.options.json) {
    session.Print(SnapshotToJson(snapshot));
  } else {
    session.out << absl::StrFormat("%s: %d bytes, sha256 %s\n", snapshot.name(),
                                   snapshot.size_bytes(), snapshot.sha256());
  }
}

absl::StatusOr<int> Create(const Session& session,
                           const SnapshotArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::Snapshot snapshot,
                           client->CreateSnapshot(arguments.id));
  Show(session, snapshot);
  return kExitOk;
}

absl::StatusOr<int> List(const Session& session, const SnapshotArguments&) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const auto snapshots, client->ListSnapshots());
  Json list = Json::array();
  TextTable table({"snapshot", "made", ">bytes", "sha256"});
  for (const v1::Snapshot& snapshot : snapshots) {
    list.push_back(SnapshotToJson(snapshot));
    table.AddRow({snapshot.name(), TimeOf(snapshot),
                  absl::StrCat(snapshot.size_bytes()), snapshot.sha256()});
  }
  if (session.options.json) {
    session.Print({{"snapshots", std::move(list)}});
  } else {
    session.out << table.ToString();
  }
  return kExitOk;
}

absl::StatusOr<int> Download(const Session& session,
                             const SnapshotArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  const std::string path =
      arguments.out.empty() ? arguments.id + ".tar" : arguments.out;
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
  absl::StatusOr<v1::Snapshot> snapshot =
      client->DownloadSnapshot(NameOf(arguments), [&](std::string_view bytes) {
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file ? absl::OkStatus()
                    : absl::UnavailableError("cannot write " + unfinished);
      });
  file.close();
  std::error_code error;
  if (snapshot.ok() && file) std::filesystem::rename(unfinished, path, error);
  if (snapshot.ok() && (!file || error)) {
    snapshot = absl::UnavailableError("cannot write " + path);
  }
  if (!snapshot.ok()) {
    std::remove(unfinished.c_str());
    return snapshot.status();
  }
  Show(session, *snapshot);
  return kExitOk;
}

absl::StatusOr<int> Delete(const Session& session,
                           const SnapshotArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_RETURN_IF_ERROR(client->DeleteSnapshot(NameOf(arguments)));
  if (session.options.json) {
    session.Print({{"deleted", NameOf(arguments)}});
  } else {
    session.out << NameOf(arguments) << " deleted\n";
  }
  return kExitOk;
}

// `collection` is an id; empty: everything.
absl::StatusOr<int> Verify(const Session& session,
                           const std::string& collection) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(
      const v1::VerifyStorageResponse report,
      client->VerifyStorage(
          collection.empty() ? "" : absl::StrCat("collections/", collection)));
  Json findings = Json::array();
  for (const std::string& finding : report.first_findings()) {
    findings.push_back(finding);
    if (!session.options.json) session.Note(finding);
  }
  if (session.options.json) {
    session.Print({{"shapes", report.shapes()},
                   {"checksums", report.checksums()},
                   {"meshes", report.meshes()},
                   {"mesh_bytes", report.mesh_bytes()},
                   {"findings", report.findings()},
                   {"first_findings", std::move(findings)}});
  } else {
    session.out << absl::StrFormat(
        "%d shapes, %d checksums, %d meshes of %d bytes: %d findings\n",
        report.shapes(), report.checksums(), report.meshes(),
        report.mesh_bytes(), report.findings());
  }
  return report.findings() == 0 ? kExitOk : kExitFailed;
}

void AddSnapshotCommands(CLI::App& admin, CommandSet& commands) {
  CLI::App* group = commands.AddGroup(
      admin, {"snapshot", "Make, list, fetch and remove snapshots.",
              kSnapshotDetails});
  const auto arguments = std::make_shared<SnapshotArguments>();
  const auto add = [&](const CommandText& text, auto body) {
    return commands.Add(*group, text,
                        [arguments, body](const Session& session) {
                          return body(session, *arguments);
                        });
  };
  const auto add_id = [&](CLI::App* command) {
    command->add_option("id", arguments->id, "Id of the snapshot")
        ->required()
        ->type_name("ID");
    return command;
  };
  add_id(add({"create", "Make a snapshot.", kCreateDetails}, Create));
  add({"list", "Show the snapshots there are.", kListDetails}, List);
  add_id(add({"download", "Fetch a snapshot.", kDownloadDetails}, Download))
      ->add_option("--out,-o", arguments->out, "File to write; else ID.tar")
      ->type_name("FILE");
  add_id(add({"delete", "Remove a snapshot.", kDeleteDetails}, Delete));
}

}  // namespace

void AddAdminCommands(CLI::App& app, CommandSet& commands) {
  CLI::App* admin = commands.AddGroup(
      app, {"admin", "Snapshots and checks of the store.", kAdminDetails});
  AddSnapshotCommands(*admin, commands);
  const auto collection = std::make_shared<std::string>();
  commands
      .Add(*admin, {"verify", "Check everything stored.", kVerifyDetails},
           [collection](const Session& session) {
             return Verify(session, *collection);
           })
      ->add_option("collection", *collection, "Only this collection")
      ->type_name("ID");
}

}  // namespace argmesh
