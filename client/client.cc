#include "client/client.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/support/channel_arguments.h>

#include <algorithm>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_format.h"
#include "client/channel_credentials.h"
#include "client/client_parts.h"
#include "client/request_id.h"
#include "core/base/status_macros.h"

namespace argmesh {

void Client::Parts::Prepare(absl::Time deadline,
                            grpc::ClientContext& context) const {
  if (deadline != absl::InfiniteFuture()) {
    context.set_deadline(absl::ToChronoTime(deadline));
  }
  AddKey(options, context);
}

void Client::Parts::Wait(absl::Duration wait,
                         const std::stop_token& stop) const {
  const absl::Time end = absl::Now() + wait;
  while (absl::Now() < end && !stop.stop_requested()) {
    const absl::Time next = std::min(end, absl::Now() + absl::Milliseconds(50));
    channel->WaitForConnected(absl::ToChronoTime(next));
    absl::SleepFor(next - absl::Now());
  }
}

absl::Status Client::Parts::Explain(const grpc::Status& status) const {
  return Explain(ToStatus(status));
}

absl::Status Client::Parts::Explain(const absl::Status& status) const {
  if (status.code() == absl::StatusCode::kDeadlineExceeded &&
      ErrorReason(status).empty()) {
    return absl::DeadlineExceededError(
        absl::StrFormat("no answer from %s within %s", target,
                        absl::FormatDuration(options.call_timeout)));
  }
  if (!IsUnreachable(status)) return status;
  // "failed to connect to all addresses; last error: ...: Connection refused"
  std::string why(status.message());
  why.erase(0, why.rfind(": ") + 1);
  absl::StripAsciiWhitespace(&why);
  return absl::UnavailableError(
      absl::StrFormat("no argmesh server answers at %s (%s)", target, why));
}

absl::StatusOr<std::unique_ptr<Client>> Client::Connect(
    std::string_view target, const ClientOptions& options) {
  if (target.find(':') == std::string_view::npos) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "server address \"%s\" is not HOST:PORT", std::string(target)));
  }
  if (options.call_timeout <= absl::ZeroDuration() ||
      options.retry.max_attempts < 1) {
    return absl::InvalidArgumentError(
        "call_timeout must be above 0 and max_attempts at least 1");
  }
  grpc::ChannelArguments arguments;
  arguments.SetUserAgentPrefix(options.user_agent);
  // Attempts are made and spaced here; gRPC's own second of waiting between
  // two connections would make them all fail alike.
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2000);
  // A peer that has vanished without a word ends the calls in flight.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  ARGMESH_ASSIGN_OR_RETURN(const auto credentials,
                           MakeChannelCredentials(options.tls, arguments));
  auto parts = std::make_unique<Parts>();
  parts->target = std::string(target);
  parts->options = options;
  parts->channel =
      grpc::CreateCustomChannel(parts->target, credentials, arguments);
  parts->collections = v1::CollectionService::NewStub(parts->channel);
  parts->shapes = v1::ShapeService::NewStub(parts->channel);
  parts->ingest = v1::IngestService::NewStub(parts->channel);
  parts->search = v1::SearchService::NewStub(parts->channel);
  parts->admin = v1::AdminService::NewStub(parts->channel);
  parts->operations = google::longrunning::Operations::NewStub(parts->channel);
  parts->next_seed = static_cast<uint64_t>(absl::GetCurrentTimeNanos());
  return std::unique_ptr<Client>(new Client(std::move(parts)));
}

Client::Client(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Client::~Client() = default;

const std::string& Client::target() const { return parts_->target; }
const ClientOptions& Client::options() const { return parts_->options; }

absl::StatusOr<v1::Collection> Client::CreateCollection(
    v1::CreateCollectionRequest request) {
  FillRequestId(request);
  return parts_->Call<v1::Collection>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->collections->CreateCollection(context, request,
                                                     response);
      });
}

absl::StatusOr<v1::Collection> Client::GetCollection(std::string_view name) {
  v1::GetCollectionRequest request;
  request.set_name(std::string(name));
  return parts_->Call<v1::Collection>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->collections->GetCollection(context, request, response);
      });
}

absl::StatusOr<v1::ListCollectionsResponse> Client::ListCollections(
    const v1::ListCollectionsRequest& request) {
  return parts_->Call<v1::ListCollectionsResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->collections->ListCollections(context, request, response);
      });
}

absl::Status Client::ForEachCollection(
    const std::function<bool(const v1::Collection&)>& visit) {
  v1::ListCollectionsRequest request;
  request.set_page_size(kPageSize);
  do {
    ARGMESH_ASSIGN_OR_RETURN(const v1::ListCollectionsResponse page,
                             ListCollections(request));
    for (const v1::Collection& collection : page.collections()) {
      if (!visit(collection)) return absl::OkStatus();
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return absl::OkStatus();
}

absl::StatusOr<v1::Collection> Client::UpdateCollection(
    v1::UpdateCollectionRequest request) {
  FillRequestId(request);
  return parts_->Call<v1::Collection>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->collections->UpdateCollection(context, request,
                                                     response);
      });
}

absl::Status Client::DeleteCollection(v1::DeleteCollectionRequest request) {
  FillRequestId(request);
  return parts_
      ->Call<v1::DeleteCollectionResponse>(
          Repeat::kSafe,
          [&](grpc::ClientContext* context, auto* response) {
            return parts_->collections->DeleteCollection(context, request,
                                                         response);
          })
      .status();
}

absl::StatusOr<v1::GetServerInfoResponse> Client::GetServerInfo() {
  const v1::GetServerInfoRequest request;
  return parts_->Call<v1::GetServerInfoResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->admin->GetServerInfo(context, request, response);
      });
}

}  // namespace argmesh
