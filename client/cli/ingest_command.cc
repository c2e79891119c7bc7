#include <memory>

#include "client/cli/command_set.h"
#include "client/cli/decomposition_option.h"
#include "client/cli/ingest_run.h"
#include "client/cli/interrupt.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kIngestDetails[] =
    R"(Folders are searched through all levels for .off .obj .ply .stl files. A file
becomes the shape whose id is made from its path relative to the folder given
(its name, for a file given by itself); that path is kept as source_uri. The
collection is created when it does not exist.

A file that is stored already, byte for byte, is not sent again: the same
command goes on where it was interrupted. Ctrl-C waits for what is under way.
Exit code 1 when a file failed; each is named with its reason.

Labels are lines `path TAB class`, paths relative to the folder of the labels
file. Files that are not listed are stored without a class.

Examples:
  argmesh ingest --collection parts ~/models more/bracket.stl
  argmesh ingest --collection bench --labels bench/labels.tsv bench)";

absl::StatusOr<int> Ingest(const Session& session,
                           const IngestArguments& arguments) {
  // Before the connection: its threads must not take the signals.
  const Interrupt interrupt([&session] {
    session.Note(
        "stopping: waiting for the shapes under way; Ctrl-C again "
        "ends at once");
  });
  ARGMESH_ASSIGN_OR_RETURN(const IngestAccount account,
                           RunIngest(session, arguments, interrupt.token()));
  if (session.options.json) {
    Json json = ToJson(account.summary);
    if (!account.end.ok()) json["error"] = ErrorToJson(account.end);
    session.Print(json);
  } else {
    session.out << ToText(account.summary);
  }
  if (!account.end.ok()) {
    session.Note(std::string(account.end.message()));
    return ExitCodeOf(account.end);
  }
  return account.summary.failures.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void AddIngestCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<IngestArguments>();
  CLI::App* command = commands.Add(
      app,
      {"ingest", "Store mesh files as shapes of a collection.", kIngestDetails},
      [arguments](const Session& session) {
        return Ingest(session, *arguments);
      });
  AddCollectionOption(command, arguments->collection);
  command->add_option("--labels", arguments->labels, "Classes of the files")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--jobs,-j", arguments->jobs,
                   "Shapes under way at a time; 0: what the server allows")
      ->type_name("N")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  AddDecompositionOption(command, arguments->decomposition,
                         "Of a new collection");
  command->add_flag("--replace", arguments->replace,
                    "Replace stored shapes of the same id whose mesh or class "
                    "differs");
  command->add_flag("--verbose,-v", arguments->verbose,
                    "Name every file as it is stored");
  command->add_option("PATH", arguments->paths, "Files and folders")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
