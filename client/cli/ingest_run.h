// What `argmesh ingest` does: files to shapes, with an account of every file.
#ifndef ARGMESH_CLIENT_CLI_INGEST_RUN_H_
#define ARGMESH_CLIENT_CLI_INGEST_RUN_H_

#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/cli/json.h"
#include "client/cli/label_table.h"
#include "client/cli/mesh_files.h"
#include "client/cli/session.h"
#include "client/client.h"
#include "client/ingestor.h"

namespace argmesh {

struct IngestArguments {
  std::string collection;
  std::string labels;         // empty for none
  int jobs = 0;               // 0: what the server gives credit for
  std::string decomposition;  // empty: the server's choice
  bool replace = false;
  bool verbose = false;
  std::vector<std::string> paths;
};

struct IngestFailure {
  std::string path;
  std::string reason;
  std::string message;
};

// The account of a run.
struct IngestSummary {
  std::string collection;
  int64_t ingested = 0;
  int64_t already_stored = 0;
  int64_t remaining = 0;    // files without an outcome: the run ended early
  int64_t unlabelled = 0;   // with --labels: stored without a class
  int64_t other_class = 0;  // stored before, with another class
  std::vector<IngestFailure> failures;  // in the order of the files
  double seconds = 0;
};

Json ToJson(const IngestSummary& summary);
// For people, one or more lines.
std::string ToText(const IngestSummary& summary);

// Failures of files are in the summary; the error is of the run as a whole.
struct IngestAccount {
  IngestSummary summary;
  absl::Status end;
};

// Fails before anything is sent: unreadable labels, a bad id, no server.
absl::StatusOr<IngestAccount> RunIngest(const Session& session,
                                        const IngestArguments& arguments,
                                        const std::stop_token& stop);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_INGEST_RUN_H_
