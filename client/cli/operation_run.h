// A long-running operation of the server, followed from the command line: a
// progress line, Ctrl-C as a cancellation, and an account of what failed.
#ifndef ARGMESH_CLIENT_CLI_OPERATION_RUN_H_
#define ARGMESH_CLIENT_CLI_OPERATION_RUN_H_

#include <optional>
#include <string>

#include "client/cli/interrupt.h"
#include "client/cli/json.h"
#include "client/cli/progress_line.h"
#include "client/cli/session.h"
#include "client/client.h"
#include "google/rpc/status.pb.h"

namespace argmesh {

// Make it before the connection, as Interrupt.
class OperationRun {
 public:
  // `label` is in the progress line.
  OperationRun(const Session& session, std::string label);

  OperationWatch Watch();

  // Notes that `item` failed, and adds it to the failures; `key` is what an
  // item is.
  void AddFailure(const std::string& key, const std::string& item,
                  const google::rpc::Status& error);
  Json TakeFailures() { return std::move(failures_); }

 private:
  const Session& session_;
  const std::string label_;
  const Interrupt interrupt_;
  std::optional<ProgressLine> progress_;
  Json failures_ = Json::array();
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_OPERATION_RUN_H_
