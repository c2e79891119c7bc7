#include "server/rpc/convert_run.h"

#include "server/rpc/convert_collection.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/service_environment.h"
#include "server/rpc/status.h"

namespace argmesh {

v1::ReindexCollectionResponse ReindexAnswer(const ReindexReport& report) {
  v1::ReindexCollectionResponse out;
  out.set_reindexed(report.run.done);
  out.set_failed(report.run.failed);
  *out.mutable_collection() = ToProto(report.collection);
  for (const ItemFailure& failure : report.run.failures) {
    if (out.ByteSizeLong() > kMaxAnswerBytes) break;
    v1::ReindexFailure& added = *out.add_failures();
    added.set_shape(ShapeName(report.collection.id, failure.item));
    *added.mutable_error() = ToProtoStatus(failure.status);
  }
  return out;
}

v1::ImportShapesResponse ImportAnswer(const RunReport& report) {
  v1::ImportShapesResponse out;
  out.set_imported(report.done);
  out.set_already_stored(report.were_done);
  out.set_failed(report.failed);
  for (const ItemFailure& failure : report.failures) {
    if (out.ByteSizeLong() > kMaxAnswerBytes) break;
    v1::ImportFailure& added = *out.add_failures();
    added.set_path(failure.item);
    *added.mutable_error() = ToProtoStatus(failure.status);
  }
  return out;
}

}  // namespace argmesh
