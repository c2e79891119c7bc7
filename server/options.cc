#include "server/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <istream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kMaxInflight = 100'000;

// Seconds on the command line, absl::Duration in the options.
struct Seconds {
  double stream_idle_timeout = 0;
  double drain_delay = 0;
  double drain_timeout = 0;
};

void AddServingOptions(CLI::App& app, ServerOptions& options) {
  app.add_option("--data", options.data, "Folder of everything stored");
  app.add_option("--import-root", options.import_root,
                 "Folder below which ImportShapes may read files");
  app.add_option("--listen", options.listen,
                 "HOST:PORT; port 0 takes a free one");
  app.add_option("--port-file", options.port_file,
                 "Write the bound HOST:PORT here once serving");
  app.add_flag("--insecure-remote", options.insecure_remote,
               "Listen on other than loopback although nothing is encrypted "
               "or authenticated");
  app.add_option("--reflection", options.reflection,
                 "Serve gRPC reflection: on or off");
}

void AddSecurity(CLI::App& app, ServerOptions& options) {
  app.add_option("--tls-cert", options.tls_cert,
                 "Certificate chain, PEM; followed when it changes");
  app.add_option("--tls-key", options.tls_key, "Its private key, PEM");
  app.add_option("--tls-client-ca", options.tls_client_ca,
                 "Clients must have a certificate of these authorities, PEM");
  app.add_option("--keys", options.keys,
                 "Callers must have one of the API keys in this file (argmesh "
                 "keys)");
}

void AddTelemetry(CLI::App& app, ServerOptions& options) {
  app.add_option("--log-level", options.log_level,
                 "Least level of events on stderr")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}));
  app.add_option("--audit-log", options.audit_log,
                 "Add a line for every write and every refused caller to this "
                 "file");
  app.add_option("--trace-log", options.trace_log,
                 "Add spans of calls to this file, OTLP as JSON lines");
  app.add_option("--max-log-bytes", options.max_log_bytes,
                 "Largest of each of these files; beyond it becomes FILE.1, in "
                 "the place of the one before; 0: any size")
      ->check(CLI::Range(int64_t{0}, int64_t{1} << 40));
  app.add_option("--metrics-listen", options.metrics_listen,
                 "HOST:PORT of /metrics for Prometheus; without key and "
                 "encryption");
}

void AddLimits(CLI::App& app, ServerOptions& options) {
  app.add_option("--threads", options.threads,
                 "Threads for searches; computation gets one less; 0: from "
                 "the CPUs")
      ->check(CLI::Range(0, 1024));
  app.add_option("--max-mesh-bytes", options.max_mesh_bytes,
                 "Largest mesh file taken")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 40));
  app.add_option("--mesh-memory", options.mesh_memory,
                 "Bytes that all meshes under computation may take together")
      ->check(CLI::Range(int64_t{1} << 20, int64_t{1} << 50));
  app.add_option("--max-inflight-searches", options.max_inflight_searches,
                 "Searches at work or waiting")
      ->check(CLI::Range(1, kMaxInflight));
  app.add_option("--max-inflight-uploads", options.max_inflight_uploads,
                 "Single uploads at work or waiting")
      ->check(CLI::Range(1, kMaxInflight));
  app.add_option("--max-inflight-ingests", options.max_inflight_ingests,
                 "Ingest streams open")
      ->check(CLI::Range(1, kMaxInflight));
}

void AddTimes(CLI::App& app, Seconds& seconds) {
  app.add_option("--stream-idle-timeout", seconds.stream_idle_timeout,
                 "Seconds a stream's peer may be silent")
      ->check(CLI::Range(0.1, 86400.0));
  app.add_option("--drain-delay", seconds.drain_delay,
                 "Seconds between NOT_SERVING and refusing calls")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--drain-timeout", seconds.drain_timeout,
                 "Seconds calls in flight may take to finish")
      ->check(CLI::Range(0.0, 3600.0));
}

// What is done instead of serving; never a key of the file.
void AddActions(CLI::App& app, ServerOptions& options) {
  app.add_flag("--check-config", options.check_config,
               "Check the options and exit")
      ->configurable(false);
  app.add_flag("--print-config", options.print_config,
               "Print the options as a file for --config and exit")
      ->configurable(false);
  app.add_option("--restore", options.restore,
                 "Check this snapshot, put it in the place of the data, and "
                 "exit; no server may use the data")
      ->configurable(false);
}

// A file in which every key has a value. CLI11 takes `listen=[,` for a key
// without any, and then reads one.
class FileWithValues final : public CLI::ConfigTOML {
 public:
  std::vector<CLI::ConfigItem> from_config(std::istream& file) const override {
    std::vector<CLI::ConfigItem> items = CLI::ConfigTOML::from_config(file);
    for (const CLI::ConfigItem& item : items) {
      if (item.inputs.empty()) {
        throw CLI::ConfigError("the file gives no value to " + item.fullname());
      }
    }
    return items;
  }
};

void Describe(CLI::App& app, std::string_view version) {
  app.option_defaults()->always_capture_default();
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.set_version_flag("--version", "argmeshd " + std::string(version));
  app.set_config("--config", "", "File with options, TOML or INI");
  app.config_formatter(std::make_shared<FileWithValues>());
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.footer(
      "Every option may be given in the environment (--drain-delay is "
      "ARGMESH_DRAIN_DELAY) and in the file of --config. Flags win over the "
      "environment, the environment over the file.");
}

std::string VariableOf(const std::string& option) {
  std::string name = "ARGMESH_";
  for (const char c : option) {
    name +=
        c == '-'
            ? '_'
            : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return name;
}

// An empty variable is as good as none: it takes a default of an image back.
//
// CLI11 lets its file win over its environment. So what the environment says
// is put in front of the flags, and the last one of an option counts.
std::vector<std::string> FromEnvironment(const CLI::App& app,
                                         const Environment& environment) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& names = option->get_lnames();
    if (names.empty() || !option->get_configurable()) continue;
    const auto value = environment(VariableOf(names.front()));
    if (value && !value->empty()) {
      arguments.push_back("--" + names.front() + "=" + *value);
    }
  }
  return arguments;
}

absl::Status Invalid(const CLI::ParseError& error,
                     const std::vector<std::string>& from_environment) {
  std::string message = error.what();
  if (!from_environment.empty()) {
    message += " (from the environment:";
    for (const std::string& argument : from_environment) {
      message += " " + argument.substr(0, argument.find('='));
    }
    message += ")";
  }
  return absl::InvalidArgumentError(message);
}

const char* OnOff(bool value) { return value ? "true" : "false"; }

// CLI11 takes all between the quotes as it is, but for what begins a comment.
std::string Quoted(const std::string& text) {
  return absl::StrCat("\"", text, "\"");
}

// No file can have them in a text: it would be read as another one.
bool IsUnreadable(char c) {
  return c == '"' || c == '#' ||
         absl::ascii_iscntrl(static_cast<unsigned char>(c));
}

// OK when the file can have every text.
absl::Status CheckTexts(const ServerOptions& options) {
  for (const auto& [name, text] :
       {std::pair("data", &options.data),
        std::pair("import-root", &options.import_root),
        std::pair("listen", &options.listen),
        std::pair("port-file", &options.port_file),
        std::pair("tls-cert", &options.tls_cert),
        std::pair("tls-key", &options.tls_key),
        std::pair("tls-client-ca", &options.tls_client_ca),
        std::pair("keys", &options.keys),
        std::pair("audit-log", &options.audit_log),
        std::pair("trace-log", &options.trace_log),
        std::pair("metrics-listen", &options.metrics_listen)}) {
    if (std::any_of(text->begin(), text->end(), IsUnreadable) ||
        text->ends_with('\\')) {
      return absl::InvalidArgumentError(
          absl::StrCat("--", name,
                       " has a control character, a \", a # or a \\ at its "
                       "end, which the configuration file cannot have in a "
                       "text"));
    }
  }
  return absl::OkStatus();
}

}  // namespace

Environment ProcessEnvironment() {
  return [](const std::string& name) -> std::optional<std::string> {
    const char* value = std::getenv(name.c_str());
    if (value == nullptr) return std::nullopt;
    return value;
  };
}

absl::StatusOr<ParsedOptions> ParseServerOptions(
    const std::vector<std::string>& arguments, const Environment& environment,
    std::string_view version) {
  ParsedOptions parsed;
  ServerOptions& options = parsed.options;
  Seconds seconds{
      .stream_idle_timeout = absl::ToDoubleSeconds(options.stream_idle_timeout),
      .drain_delay = absl::ToDoubleSeconds(options.drain_delay),
      .drain_timeout = absl::ToDoubleSeconds(options.drain_timeout)};

  CLI::App app("The argmesh shape-retrieval server", "argmeshd");
  Describe(app, version);
  AddServingOptions(app, options);
  AddSecurity(app, options);
  AddTelemetry(app, options);
  AddLimits(app, options);
  AddTimes(app, seconds);
  AddActions(app, options);

  const std::vector<std::string> given = FromEnvironment(app, environment);
  std::vector<std::string> reversed = given;
  reversed.insert(reversed.end(), arguments.begin(), arguments.end());
  std::reverse(reversed.begin(), reversed.end());  // as CLI11 wants it
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    parsed.answer = app.help();
  } catch (const CLI::CallForVersion&) {
    parsed.answer = app.version() + "\n";
  } catch (const CLI::ParseError& error) {
    return Invalid(error, given);
  }
  ARGMESH_RETURN_IF_ERROR(CheckTexts(options));
  options.stream_idle_timeout = absl::Seconds(seconds.stream_idle_timeout);
  options.drain_delay = absl::Seconds(seconds.drain_delay);
  options.drain_timeout = absl::Seconds(seconds.drain_timeout);
  return parsed;
}

std::string FormatServerOptions(const ServerOptions& options) {
  return absl::StrCat(
      "data=", Quoted(options.data),
      "\nimport-root=", Quoted(options.import_root),
      "\nlisten=", Quoted(options.listen),
      "\nport-file=", Quoted(options.port_file),
      "\ninsecure-remote=", OnOff(options.insecure_remote),
      "\nreflection=", OnOff(options.reflection),
      "\ntls-cert=", Quoted(options.tls_cert),
      "\ntls-key=", Quoted(options.tls_key),
      "\ntls-client-ca=", Quoted(options.tls_client_ca),
      "\nkeys=", Quoted(options.keys),
      "\nlog-level=", Quoted(options.log_level),
      "\naudit-log=", Quoted(options.audit_log),
      "\ntrace-log=", Quoted(options.trace_log),
      "\nmax-log-bytes=", options.max_log_bytes,
      "\nmetrics-listen=", Quoted(options.metrics_listen),
      "\nthreads=", options.threads,
      "\nmax-mesh-bytes=", options.max_mesh_bytes,
      "\nmesh-memory=", options.mesh_memory,
      "\nmax-inflight-searches=", options.max_inflight_searches,
      "\nmax-inflight-uploads=", options.max_inflight_uploads,
      "\nmax-inflight-ingests=", options.max_inflight_ingests,
      "\nstream-idle-timeout=",
      absl::ToDoubleSeconds(options.stream_idle_timeout),
      "\ndrain-delay=", absl::ToDoubleSeconds(options.drain_delay),
      "\ndrain-timeout=", absl::ToDoubleSeconds(options.drain_timeout), "\n");
}

}  // namespace argmesh
