#include "client/cli/command_set.h"

#include <utility>

namespace argmesh {
namespace {

constexpr char kGlobalOptions[] = R"(

Global options, before or after the command: --server HOST:PORT, --timeout
SECONDS, --json, --tls..., --key-file FILE; see `argmesh --help`.)";

}  // namespace

CLI::App* CommandSet::Add(CLI::App& parent, const CommandText& text,
                          CommandBody body) {
  CLI::App* command = parent.add_subcommand(text.name, text.description);
  command->fallthrough();
  command->footer(text.details + std::string(kGlobalOptions));
  commands_.push_back({command, std::move(body)});
  return command;
}

CLI::App* CommandSet::AddGroup(CLI::App& parent, const CommandText& text) {
  CLI::App* group = parent.add_subcommand(text.name, text.description);
  group->fallthrough();
  group->footer(text.details);
  group->require_subcommand(1);
  return group;
}

int CommandSet::Run(const Session& session) const {
  for (const Command& command : commands_) {
    if (!command.app->parsed()) continue;
    const absl::StatusOr<int> exit_code = command.body(session);
    return exit_code.ok() ? *exit_code : session.Fail(exit_code.status());
  }
  return session.Fail(UsageError("no command was given"));
}

CLI::Option* AddCollectionOption(CLI::App* command, std::string& collection) {
  return command
      ->add_option("--collection,-c", collection, "Id of the collection")
      ->required()
      ->type_name("ID");
}

}  // namespace argmesh
