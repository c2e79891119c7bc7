#include "core/mesh/mesh_collapse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "core/mesh/halfedge_mesh.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/plane_quadric.h"

namespace argmesh {
namespace {

constexpr double kPull = 0.05;           // towards the middle, of the weight
constexpr double kSmallestCosine = 0.1;  // between a face's old and new normal
// The stamp of a vertex that is gone; with any other it sums below zero.
constexpr int32_t kGone = std::numeric_limits<int32_t>::min() / 2;
// Costs within a band count as equal and go in the order of the vertices:
// regular meshes are full of equal costs, which rounding must not tell apart.
// While there are more than kCoarse times the target the bands are wide, since
// vertices in order lie near each other in memory.
constexpr int kCoarse = 4;
constexpr double kWideBandsPerOctave = 8;
constexpr double kBandsPerOctave = 64;
constexpr int kStepsPerCheck = 4096;
// An edge that was refused can become possible when its neighbourhood has
// changed; looking again more often brings next to nothing.
constexpr int kMaxRounds = 4;

struct Candidate {
  double cost;
  int32_t a;  // a < b
  int32_t b;
  int32_t stamp;  // both ends unchanged since
};

// Heap order: the cheapest on top. A type, so that the heap inlines it.
struct IsWorse {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.cost != y.cost) return x.cost > y.cost;
    return x.a != y.a ? x.a > y.a : x.b > y.b;
  }
};

// Candidates in heap order. Only the cheap ones are in the heap, so that it
// stays small; the others wait unordered until it is empty.
class CandidateQueue {
 public:
  void Assign(std::vector<Candidate> candidates) {
    waiting_ = std::move(candidates);
    heap_.clear();
    bound_ = -1;
  }

  void Push(const Candidate& candidate) {
    if (candidate.cost > bound_) {
      waiting_.push_back(candidate);
      return;
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), IsWorse());
  }

  // The cheapest candidate; nothing when there is none. Those that `is_current`
  // refuses can be left out.
  template <class Predicate>
  std::optional<Candidate> Pop(const Predicate& is_current) {
    if (heap_.empty()) Refill(is_current);
    if (heap_.empty()) return std::nullopt;
    const Candidate top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end(), IsWorse());
    heap_.pop_back();
    return top;
  }

 private:
  static constexpr size_t kSmallestRefill = 1024;
  static constexpr size_t kRefillsPerQueue = 16;

  template <class Predicate>
  void Refill(const Predicate& is_current) {
    std::erase_if(waiting_,
                  [&](const Candidate& edge) { return !is_current(edge); });
    if (waiting_.empty()) return;
    const size_t count =
        std::min(waiting_.size(),
                 std::max(kSmallestRefill, waiting_.size() / kRefillsPerQueue));
    const auto last = waiting_.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::nth_element(
        waiting_.begin(), last, waiting_.end(),
        [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
    bound_ = last->cost;
    // All of equal cost come along, for the ties.
    const auto rest = std::partition(
        waiting_.begin(), waiting_.end(),
        [this](const Candidate& edge) { return edge.cost > bound_; });
    heap_.assign(rest, waiting_.end());
    waiting_.erase(rest, waiting_.end());
    std::make_heap(heap_.begin(), heap_.end(), IsWorse());
  }

  std::vector<Candidate> heap_;     // cost <= bound_
  std::vector<Candidate> waiting_;  // cost > bound_
  double bound_ = -1;
};

// The lower end of the band that a cost is in.
double LowerBand(double cost, double bands_per_octave) {
  int exponent = 0;
  const double mantissa = std::frexp(cost, &exponent);  // .5 .. 1
  const double bands = 2 * bands_per_octave;
  return std::ldexp(std::floor(bands * mantissa) / bands, exponent);
}

struct Placement {
  Eigen::Vector3d position;
  double cost;
};

class EdgeCollapser {
 public:
  EdgeCollapser(const TriangleMesh& mesh, const CollapseOptions& options,
                HalfedgeMesh halfedges)
      : options_(options),
        V_(mesh.V),
        halfedges_(std::move(halfedges)),
        stamps_(Slot(mesh.num_vertices()), 0),
        alive_(mesh.num_vertices()) {
    const MeshEdges edges = ComputeMeshEdges(mesh.F, mesh.num_vertices());
    quadrics_ = ComputeVertexQuadrics(mesh, edges);
    FillQueue(edges);
  }

  absl::Status Run(const StopToken& stop) {
    for (int round = 0; round < kMaxRounds; ++round) {
      const int before = alive_;
      ARGMESH_RETURN_IF_ERROR(EmptyQueue(stop));
      if (alive_ <= options_.target_vertices || alive_ == before) break;
      FillQueue(ComputeMeshEdges(halfedges_.CopyFaces(),
                                 static_cast<int>(V_.rows())));
    }
    return absl::OkStatus();
  }

  TriangleMesh TakeMesh() {
    TriangleMesh mesh{std::move(V_), halfedges_.CopyFaces()};
    RemoveUnusedVertices(mesh);
    return mesh;
  }

 private:
  void FillQueue(const MeshEdges& edges) {
    std::vector<Candidate> candidates;
    candidates.reserve(edges.size());
    for (const auto& [a, b] : edges.ends) {
      candidates.push_back(MakeCandidate(a, b));
    }
    queue_.Assign(std::move(candidates));
  }

  absl::Status EmptyQueue(const StopToken& stop) {
    const auto is_current = [this](const Candidate& edge) {
      return IsCurrent(edge);
    };
    for (int step = 0; alive_ > options_.target_vertices; ++step) {
      if (step % kStepsPerCheck == 0) ARGMESH_RETURN_IF_ERROR(stop.Check());
      const std::optional<Candidate> edge = queue_.Pop(is_current);
      if (!edge) break;
      if (IsCurrent(*edge)) TryCollapse(*edge);
    }
    return absl::OkStatus();
  }

  bool IsCurrent(const Candidate& edge) const {
    return stamps_[Slot(edge.a)] + stamps_[Slot(edge.b)] == edge.stamp;
  }

  Candidate MakeCandidate(int32_t a, int32_t b) const {
    const bool coarse = alive_ / kCoarse > options_.target_vertices;
    const double cost = LowerBand(
        Place(a, b).cost, coarse ? kWideBandsPerOctave : kBandsPerOctave);
    return {cost, a, b, stamps_[Slot(a)] + stamps_[Slot(b)]};
  }

  Placement Place(int32_t a, int32_t b) const {
    PlaneQuadric quadric = quadrics_[Slot(a)];
    quadric += quadrics_[Slot(b)];
    const Eigen::Vector3d xa = V_.row(a).transpose();
    const Eigen::Vector3d xb = V_.row(b).transpose();
    Eigen::Vector3d middle = (xa + xb) / 2;
    const bool a_on_boundary = halfedges_.IsBoundary(a);
    if (a_on_boundary != halfedges_.IsBoundary(b)) {
      middle = a_on_boundary ? xa : xb;
    }
    const double squared_length = (xa - xb).squaredNorm();
    if (!(quadric.weight() > 0)) return {middle, squared_length};
    Eigen::Vector3d x = quadric.Lowest(middle, kPull);
    if (!((x - middle).squaredNorm() < squared_length)) x = middle;
    const double error = std::max(0.0, quadric.SumAt(x)) / quadric.weight();
    return {x, squared_length + options_.quadric_weight * error};
  }

  void TryCollapse(const Candidate& edge) {
    if (!halfedges_.CanCollapse(edge.b, edge.a)) return;
    const Eigen::Vector3d x = Place(edge.a, edge.b).position;
    if (FlipsAFace(edge.a, edge.b, x) || FlipsAFace(edge.b, edge.a, x)) return;
    halfedges_.Collapse(edge.b, edge.a);
    V_.row(edge.a) = x.transpose();
    quadrics_[Slot(edge.a)] += quadrics_[Slot(edge.b)];
    ++stamps_[Slot(edge.a)];
    stamps_[Slot(edge.b)] = kGone;
    --alive_;
    halfedges_.GetRing(edge.a, ring_);
    for (const int32_t v : ring_) {
      queue_.Push(MakeCandidate(std::min(v, edge.a), std::max(v, edge.a)));
    }
  }

  // Whether moving v to x turns a face around v, but for those that have
  // `gone` as a vertex, or leaves it without area.
  bool FlipsAFace(int32_t v, int32_t gone, const Eigen::Vector3d& x) {
    halfedges_.GetRing(v, ring_);
    const size_t faces = ring_.size() - (halfedges_.IsBoundary(v) ? 1 : 0);
    const Eigen::Vector3d old_x = V_.row(v).transpose();
    for (size_t i = 0; i < faces; ++i) {
      const int32_t p = ring_[i];
      const int32_t q = ring_[i + 1 < ring_.size() ? i + 1 : 0];
      if (p == gone || q == gone) continue;
      const Eigen::Vector3d xp = V_.row(p).transpose();
      const Eigen::Vector3d xq = V_.row(q).transpose();
      const Eigen::Vector3d before = (xp - old_x).cross(xq - old_x);
      const Eigen::Vector3d after = (xp - x).cross(xq - x);
      const double lengths = before.norm() * after.norm();
      if (before.dot(after) < kSmallestCosine * lengths) return true;
      if (lengths == 0 && before.squaredNorm() > 0) return true;
    }
    return false;
  }

  CollapseOptions options_;
  VertexMatrix V_;
  HalfedgeMesh halfedges_;
  std::vector<PlaneQuadric> quadrics_;
  std::vector<int32_t> stamps_;
  int alive_;
  CandidateQueue queue_;
  std::vector<int32_t> ring_;
};

}  // namespace

absl::StatusOr<TriangleMesh> CollapseEdges(const TriangleMesh& mesh,
                                           const CollapseOptions& options,
                                           const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(HalfedgeMesh halfedges,
                           HalfedgeMesh::Create(mesh.F, mesh.num_vertices()));
  EdgeCollapser collapser(mesh, options, std::move(halfedges));
  ARGMESH_RETURN_IF_ERROR(collapser.Run(stop));
  return collapser.TakeMesh();
}

}  // namespace argmesh
