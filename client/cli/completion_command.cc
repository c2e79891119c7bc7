#include <memory>

#include "client/cli/command_set.h"
#include "client/cli/completion_script.h"

namespace argmesh {
namespace {

constexpr char kCompletionDetails[] = R"(Examples:
  argmesh completion bash > ~/.local/share/bash-completion/completions/argmesh
  source <(argmesh completion zsh)
  argmesh completion fish > ~/.config/fish/completions/argmesh.fish)";

// Every command below `app`, parents before children.
void CollectCommands(const CLI::App& app, const std::string& path,
                     std::vector<CompletionCommand>& commands) {
  CompletionCommand command;
  command.path = path;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      command.options.push_back({"--" + name, option->get_description()});
    }
  }
  const auto children = app.get_subcommands(nullptr);
  for (const CLI::App* child : children) {
    command.commands.push_back({child->get_name(), child->get_description()});
  }
  commands.push_back(std::move(command));
  for (const CLI::App* child : children) {
    CollectCommands(
        *child,
        path.empty() ? child->get_name() : path + " " + child->get_name(),
        commands);
  }
}

}  // namespace

void AddCompletionCommand(CLI::App& app, CommandSet& commands) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = commands.Add(
      app,
      {"completion", "Print a script that completes commands in a shell.",
       kCompletionDetails},
      [shell, &app](const Session& session) -> absl::StatusOr<int> {
        std::vector<CompletionCommand> tree;
        CollectCommands(app, "", tree);
        session.out << (*shell == "bash"  ? BashCompletion("argmesh", tree)
                        : *shell == "zsh" ? ZshCompletion("argmesh", tree)
                                          : FishCompletion("argmesh", tree));
        return kExitOk;
      });
  command->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
}

}  // namespace argmesh
