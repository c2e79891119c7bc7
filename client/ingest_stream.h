// One IngestShapes stream: credit, items under way, results.
//
// A reader thread takes the server's messages; sending belongs to one other
// thread. Used by Ingestor only.
#ifndef ARGMESH_CLIENT_INGEST_STREAM_H_
#define ARGMESH_CLIENT_INGEST_STREAM_H_

#include <grpcpp/client_context.h>
#include <grpcpp/support/sync_stream.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "client/client_options.h"

namespace argmesh {

class IngestStream {
 public:
  using OnResult = std::function<void(const v1::IngestItemResult&)>;

  // Opens the stream with the key of `options` and says hello. `on_result` is
  // called by the reader thread. A stream on which nothing comes for `silence`
  // is cut.
  IngestStream(v1::IngestService::Stub& stub, const ClientOptions& options,
               const v1::IngestHello& hello, absl::Duration silence,
               OnResult on_result);
  ~IngestStream();  // cuts the stream when Finish was not called

  // Waits until an item may be begun. False when none may be any more: the
  // stream is over, the server asked for no more, or `stop` was requested.
  bool WaitForCredit(int max_in_flight, const std::stop_token& stop);

  // Sends one item; false when the stream is over. Needs credit.
  bool Send(const v1::IngestItem& item, std::string_view bytes);

  // Half-closes and waits for the results of what was sent, then for the end.
  // The server's status; kDeadlineExceeded when it went silent.
  absl::Status Finish();

 private:
  void ReadAll();
  void TakeMessage(const v1::IngestShapesResponse& response);
  bool MayBegin(int max_in_flight) const;
  // Waits for `ready` or the end of the stream, cutting it when it is silent.
  void WaitUntil(std::unique_lock<std::mutex>& lock,
                 const std::function<bool()>& ready);

  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::IngestShapesRequest,
                                           v1::IngestShapesResponse>>
      stream_;
  const absl::Duration silence_;
  const OnResult on_result_;

  std::mutex mutex_;
  std::condition_variable changed_;
  // Guarded by mutex_.
  int64_t credit_items_ = 0;
  int64_t credit_bytes_ = 0;
  std::set<std::string> in_flight_;  // keys
  bool going_away_ = false;
  bool over_ = false;    // the reader has seen the end
  bool silent_ = false;  // cut because nothing came
  std::chrono::steady_clock::time_point last_message_;

  bool finished_ = false;
  std::thread reader_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_INGEST_STREAM_H_
