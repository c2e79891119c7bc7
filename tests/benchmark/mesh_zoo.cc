// Every mesh file below a folder through parsing and abstraction, each with a
// time cap: a graph or an error with its reason, and nothing else.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <regex>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "core/graph/compute_graph.h"
#include "core/mesh/mesh_format.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Outcome {
  std::string reason = "graph";
  std::string message;
  double seconds = 0;
  int64_t samples = 0;
};

absl::StatusOr<ComputedGraph> Compute(const std::filesystem::path& path,
                                      absl::Duration cap) {
  auto mesh = ReadMesh(path);
  if (!mesh.ok()) return mesh.status();
  return ComputeShapeGraph(*mesh, {}, StopToken({}, absl::Now() + cap));
}

Outcome Try(const std::filesystem::path& path, absl::Duration cap) {
  const absl::Time start = absl::Now();
  const auto computed = Compute(path, cap);
  Outcome outcome;
  outcome.seconds = absl::ToDoubleSeconds(absl::Now() - start);
  if (computed.ok()) {
    outcome.samples = computed->report.sample_vertices;
    return outcome;
  }
  outcome.message = std::string(computed.status().message());
  // Numbers and names would make every reason its own.
  static const std::regex kNumbers("[0-9][0-9.e+-]*|\"[^\"]*\"");
  outcome.reason =
      absl::StatusCodeToString(computed.status().code()) + ": " +
      std::regex_replace(outcome.message.substr(0, 90), kNumbers, "#");
  return outcome;
}

int Run(const std::string& folder, int threads, double cap_seconds) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() &&
        MeshFormatFromPath(entry.path().string()) != MeshFormat::kUnknown) {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Outcome> outcomes(paths.size());
  ParallelFor(paths.size(), threads, [&](size_t i) {
    outcomes[i] = Try(paths[i], absl::Seconds(cap_seconds));
  });
  std::map<std::string, int> counts;
  std::vector<double> seconds;
  size_t slowest = 0;
  size_t largest = 0;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    ++counts[outcomes[i].reason];
    seconds.push_back(outcomes[i].seconds);
    if (outcomes[i].seconds > outcomes[slowest].seconds) slowest = i;
    if (outcomes[i].samples > outcomes[largest].samples) largest = i;
    if (!outcomes[i].message.empty()) {
      std::printf("%s: %s\n", paths[i].c_str(), outcomes[i].message.c_str());
    }
  }
  for (const auto& [reason, count] : counts) {
    std::printf("%6d  %s\n", count, reason.c_str());
  }
  if (seconds.empty()) return 1;
  std::sort(seconds.begin(), seconds.end());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "%zu files; median %.2f s, p95 %.2f s, slowest %.2f s (%s); most samples "
      "%lld (%s); peak memory %ld MiB\n",
      paths.size(), seconds[seconds.size() / 2],
      seconds[seconds.size() * 95 / 100], outcomes[slowest].seconds,
      paths[slowest].c_str(), static_cast<long long>(outcomes[largest].samples),
      paths[largest].c_str(), usage.ru_maxrss / 1024);
  return 0;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  std::string folder;
  int threads = 2;
  double cap_seconds = 120;
  CLI::App app("Every mesh below a folder: a graph or a reason");
  app.add_option("folder", folder)->required();
  app.add_option("--threads", threads);
  app.add_option("--cap", cap_seconds, "Seconds a mesh");
  CLI11_PARSE(app, argc, argv);
  return argmesh::Run(folder, threads, cap_seconds);
}
