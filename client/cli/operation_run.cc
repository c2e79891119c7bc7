#include "client/cli/operation_run.h"

#include <utility>

#include "absl/strings/str_format.h"
#include "client/error_status.h"

namespace argmesh {

OperationRun::OperationRun(const Session& session, std::string label)
    : session_(session), label_(std::move(label)), interrupt_([&session] {
        session.Note(
            "stopping: what is done stays done; Ctrl-C again leaves at once "
            "and the server goes on");
      }) {}

OperationWatch OperationRun::Watch() {
  OperationWatch watch;
  watch.stop = interrupt_.token();
  watch.progress = [this](const v1::OperationMetadata& metadata) {
    if (!progress_ && metadata.items() > 0) {
      progress_.emplace(session_.err, session_.err_is_terminal, label_,
                        static_cast<size_t>(metadata.items()));
    }
    if (progress_) {
      progress_->SetTotal(static_cast<size_t>(metadata.items()));
      progress_->Advance(static_cast<size_t>(metadata.items_done()));
    }
  };
  return watch;
}

void OperationRun::AddFailure(const std::string& key, const std::string& item,
                              const google::rpc::Status& error) {
  progress_.reset();
  const absl::Status status = ToStatus(error);
  session_.Note(absl::StrFormat("failed %s: %s [%s]", item, ErrorText(status),
                                ErrorReason(status)));
  Json failure = {{key, item}};
  failure.update(ErrorToJson(status));
  failures_.push_back(std::move(failure));
}

}  // namespace argmesh
