#include "client/cli/app.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <sstream>

#include "client/cli/command_set.h"
#include "client/cli/session.h"

namespace argmesh {
namespace {

constexpr char kDescription[] =
    "Finds 3D models by their shape, on an argmesh server.";

constexpr char kFooter[] =
    R"(Exit codes: 0 ok, 1 something failed, 2 wrong usage, 3 no server answers,
130 interrupted.

Examples:
  argmesh ingest --collection parts ~/models
  argmesh search --collection parts --mode global query.stl
  argmesh search --collection parts --mode partial --shape valve-7
  argmesh compare --collection parts a.off b.off
  argmesh evaluate --collection parts --mode global
  argmesh picture match --collection parts a.off b.off --out match.png

`argmesh COMMAND --help` says more about each command.)";

void AddGlobalOptions(CLI::App& app, GlobalOptions& options) {
  app.add_option("--server", options.server, "Address of the server")
      ->envname("ARGMESH_SERVER")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--timeout", options.timeout_seconds,
                 "Seconds that one call may take")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--json", options.json,
               "Print one JSON document instead of text for people");
  app.add_flag("--tls", options.tls.enabled,
               "Encrypt; implied by the other --tls options");
  app.add_option("--tls-ca", options.tls.authorities,
                 "Authorities of the server's certificate, PEM; else the "
                 "system's")
      ->envname("ARGMESH_TLS_CA")
      ->type_name("FILE");
  app.add_option("--tls-cert", options.tls.certificate,
                 "Certificate of this client, PEM")
      ->envname("ARGMESH_CLIENT_TLS_CERT")
      ->type_name("FILE");
  app.add_option("--tls-key", options.tls.private_key, "Its private key, PEM")
      ->envname("ARGMESH_CLIENT_TLS_KEY")
      ->type_name("FILE");
  app.add_option("--tls-server-name", options.tls.server_name,
                 "Name that the server's certificate is for, if not the host")
      ->envname("ARGMESH_TLS_SERVER_NAME")
      ->type_name("NAME");
  app.add_option("--key-file", options.key_file,
                 "File with the API key; else the variable ARGMESH_KEY")
      ->envname("ARGMESH_KEY_FILE")
      ->type_name("FILE");
  app.set_version_flag("--version", std::string("argmesh ") + ARGMESH_VERSION);
}

void AddCommands(CLI::App& app, CommandSet& commands) {
  AddIngestCommand(app, commands);
  AddImportCommand(app, commands);
  AddReindexCommand(app, commands);
  AddSearchCommand(app, commands);
  AddCompareCommand(app, commands);
  AddDeclareCommand(app, commands);
  AddListCommand(app, commands);
  AddGetCommand(app, commands);
  AddDeleteCommand(app, commands);
  AddGraphCommand(app, commands);
  AddEvaluateCommand(app, commands);
  AddPictureCommands(app, commands);
  AddSampleCommand(app, commands);
  AddInfoCommand(app, commands);
  AddAdminCommands(app, commands);
  AddOperationsCommands(app, commands);
  AddKeysCommands(app, commands);
  AddHealthCommand(app, commands);
  AddCompletionCommand(app, commands);
}

}  // namespace

int RunArgmesh(int argc, const char* const* argv, std::ostream& out,
               std::ostream& err, bool err_is_terminal) {
  CLI::App app(kDescription, "argmesh");
  app.footer(kFooter);
  app.require_subcommand(1);
  GlobalOptions options;
  AddGlobalOptions(app, options);
  CommandSet commands;
  AddCommands(app, commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version end the parse too, with code 0.
    return app.exit(error, out, err) == 0 ? kExitOk : kExitUsage;
  }
  const Session session{options, out, err, err_is_terminal};
  try {
    return commands.Run(session);
  } catch (const std::exception& error) {
    return session.Fail(absl::InternalError(error.what()));
  }
}

}  // namespace argmesh
