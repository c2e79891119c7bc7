// Stores many shapes over IngestService.IngestShapes: as much at a time as the
// server gives credit for, one outcome for every entry, and on with the rest
// when the server goes away and comes back.
//
//   Ingestor ingestor(*client, options);
//   absl::Status status = ingestor.Run(entries, [](const IngestOutcome& o) {
//     ...
//   });
//
// An entry whose outcome is OK is durable and searchable. Entries that were
// under way when a connection broke are sent again with the same request_id,
// so that none is lost and none is stored twice.
#ifndef ARGMESH_CLIENT_INGESTOR_H_
#define ARGMESH_CLIENT_INGESTOR_H_

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "client/client.h"

namespace argmesh {

// One shape to be stored.
struct IngestEntry {
  std::string shape_id;
  std::string display_name;
  std::string source_uri;
  std::map<std::string, std::string> metadata;
  v1::MeshFormat format = v1::MESH_FORMAT_UNSPECIFIED;
  // The bytes of the file; called when the entry's turn comes, and again when
  // it has to be sent again. Its error becomes the entry's outcome.
  std::function<absl::StatusOr<std::string>()> read;
};

// What to do with an entry once its bytes are known.
enum class IngestDecision { kSend, kSkip };

struct IngestOptions {
  std::string collection;  // `collections/{collection}`
  bool create_if_absent = false;
  // Of a collection made by this; another one that exists with other settings
  // is then refused. The server's choice, and any collection, when absent.
  std::optional<v1::CollectionSettings> settings;
  // What becomes of a stored shape of the same id.
  v1::ExistingShapePolicy existing = v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH;
  // Entries under way at a time, beside what the server allows; 0: no limit.
  int max_in_flight = 0;
  // A stream on which the server says nothing for so long is cut; > the time
  // that the largest mesh takes.
  absl::Duration silence = absl::Minutes(10);
  // Attempts to reach the server without any new outcome between them.
  RetryOptions reconnect{.max_attempts = 8,
                         .initial_backoff = absl::Milliseconds(200),
                         .max_backoff = absl::Seconds(10)};
  // Asked before an entry is sent for the first time, with its SHA-256 in
  // hexadecimal digits; every entry is sent when absent. kSkip: it is there
  // already. An error becomes the outcome.
  std::function<absl::StatusOr<IngestDecision>(size_t index,
                                               const std::string& sha256)>
      decide;
};

// What became of one entry.
struct IngestOutcome {
  size_t index = 0;          // of the entry
  absl::Status status = {};  // OK: stored
  // It was there before this run: skipped by `decide`, or so the server says.
  bool already_stored = false;
  v1::Shape shape = {};  // of stored entries that were not skipped
};

class Ingestor {
 public:
  // `client` must outlive the object.
  Ingestor(Client& client, IngestOptions options);

  // Calls `report` exactly once for every entry it got an outcome for, from
  // one thread at a time. OK when that is every one of them.
  //
  // After a stop request nothing new is sent, what is under way is still
  // waited for, and the answer is kCancelled.
  //
  // Fails    kCancelled         stopped; entries without a report are not
  // stored
  //                             as far as is known
  //          kUnavailable       the server stayed away
  //          kDeadlineExceeded  the server went silent
  //          others             the stream was refused, such as kNotFound
  absl::Status Run(std::span<const IngestEntry> entries,
                   const std::function<void(const IngestOutcome&)>& report,
                   std::stop_token stop = {});

 private:
  Client& client_;
  IngestOptions options_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_INGESTOR_H_
