#include "server/rpc/rpc_server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <grpcpp/impl/server_builder_plugin.h>
#include <grpcpp/resource_quota.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/rpc/admin_service.h"
#include "server/rpc/collection_service.h"
#include "server/rpc/connection_acceptor.h"
#include "server/rpc/ingest_service.h"
#include "server/rpc/listen_address.h"
#include "server/rpc/operations_service.h"
#include "server/rpc/search_service.h"
#include "server/rpc/shape_service.h"

namespace argmesh {
namespace {

constexpr char kSearchService[] = "argmesh.v1.SearchService";
constexpr const char* kOtherServices[] = {
    "argmesh.v1.CollectionService", "argmesh.v1.ShapeService",
    "argmesh.v1.IngestService", "argmesh.v1.AdminService"};
constexpr char kLiveness[] = "liveness";

constexpr size_t kMaxTransportBytes = 512 << 20;
constexpr int kMillisPerSecond = 1000;
constexpr absl::Duration kShutdownPatience = absl::Milliseconds(200);

// Reflection registers itself for every server of the process as soon as it is
// linked: a server without it takes it out again.
class WithoutReflection final : public grpc::ServerBuilderOption {
 public:
  void UpdateArguments(grpc::ChannelArguments*) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>*
                         plugins) override {
    std::erase_if(*plugins, [](const auto& plugin) {
      return plugin->name() == "proto_server_reflection";
    });
  }
};

void SetChannelArguments(grpc::ServerBuilder& builder) {
  builder.SetMaxReceiveMessageSize(kMaxMessageBytes);
  builder.SetMaxSendMessageSize(kMaxMessageBytes);
  // The limit counts what is received: gRPC unpacks a message whatever it grows
  // to. Who compresses gets UNIMPLEMENTED, and nothing is unpacked.
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_PER_MESSAGE_DECOMPRESSION, 0);
  // Requests that have not come whole, and all else that connections hold:
  // near it gRPC lets peers send less and cuts streams.
  grpc::ResourceQuota quota("argmesh");
  builder.SetResourceQuota(quota.Resize(kMaxTransportBytes));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kMaxStreams);
  // One peer's bytes are not worked on for long before another's turn: 64 KiB
  // may be hundreds of calls.
  builder.AddChannelArgument(GRPC_ARG_TCP_MAX_READ_CHUNK_SIZE, 8 << 10);
  builder.AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, 16 << 10);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 60 * kMillisPerSecond);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS,
                             20 * kMillisPerSecond);
  // Any number of pings: each costs next to nothing, and who does not take the
  // answers is read from no more. A limit would cut clients with ordinary
  // keepalives, and to cut who floods costs gRPC time that grows with the
  // square of the pings that are there.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PING_STRIKES, 0);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS,
                             30 * 60 * kMillisPerSecond);
  // Streams in flight outlive the connection's age by so much: an ingest of
  // an hour must not be cut.
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS,
                             24 * 3600 * kMillisPerSecond);
}

}  // namespace

// What outlives the server in the engine's index watcher.
class HealthBoard {
 public:
  void Attach(grpc::HealthCheckServiceInterface* service) {
    const std::lock_guard lock(mutex_);
    service_ = service;
    Publish();
  }
  void Detach() {
    const std::lock_guard lock(mutex_);
    service_ = nullptr;
  }
  void SetIndexServing(bool serving) {
    const std::lock_guard lock(mutex_);
    index_serving_ = serving;
    Publish();
  }
  void SetDraining() {
    const std::lock_guard lock(mutex_);
    draining_ = true;
    Publish();
  }

 private:
  void Publish() {
    if (service_ == nullptr) return;
    const bool searchable = index_serving_ && !draining_;
    service_->SetServingStatus(kLiveness, true);
    service_->SetServingStatus(kSearchService, searchable);
    for (const char* name : kOtherServices) {
      service_->SetServingStatus(name, !draining_);
    }
    service_->SetServingStatus("", searchable);
  }

  std::mutex mutex_;
  grpc::HealthCheckServiceInterface* service_ = nullptr;
  bool index_serving_ = false;
  bool draining_ = false;
};

class RpcServer::Impl {
 public:
  Impl(const RpcServerOptions& options, Engine& engine, Telemetry& telemetry)
      : environment_(engine, telemetry, options.version, options.limits,
                     options.operation_store),
        collections_(environment_),
        shapes_(environment_),
        ingest_(environment_),
        search_(environment_),
        admin_(environment_),
        operations_(environment_) {
    environment_.access.SetKeys(options.keys);
    environment_.store_admin = options.store_admin;
    environment_.import_source = options.import_source;
    environment_.connections.SetCut(
        [this](const std::string& peer) { acceptor_.Cut(peer); });
  }

  ~Impl() { Shutdown(absl::Now()); }

  absl::Status Listen(const RpcServerOptions& options, ListenAddress address) {
    grpc::EnableDefaultHealthCheckService(true);
    grpc::ServerBuilder builder;
    SetChannelArguments(builder);
    if (options.reflection) {
      grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    } else {
      builder.SetOption(std::make_unique<WithoutReflection>());
    }
    ARGMESH_ASSIGN_OR_RETURN(const auto credentials,
                             MakeServerCredentials(options.tls));
    ARGMESH_ASSIGN_OR_RETURN(const int port, acceptor_.Listen(address));
    using Experimental = grpc::ServerBuilder::experimental_type;
    auto sink = builder.experimental().AddExternalConnectionAcceptor(
        Experimental::ExternalConnectionType::FROM_FD, credentials);
    builder.RegisterService(&collections_)
        .RegisterService(&shapes_)
        .RegisterService(&ingest_)
        .RegisterService(&search_)
        .RegisterService(&admin_)
        .RegisterService(&operations_);
    server_ = builder.BuildAndStart();
    if (server_ == nullptr) {
      return absl::InternalError("gRPC does not start a server");
    }
    acceptor_.Serve(std::move(sink));
    address.port = port;
    port_ = port;
    address_ = address.ToString();
    health_->Attach(server_->GetHealthCheckService());
    environment_.engine.WatchIndexState([board = health_](IndexState state) {
      board->SetIndexServing(state == IndexState::kServing);
    });
    return absl::OkStatus();
  }

  bool Shutdown(absl::Time deadline) {
    const std::lock_guard lock(shutdown_mutex_);
    if (server_ == nullptr) return clean_;
    health_->SetDraining();
    const absl::Time now = absl::Now();
    environment_.calls.StartDrain(
        std::max(absl::ZeroDuration(), deadline - now));
    environment_.operations.CancelAll();
    clean_ = environment_.calls.WaitUntilIdle(deadline);
    health_->Detach();
    acceptor_.Stop();
    // Of ours nothing is left, or it is late; only health watches still run.
    server_->Shutdown(absl::ToChronoTime(absl::Now() + kShutdownPatience));
    server_->Wait();
    // gRPC's own part is done; tasks on the pool may still let go of calls.
    environment_.calls.WaitUntilIdle(absl::InfiniteFuture());
    // Those too that a last call has started: they read the store, which is
    // closed next.
    environment_.operations.EndAll();
    server_.reset();
    return clean_;
  }

  void StopAdvertising() { health_->SetDraining(); }
  const std::string& address() const { return address_; }
  int port() const { return port_; }
  ServiceEnvironment& environment() { return environment_; }
  void WriteGauges(GaugeSheet& sheet) const;
  std::shared_ptr<grpc::Channel> InProcessChannel() {
    return server_->InProcessChannel(grpc::ChannelArguments());
  }

 private:
  ServiceEnvironment environment_;
  CollectionServiceImpl collections_;
  ShapeServiceImpl shapes_;
  IngestServiceImpl ingest_;
  SearchServiceImpl search_;
  AdminServiceImpl admin_;
  OperationsServiceImpl operations_;
  const std::shared_ptr<HealthBoard> health_ = std::make_shared<HealthBoard>();
  std::mutex shutdown_mutex_;
  bool clean_ = true;
  std::string address_;
  int port_ = 0;
  ConnectionAcceptor acceptor_;
  std::unique_ptr<grpc::Server> server_;
};

void RpcServer::Impl::WriteGauges(GaugeSheet& sheet) const {
  sheet.Gauge("argmesh_build_info", "1, with the version as a label.", 1,
              {{"version", environment_.version}});
  sheet.Gauge("argmesh_calls_in_flight", "Calls that have not ended.",
              environment_.calls.in_flight());
  sheet.Gauge("argmesh_operations_running", "Operations that have not ended.",
              environment_.operations.running());
  sheet.Gauge("argmesh_draining", "1 once the server is going down.",
              environment_.calls.draining() ? 1 : 0);
  sheet.Counter("argmesh_connections_refused_total",
                "Connections that were closed for want of descriptors.",
                static_cast<double>(acceptor_.refused()));
  sheet.Counter("argmesh_connections_cut_total",
                "Connections that were cut, or not taken after one of the same "
                "address was, because of calls that were reset at once.",
                static_cast<double>(acceptor_.cut()));
  sheet.Gauge("argmesh_unread_answer_bytes",
              "Of answers that are made and not taken.",
              static_cast<double>(environment_.answers.bytes()));
  sheet.Counter("argmesh_unread_answers_cut_total",
                "Answers that were cut because of the memory they took.",
                static_cast<double>(environment_.answers.cut()));
  sheet.Gauge("argmesh_postponed_request_bytes",
              "Of requests that wait until their connection takes its answers.",
              static_cast<double>(environment_.postponed.bytes()));
  sheet.Counter("argmesh_postponed_requests_cut_total",
                "Such requests that were refused because there were too many.",
                static_cast<double>(environment_.postponed.cut()));
  sheet.Gauge("argmesh_slow_request_bytes",
              "Of requests that do not come whole, each as a full message.",
              static_cast<double>(environment_.requests.bytes()));
  sheet.Counter("argmesh_slow_requests_cut_total",
                "Such requests that were cut because there were too many.",
                static_cast<double>(environment_.requests.cut()));
  for (const Admission* admission :
       {&environment_.searches, &environment_.query_streams,
        &environment_.uploads, &environment_.ingests}) {
    const GaugeSheet::Labels labels = {{"class", admission->what()}};
    sheet.Gauge("argmesh_admission_used", "Calls of a class in flight.",
                admission->used(), labels);
    sheet.Gauge("argmesh_admission_limit", "How many there may be.",
                admission->limit(), labels);
  }
}

absl::Status CheckListenAddress(const RpcServerOptions& options) {
  ARGMESH_ASSIGN_OR_RETURN(const ListenAddress address,
                           ParseListenAddress(options.listen));
  const bool encrypts = options.tls.enabled();
  const bool knows_callers =
      options.keys != nullptr || !options.tls.client_authorities.empty();
  if (address.loopback || options.insecure_remote ||
      (encrypts && knows_callers)) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrFormat(
      "refusing to listen on %s: it can be reached from other machines, and "
      "%s. Listen on 127.0.0.1 behind a proxy that does, or pass "
      "--insecure-remote",
      options.listen,
      encrypts ? "callers are not known (--keys, --tls-client-ca)"
               : "calls are not encrypted (--tls-cert, --tls-key)"));
}

absl::StatusOr<std::unique_ptr<RpcServer>> RpcServer::Start(
    const RpcServerOptions& options, Engine& engine, Telemetry& telemetry) {
  ARGMESH_RETURN_IF_ERROR(CheckListenAddress(options));
  ARGMESH_ASSIGN_OR_RETURN(ListenAddress address,
                           ParseListenAddress(options.listen));
  auto impl = std::make_unique<Impl>(options, engine, telemetry);
  ARGMESH_RETURN_IF_ERROR(impl->Listen(options, std::move(address)));
  return std::unique_ptr<RpcServer>(new RpcServer(std::move(impl)));
}

RpcServer::RpcServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RpcServer::~RpcServer() = default;

const std::string& RpcServer::address() const { return impl_->address(); }
int RpcServer::port() const { return impl_->port(); }
std::shared_ptr<grpc::Channel> RpcServer::InProcessChannel() {
  return impl_->InProcessChannel();
}
void RpcServer::SetLimits(const ServiceLimits& limits) {
  impl_->environment().SetLimits(limits);
}
void RpcServer::SetKeys(std::shared_ptr<const KeyRing> keys) {
  impl_->environment().access.SetKeys(std::move(keys));
}
void RpcServer::WriteGauges(GaugeSheet& sheet) const {
  impl_->WriteGauges(sheet);
}
void RpcServer::StopAdvertising() { impl_->StopAdvertising(); }
bool RpcServer::Shutdown(absl::Time deadline) {
  return impl_->Shutdown(deadline);
}

}  // namespace argmesh
