#include "client/cli/ingest_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "client/cli/decomposition_option.h"
#include "client/cli/progress_line.h"
#include "client/error_status.h"
#include "client/resource_name.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

struct StoredShape {
  std::string sha256;
  std::string label;
};
using StoredShapes = std::map<std::string, StoredShape>;

// What the collection holds already; nothing when there is none.
absl::StatusOr<StoredShapes> FindStoredShapes(Client& client,
                                              const std::string& collection) {
  StoredShapes stored;
  const absl::Status status = client.ForEachShape(
      CollectionName(collection), [&stored](const v1::Shape& shape) {
        stored[ResourceId(shape.name())] = {shape.mesh().sha256(),
                                            ClassOf(shape)};
        return true;
      });
  if (!status.ok() && status.code() != absl::StatusCode::kNotFound) {
    return status;
  }
  return stored;
}

std::optional<v1::CollectionSettings> SettingsOf(
    const std::string& decomposition) {
  if (decomposition.empty()) return std::nullopt;
  v1::CollectionSettings settings;
  settings.set_decomposition(DecompositionOf(decomposition));
  return settings;
}

// One run of ingest: the files, their labels and what became of them.
class IngestJob {
 public:
  IngestJob(const Session& session, const IngestArguments& arguments)
      : session_(session), arguments_(arguments) {}

  absl::Status Prepare();
  absl::Status Run(const std::stop_token& stop);
  IngestSummary TakeSummary();

 private:
  std::vector<IngestEntry> MakeEntries();
  absl::StatusOr<IngestDecision> Decide(size_t index,
                                        const std::string& sha256);
  void Report(const IngestOutcome& outcome, ProgressLine& progress);

  const Session& session_;
  const IngestArguments& arguments_;
  std::unique_ptr<Client> client_;
  int64_t max_mesh_bytes_ = 0;
  std::optional<v1::CollectionSettings> settings_;
  std::vector<MeshFile> files_;
  std::vector<std::string> classes_;  // of the files; empty for none
  StoredShapes stored_;
  std::map<size_t, IngestFailure> failures_;  // by file
  IngestSummary summary_;
};

absl::Status IngestJob::Prepare() {
  if (const absl::Status id =
          CheckIdentifier("collection", arguments_.collection);
      !id.ok()) {
    return UsageError(std::string(id.message()));
  }
  settings_ = SettingsOf(arguments_.decomposition);
  ARGMESH_ASSIGN_OR_RETURN(files_, FindMeshFiles(arguments_.paths));
  classes_.resize(files_.size());
  if (!arguments_.labels.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(const LabelTable labels,
                             LabelTable::Read(arguments_.labels));
    for (size_t i = 0; i < files_.size(); ++i) {
      const auto label = labels.ClassOf(files_[i]);
      if (label) {
        classes_[i] = *label;
      } else {
        ++summary_.unlabelled;
      }
    }
    if (const size_t unused = labels.Unused(files_).size(); unused > 0) {
      session_.Note(
          absl::StrFormat("%d of %d paths in %s are no file of this ingest",
                          unused, labels.size(), arguments_.labels));
    }
  }
  ARGMESH_ASSIGN_OR_RETURN(client_, session_.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::GetServerInfoResponse info,
                           client_->GetServerInfo());
  max_mesh_bytes_ = info.limits().max_mesh_bytes();
  ARGMESH_ASSIGN_OR_RETURN(stored_,
                           FindStoredShapes(*client_, arguments_.collection));
  return absl::OkStatus();
}

std::vector<IngestEntry> IngestJob::MakeEntries() {
  std::vector<IngestEntry> entries;
  for (size_t i = 0; i < files_.size(); ++i) {
    IngestEntry entry;
    entry.shape_id = files_[i].shape_id;
    entry.source_uri = files_[i].relative;
    if (!classes_[i].empty()) entry.metadata["class"] = classes_[i];
    entry.format = files_[i].format;
    entry.read = [path = files_[i].path, limit = max_mesh_bytes_] {
      return ReadFile(path, limit);
    };
    entries.push_back(std::move(entry));
  }
  return entries;
}

absl::StatusOr<IngestDecision> IngestJob::Decide(size_t index,
                                                 const std::string& sha256) {
  const auto found = stored_.find(files_[index].shape_id);
  if (found == stored_.end() || found->second.sha256 != sha256) {
    return IngestDecision::kSend;
  }
  const std::string& label = classes_[index];
  if (label.empty() || label == found->second.label) {
    return IngestDecision::kSkip;
  }
  if (arguments_.replace) return IngestDecision::kSend;
  ++summary_.other_class;
  return IngestDecision::kSkip;
}

void IngestJob::Report(const IngestOutcome& outcome, ProgressLine& progress) {
  const MeshFile& file = files_[outcome.index];
  if (!outcome.status.ok()) {
    std::string reason = ErrorReason(outcome.status);
    if (reason.empty()) {
      reason = absl::StatusCodeToString(outcome.status.code());
    }
    IngestFailure failure{file.path.string(), reason,
                          ErrorText(outcome.status)};
    progress.Print(absl::StrFormat("failed %s: %s [%s]", failure.path,
                                   failure.message, failure.reason));
    failures_[outcome.index] = std::move(failure);
  } else if (outcome.already_stored) {
    ++summary_.already_stored;
  } else {
    ++summary_.ingested;
  }
  if (outcome.status.ok() && arguments_.verbose) {
    progress.Print((outcome.already_stored ? "kept " : "stored ") +
                   file.shape_id + " " + file.path.string());
  }
  progress.Advance(
      static_cast<size_t>(summary_.ingested + summary_.already_stored) +
      failures_.size());
}

absl::Status IngestJob::Run(const std::stop_token& stop) {
  const absl::Time start = absl::Now();
  const std::vector<IngestEntry> entries = MakeEntries();
  IngestOptions options;
  options.collection = CollectionName(arguments_.collection);
  options.create_if_absent = true;
  options.settings = settings_;
  options.existing = arguments_.replace
                         ? v1::EXISTING_SHAPE_POLICY_REPLACE
                         : v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH;
  options.max_in_flight = arguments_.jobs;
  options.decide = [this](size_t index, const std::string& sha256) {
    return Decide(index, sha256);
  };
  Ingestor ingestor(*client_, std::move(options));
  ProgressLine progress(session_.err, session_.err_is_terminal, "ingest",
                        files_.size());
  absl::Status status = ingestor.Run(
      entries, [&](const IngestOutcome& outcome) { Report(outcome, progress); },
      stop);
  summary_.seconds = absl::ToDoubleSeconds(absl::Now() - start);
  return status;
}

IngestSummary IngestJob::TakeSummary() {
  summary_.collection = arguments_.collection;
  for (auto& [index, failure] : failures_) {
    summary_.failures.push_back(std::move(failure));
  }
  summary_.remaining =
      static_cast<int64_t>(files_.size() - summary_.failures.size()) -
      summary_.ingested - summary_.already_stored;
  return std::move(summary_);
}

}  // namespace

Json ToJson(const IngestSummary& summary) {
  Json failures = Json::array();
  for (const IngestFailure& failure : summary.failures) {
    failures.push_back({{"path", failure.path},
                        {"reason", failure.reason},
                        {"message", failure.message}});
  }
  return {{"collection", summary.collection},
          {"ingested", summary.ingested},
          {"already_stored", summary.already_stored},
          {"failed", summary.failures.size()},
          {"remaining", summary.remaining},
          {"unlabelled", summary.unlabelled},
          {"other_class", summary.other_class},
          {"failures", std::move(failures)},
          {"seconds", summary.seconds}};
}

std::string ToText(const IngestSummary& summary) {
  std::string text = absl::StrFormat(
      "%s: %d ingested, %d already stored, %d failed in %.1f s",
      summary.collection, summary.ingested, summary.already_stored,
      summary.failures.size(), summary.seconds);
  if (summary.ingested > 0 && summary.seconds > 0) {
    text += absl::StrFormat(
        " (%.1f shapes/s)",
        static_cast<double>(summary.ingested) / summary.seconds);
  }
  text += '\n';
  if (summary.remaining > 0) {
    text += absl::StrFormat(
        "%d files were not stored; the same command goes on with them\n",
        summary.remaining);
  }
  if (summary.unlabelled > 0) {
    text += absl::StrFormat("%d files are not in the labels: no class\n",
                            summary.unlabelled);
  }
  if (summary.other_class > 0) {
    text += absl::StrFormat(
        "%d shapes were stored before with another class; --replace changes "
        "it\n",
        summary.other_class);
  }
  return text;
}

absl::StatusOr<IngestAccount> RunIngest(const Session& session,
                                        const IngestArguments& arguments,
                                        const std::stop_token& stop) {
  IngestJob job(session, arguments);
  ARGMESH_RETURN_IF_ERROR(job.Prepare());
  IngestAccount account;
  account.end = job.Run(stop);
  account.summary = job.TakeSummary();
  return account;
}

}  // namespace argmesh
