// Shell scripts that complete the commands and options of a program.
#ifndef ARGMESH_CLIENT_CLI_COMPLETION_SCRIPT_H_
#define ARGMESH_CLIENT_CLI_COMPLETION_SCRIPT_H_

#include <string>
#include <string_view>
#include <vector>

namespace argmesh {

struct CompletionWord {
  std::string word;  // a command's name or "--option"
  std::string description;
};

// What may follow a command. The program itself has an empty path, a command
// its name, one of a group "group name".
struct CompletionCommand {
  std::string path;
  std::vector<CompletionWord> commands;
  std::vector<CompletionWord> options;
};

std::string BashCompletion(std::string_view program,
                           const std::vector<CompletionCommand>& commands);
// By bash's rules, which zsh understands.
std::string ZshCompletion(std::string_view program,
                          const std::vector<CompletionCommand>& commands);
std::string FishCompletion(std::string_view program,
                           const std::vector<CompletionCommand>& commands);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_COMPLETION_SCRIPT_H_
