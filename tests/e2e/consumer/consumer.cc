// Compares two shapes with the core alone, and asks a server that is not there.
#include <cstdio>

#include "client/client.h"
#include "client/error_status.h"
#include "core/graph/compute_graph.h"
#include "core/matching/match.h"
#include "core/mesh/mesh_format.h"

namespace {

// A box of these sides.
argmesh::TriangleMesh Box(double x, double y, double z) {
  std::string off = "OFF\n8 6 0\n";
  for (int corner = 0; corner < 8; ++corner) {
    off += std::to_string(corner & 1 ? x : 0) + " " +
           std::to_string(corner & 2 ? y : 0) + " " +
           std::to_string(corner & 4 ? z : 0) + "\n";
  }
  off += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  return argmesh::ParseMesh(off)->mesh;
}

}  // namespace

int main() {
  const auto cube = argmesh::ComputeShapeGraph(Box(1, 1, 1));
  const auto beam = argmesh::ComputeShapeGraph(Box(1, 1, 9));
  if (!cube.ok() || !beam.ok()) return 1;
  const argmesh::MatchableGraph a(cube->graph), b(beam->graph);
  const double same = argmesh::MatchGlobal(a, a).score;
  const double other = argmesh::MatchGlobal(a, b).score;
  std::printf("same %.3f, other %.3f\n", same, other);

  argmesh::ClientOptions options;
  options.call_timeout = absl::Seconds(1);
  const auto client = argmesh::Client::Connect("127.0.0.1:1", options);
  if (!client.ok()) return 1;
  const absl::Status status = (*client)->GetServerInfo().status();
  return same == 1 && other < same && argmesh::IsUnreachable(status) ? 0 : 1;
}
