// The optional second look at an answer: by the neighbourhoods of its shapes.
#ifndef ARGMESH_SERVER_ENGINE_SEARCH_RERANKING_H_
#define ARGMESH_SERVER_ENGINE_SEARCH_RERANKING_H_

#include <vector>

#include "absl/status/status.h"
#include "core/base/stop_token.h"
#include "server/engine/compute_pool.h"
#include "server/engine/containment_ranker.h"
#include "server/engine/shape_ranker.h"

namespace argmesh {

// Shapes whose order is looked at again; those after them stay where they are.
inline constexpr int kRerankedShapes = 100;

// Orders the head of `shapes` by RerankShortList over their fused scores with
// the query and with each other; equal ones stay as they were. The scores do
// not change.
//
// Fails    kCancelled, kDeadlineExceeded
// Cost     a match of every pair: 0.4 s of one core
absl::Status RerankShapes(ComputePool& pool, const StopToken& stop,
                          std::vector<RankedShape>& shapes);

// Orders the shapes of a partial search by their scores and by how alike, as
// wholes, they are to the first three that are verified: what is like a shape
// that holds the query probably has such a part too. Nothing changes where
// nothing is verified; the scores do not change.
//
// Fails    kCancelled, kDeadlineExceeded
// Cost     three matches a shape
absl::Status RerankContaining(ComputePool& pool, const StopToken& stop,
                              std::vector<ContainingShape>& shapes);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SEARCH_RERANKING_H_
