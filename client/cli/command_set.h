// The commands of `argmesh`: what each is called, its help, what it does.
#ifndef ARGMESH_CLIENT_CLI_COMMAND_SET_H_
#define ARGMESH_CLIENT_CLI_COMMAND_SET_H_

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/cli/session.h"

namespace argmesh {

// Does a command's work; its exit code, or an error that is told to the user.
using CommandBody = std::function<absl::StatusOr<int>(const Session&)>;

struct CommandText {
  std::string name;
  std::string description;  // one line, ends with a full stop
  std::string details;      // below the options: rules and examples
};

class CommandSet {
 public:
  // Adds a command below `parent`; the global options may follow its name.
  CLI::App* Add(CLI::App& parent, const CommandText& text, CommandBody body);
  // A group of commands, of which one has to be named.
  CLI::App* AddGroup(CLI::App& parent, const CommandText& text);

  // Does what the parsed command line asks for.
  int Run(const Session& session) const;

 private:
  struct Command {
    CLI::App* app;
    CommandBody body;
  };
  std::vector<Command> commands_;
};

// The option that most commands need: --collection.
CLI::Option* AddCollectionOption(CLI::App* command, std::string& collection);

// One file each.
void AddIngestCommand(CLI::App& app, CommandSet& commands);
void AddImportCommand(CLI::App& app, CommandSet& commands);
void AddReindexCommand(CLI::App& app, CommandSet& commands);
void AddSearchCommand(CLI::App& app, CommandSet& commands);
void AddCompareCommand(CLI::App& app, CommandSet& commands);
void AddDeclareCommand(CLI::App& app, CommandSet& commands);
void AddListCommand(CLI::App& app, CommandSet& commands);
void AddGetCommand(CLI::App& app, CommandSet& commands);
void AddDeleteCommand(CLI::App& app, CommandSet& commands);
void AddGraphCommand(CLI::App& app, CommandSet& commands);
void AddEvaluateCommand(CLI::App& app, CommandSet& commands);
void AddPictureCommands(CLI::App& app, CommandSet& commands);
void AddSampleCommand(CLI::App& app, CommandSet& commands);
void AddInfoCommand(CLI::App& app, CommandSet& commands);
void AddAdminCommands(CLI::App& app, CommandSet& commands);
void AddOperationsCommands(CLI::App& app, CommandSet& commands);
void AddKeysCommands(CLI::App& app, CommandSet& commands);
void AddHealthCommand(CLI::App& app, CommandSet& commands);
void AddCompletionCommand(CLI::App& app, CommandSet& commands);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_COMMAND_SET_H_
