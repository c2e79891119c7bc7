#include "server/serving.h"

#include <map>
#include <sstream>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/rpc/connection_acceptor.h"
#include "server/rpc/listen_address.h"
#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/restore.h"
#include "server/storage/sqlite_catalog.h"
#include "server/telemetry/engine_gauges.h"

namespace argmesh {
namespace {

ServiceLimits LimitsOf(const ServerOptions& options) {
  ServiceLimits limits;
  limits.max_inflight_searches = options.max_inflight_searches;
  limits.max_inflight_uploads = options.max_inflight_uploads;
  limits.max_inflight_ingests = options.max_inflight_ingests;
  limits.stream_idle_timeout = options.stream_idle_timeout;
  return limits;
}

// None when no keys are asked for.
absl::StatusOr<std::shared_ptr<const KeyRing>> KeysOf(
    const ServerOptions& options) {
  if (options.keys.empty()) return std::shared_ptr<const KeyRing>();
  absl::StatusOr<KeyRing> keys = ReadKeyFile(options.keys);
  if (keys.ok()) return std::make_shared<const KeyRing>(*std::move(keys));
  return absl::Status(
      keys.status().code(),
      absl::StrCat("--keys: ", std::string(keys.status().message())));
}

absl::StatusOr<RpcServerOptions> RpcOptionsOf(const ServerOptions& options) {
  RpcServerOptions rpc;
  rpc.listen = options.listen;
  rpc.tls = {.certificate = options.tls_cert,
             .private_key = options.tls_key,
             .client_authorities = options.tls_client_ca};
  ARGMESH_ASSIGN_OR_RETURN(rpc.keys, KeysOf(options));
  rpc.insecure_remote = options.insecure_remote;
  rpc.reflection = options.reflection;
  rpc.version = ARGMESH_VERSION;
  rpc.limits = LimitsOf(options);
  return rpc;
}

EngineOptions EngineOptionsOf(const ServerOptions& options) {
  EngineOptions engine;
  engine.mesh_limits.max_bytes = options.max_mesh_bytes;
  engine.mesh_memory = options.mesh_memory;
  if (options.threads > 0) engine.pool.threads = ThreadsFor(options.threads);
  return engine;
}

absl::StatusOr<TelemetryOptions> TelemetryOptionsOf(
    const ServerOptions& options) {
  TelemetryOptions telemetry;
  ARGMESH_ASSIGN_OR_RETURN(telemetry.log_level,
                           ParseLogLevel(options.log_level));
  telemetry.audit_log = options.audit_log;
  telemetry.trace_log = options.trace_log;
  telemetry.max_log_bytes = options.max_log_bytes;
  return telemetry;
}

// What Reload does not apply, as lines of a file: those that differ.
std::string NotReloaded(const ServerOptions& before, ServerOptions after) {
  after.log_level = before.log_level;
  after.keys = before.keys;
  after.max_inflight_searches = before.max_inflight_searches;
  after.max_inflight_uploads = before.max_inflight_uploads;
  after.max_inflight_ingests = before.max_inflight_ingests;
  after.stream_idle_timeout = before.stream_idle_timeout;
  std::istringstream old_lines(FormatServerOptions(before));
  std::istringstream new_lines(FormatServerOptions(after));
  std::string names;
  std::string old_line;
  std::string new_line;
  while (std::getline(old_lines, old_line) &&
         std::getline(new_lines, new_line)) {
    if (old_line == new_line) continue;
    absl::StrAppend(&names, names.empty() ? "" : ", ",
                    new_line.substr(0, new_line.find('=')));
  }
  return names;
}

}  // namespace

absl::Status CheckServerOptions(const ServerOptions& options) {
  ARGMESH_ASSIGN_OR_RETURN(const RpcServerOptions rpc, RpcOptionsOf(options));
  ARGMESH_RETURN_IF_ERROR(CheckTls(rpc.tls));
  if (!options.import_root.empty()) {
    ARGMESH_RETURN_IF_ERROR(ImportRoot::Open(options.import_root).status());
  }
  if (!options.metrics_listen.empty()) {
    const absl::Status metrics =
        ParseListenAddress(options.metrics_listen).status();
    if (!metrics.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat("--metrics-listen: ", std::string(metrics.message())));
    }
  }
  return CheckListenAddress(rpc);
}

absl::Status Restore(const ServerOptions& options, std::ostream& out) {
  ARGMESH_ASSIGN_OR_RETURN(const std::shared_ptr<DataDirectory> directory,
                           DataDirectory::Open(options.data));
  ARGMESH_ASSIGN_OR_RETURN(const RestoreReport report,
                           RestoreSnapshot(options.restore, *directory));
  out << "restored " << report.meshes << " meshes and the catalog, "
      << report.bytes << " bytes\n";
  if (!report.kept.empty()) {
    out << "what was there before is kept in " << report.kept.string() << '\n';
  }
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<Serving>> Serving::Start(
    const ServerOptions& options, std::ostream& log, const StopToken& stop) {
  RaiseDescriptorLimit();
  std::unique_ptr<Serving> serving(new Serving());
  serving->options_ = options;
  ARGMESH_ASSIGN_OR_RETURN(const TelemetryOptions telemetry,
                           TelemetryOptionsOf(options));
  ARGMESH_ASSIGN_OR_RETURN(serving->telemetry_,
                           Telemetry::Open(telemetry, log));
  ARGMESH_RETURN_IF_ERROR(serving->OpenStore(stop));
  ARGMESH_ASSIGN_OR_RETURN(RpcServerOptions rpc, RpcOptionsOf(options));
  rpc.store_admin = serving->snapshots_.get();
  rpc.operation_store = serving->operations_.get();
  if (!options.import_root.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(serving->import_root_,
                             ImportRoot::Open(options.import_root));
    rpc.import_source = serving->import_root_.get();
  }
  ARGMESH_ASSIGN_OR_RETURN(
      serving->rpc_,
      RpcServer::Start(rpc, *serving->engine_, *serving->telemetry_));
  ARGMESH_RETURN_IF_ERROR(serving->StartMetrics());
  return serving;
}

absl::Status Serving::OpenStore(const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(std::shared_ptr<DataDirectory> directory,
                           DataDirectory::Open(options_.data));
  log().Write(LogLevel::kInfo, "opening the store",
              {{"check", !directory->IsMarkedClean()}});
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<DirectoryMeshStore> meshes,
                           DirectoryMeshStore::Open(directory));
  ARGMESH_ASSIGN_OR_RETURN(snapshots_,
                           SnapshotDirectory::Open(directory, *meshes));
  ARGMESH_ASSIGN_OR_RETURN(operations_, OperationDirectory::Open(directory));
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<SqliteCatalog> catalog,
                           SqliteCatalog::Open(directory, {}, stop));
  ARGMESH_ASSIGN_OR_RETURN(
      engine_, Engine::Create(EngineOptionsOf(options_), std::move(catalog),
                              std::move(meshes)));
  return absl::OkStatus();
}

absl::Status Serving::StartMetrics() {
  if (options_.metrics_listen.empty()) return absl::OkStatus();
  ARGMESH_ASSIGN_OR_RETURN(
      metrics_,
      MetricsEndpoint::Start(
          options_.metrics_listen, telemetry_->metrics(),
          {[this](GaugeSheet& sheet) { rpc_->WriteGauges(sheet); },
           [this](GaugeSheet& sheet) { WriteEngineGauges(*engine_, sheet); },
           [this](GaugeSheet& sheet) { telemetry_->WriteGauges(sheet); },
           WriteProcessGauges}));
  log().Write(LogLevel::kInfo, "metrics",
              {{"port", int64_t{metrics_->port()}}});
  return absl::OkStatus();
}

Serving::~Serving() = default;

void Serving::Reload(const ServerOptions& options) {
  const absl::StatusOr<std::shared_ptr<const KeyRing>> keys = KeysOf(options);
  const absl::StatusOr<LogLevel> level = ParseLogLevel(options.log_level);
  absl::Status status = keys.status();
  status.Update(level.status());
  // Losing the keys at run time would open the server to everybody.
  if (status.ok() && options.keys.empty() != options_.keys.empty()) {
    status = absl::FailedPreconditionError(
        "--keys can be neither given nor taken away while the server runs");
  }
  if (!status.ok()) {
    log().Write(LogLevel::kError, "not reloaded",
                {{"error", status.ToString()}});
    return;
  }
  log().SetLowest(*level);
  rpc_->SetLimits(LimitsOf(options));
  rpc_->SetKeys(*keys);
  const absl::Status reopened = telemetry_->Reopen();
  if (!reopened.ok()) {
    log().Write(LogLevel::kError, "log file not opened again",
                {{"error", reopened.ToString()}});
  }
  const std::string ignored = NotReloaded(options_, options);
  if (!ignored.empty()) {
    log().Write(LogLevel::kWarning, "options that need a restart",
                {{"options", ignored}});
  }
  log().Write(
      LogLevel::kInfo, "reloaded",
      {{"keys",
        *keys == nullptr ? int64_t{0} : static_cast<int64_t>((*keys)->size())},
       {"log_level", options.log_level}});
}

absl::Status Serving::Close() {
  metrics_.reset();
  return engine_->Close();
}

}  // namespace argmesh
