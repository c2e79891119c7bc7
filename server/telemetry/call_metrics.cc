#include "server/telemetry/call_metrics.h"

#include <string>

namespace argmesh {
namespace {

// Seconds; from a read of one row to an ingest stream of an hour.
const prometheus::Histogram::BucketBoundaries kSeconds = {
    0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
    0.5,    1,     2.5,    5,     10,   30,    60,   300, 3600};

prometheus::Labels LabelsOf(std::string_view method) {
  const MethodName name = FullName(method);
  return {{"grpc_service", name.service}, {"grpc_method", name.method}};
}

}  // namespace

CallMetrics::CallMetrics()
    : registry_(std::make_shared<prometheus::Registry>()),
      started_(prometheus::BuildCounter()
                   .Name("grpc_server_started_total")
                   .Help("Calls that have come in.")
                   .Register(*registry_)),
      handled_(prometheus::BuildCounter()
                   .Name("grpc_server_handled_total")
                   .Help("Calls that have ended, by status code.")
                   .Register(*registry_)),
      handling_(prometheus::BuildHistogram()
                    .Name("grpc_server_handling_seconds")
                    .Help("From a call's arrival to its end.")
                    .Register(*registry_)),
      queueing_(prometheus::BuildHistogram()
                    .Name("argmesh_queue_wait_seconds")
                    .Help("From a call's arrival to its turn on a thread.")
                    .Register(*registry_)),
      errors_(prometheus::BuildCounter()
                  .Name("argmesh_errors_total")
                  .Help("Calls that have failed, by reason.")
                  .Register(*registry_)),
      items_(prometheus::BuildCounter()
                 .Name("argmesh_ingest_items_total")
                 .Help("Items of ingest streams; reason \"\": stored.")
                 .Register(*registry_)),
      search_stages_(prometheus::BuildHistogram()
                         .Name("argmesh_search_stage_seconds")
                         .Help("Time of each stage of the searches.")
                         .Register(*registry_)) {}

void CallMetrics::Started(std::string_view method) {
  started_.Add(LabelsOf(method)).Increment();
}

void CallMetrics::Finished(const CallRecord& record) {
  const prometheus::Labels labels = LabelsOf(record.method);
  handling_.Add(labels, kSeconds)
      .Observe(absl::ToDoubleSeconds(record.end - record.begin));
  if (record.work_begin < record.end) {
    queueing_.Add(labels, kSeconds)
        .Observe(absl::ToDoubleSeconds(record.work_begin - record.begin));
  }
  prometheus::Labels with_code = labels;
  with_code["grpc_code"] = absl::StatusCodeToString(record.code);
  handled_.Add(with_code).Increment();
  if (!record.reason.empty()) {
    errors_.Add({{"reason", record.reason}}).Increment();
  }
}

void CallMetrics::ItemFinished(std::string_view reason) {
  items_.Add({{"reason", std::string(reason)}}).Increment();
}

void CallMetrics::SearchStageFinished(std::string_view mode,
                                      std::string_view stage,
                                      absl::Duration elapsed) {
  search_stages_
      .Add({{"mode", std::string(mode)}, {"stage", std::string(stage)}},
           kSeconds)
      .Observe(absl::ToDoubleSeconds(elapsed));
}

}  // namespace argmesh
