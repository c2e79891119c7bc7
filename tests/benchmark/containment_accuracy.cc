// How well pieces of shapes are found in a gallery: ranks of the source and of
// its class, what is verified, and the time of each stage. Queries come from
// make_variants. Shapes at odd places of the first gallery's labels.tsv (1st,
// 3rd ..) and queries cut from them are reported apart from the others: the
// codebook was made from the former.
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "core/containment/containment_ranking.h"
#include "core/containment/query_windows.h"
#include "core/containment/target_windows.h"
#include "core/containment/window_codec.h"
#include "core/containment/window_words.h"
#include "core/mesh/mesh_repair.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::vector<std::string> galleries;  // folder or folder=prefix of paths
  std::vector<std::string> queries;    // folders of make_variants
  RankContainmentOptions rank;
  int threads = 2;
  int every = 1;
  std::string only;  // query paths that begin so
  int rows = 0;      // answers listed for each query; 0: none
};

struct Shape {
  std::string path, label;
  bool odd = false;
  std::shared_ptr<const TargetWindows> windows;
};

struct Query {
  std::string path, label, source;
};

double Seconds(const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

// CPU time of this thread: what other work on the machine does not lengthen.
double ThreadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

struct Gallery {
  std::vector<Shape> shapes;
  WindowIndex index;
};

absl::StatusOr<std::vector<Shape>> ListShapes(const Options& options,
                                              std::vector<std::string>& files) {
  std::vector<Shape> shapes;
  for (const std::string& argument : options.galleries) {
    const size_t equals = argument.find('=');
    const std::string folder = argument.substr(0, equals);
    const std::string prefix =
        equals == std::string::npos ? "" : argument.substr(equals + 1);
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<LabelledMesh> items,
                             ReadLabels(folder));
    for (size_t i = 0; i < items.size(); ++i) {
      if (!items[i].path.starts_with(prefix)) continue;
      shapes.push_back({items[i].path, items[i].label,
                        i % 2 == 0 && &argument == &options.galleries[0],
                        nullptr});
      files.push_back(folder + "/" + items[i].path);
    }
  }
  return shapes;
}

absl::StatusOr<Gallery> MakeGallery(const Options& options) {
  Gallery gallery;
  std::vector<std::string> files;
  ARGMESH_ASSIGN_OR_RETURN(gallery.shapes, ListShapes(options, files));
  const size_t n = gallery.shapes.size();
  std::vector<absl::Status> statuses(n);
  std::vector<double> seconds(n, 0);
  std::vector<std::array<size_t, 2>> bytes(n);
  std::vector<WindowWords> words(n);
  ParallelFor(n, options.threads, [&](size_t i) {
    statuses[i] = [&]() -> absl::Status {
      ARGMESH_ASSIGN_OR_RETURN(const TriangleMesh mesh, ReadMesh(files[i]));
      ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(mesh));
      absl::StatusOr<TargetWindows> windows;
      seconds[i] =
          Seconds([&] { windows = ExtractTargetWindows(repaired.mesh); });
      ARGMESH_RETURN_IF_ERROR(windows.status());
      words[i] = AssignWindowWords(*windows);
      bytes[i] = {SerializeWindowWords(words[i]).size(),
                  SerializeTargetWindows(*windows).size()};
      gallery.shapes[i].windows =
          std::make_shared<const TargetWindows>(*std::move(windows));
      return absl::OkStatus();
    }();
  });
  double word_bytes = 0;
  double window_bytes = 0;
  for (size_t i = 0; i < n; ++i) {
    ARGMESH_RETURN_IF_ERROR(statuses[i]);
    gallery.index.Set(static_cast<int64_t>(i), words[i]);
    word_bytes += static_cast<double>(bytes[i][0]) / static_cast<double>(n);
    window_bytes += static_cast<double>(bytes[i][1]) / static_cast<double>(n);
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf(
      "gallery: %zu shapes, windows in %.3f s (median; most %.3f), %.0f + %.0f "
      "bytes a shape\n",
      n, seconds[n / 2], seconds.back(), word_bytes, window_bytes);
  return gallery;
}

absl::StatusOr<std::vector<Query>> ReadQueries(const std::string& folder) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           ReadFile(folder + "/queries.tsv"));
  std::vector<Query> queries;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    Query query;
    std::getline(fields, query.path, '\t');
    std::getline(fields, query.label, '\t');
    std::getline(fields, query.source, '\t');
    if (!query.path.empty()) queries.push_back(std::move(query));
  }
  return queries;
}

constexpr std::array<const char*, 15> kColumns = {
    "NN",      "FT", "source1", "top5",  "loaded", "accept", "other", "tied",
    "generic", "Dq", "extract", "index", "exact",  "verify", "cpu"};
using Row = std::array<double, kColumns.size()>;

// What one query came to.
struct Outcome {
  bool odd = false;
  bool counted = false;
  Row row{};
};

Row Judge(const Gallery& gallery, const Query& query,
          const ContainmentRanking& ranking, size_t source) {
  int relevant = 0;
  for (size_t i = 0; i < gallery.shapes.size(); ++i) {
    if (i != source && gallery.shapes[i].label == query.label) ++relevant;
  }
  Row row{};
  int place = 0;
  int others = 0;
  double found = 0;
  for (const RankedContainment& ranked : ranking.matches) {
    const auto slot = static_cast<size_t>(ranked.slot);
    const bool accepted = ranked.match.verified && !ranking.generic;
    const bool same = gallery.shapes[slot].label == query.label;
    if (slot == source) {
      row[2] = place == 0;
      row[3] = place < 5;
      row[4] = 1;
      row[5] = accepted;
    } else {
      if (others == 0) row[0] = same;
      if (others < relevant && same) ++found;
      ++others;
      if (accepted && !same) row[6] = 1;
    }
    if (place == 0) row[7] = ranked.tied;
    ++place;
  }
  row[1] = relevant > 0 ? found / relevant : 0;
  row[8] = ranking.generic;
  row[9] = ranking.distinctiveness;
  row[11] = absl::ToDoubleSeconds(ranking.index_time);
  row[12] = absl::ToDoubleSeconds(ranking.exact_time);
  row[13] = absl::ToDoubleSeconds(ranking.verify_time);
  return row;
}

// The first answers and the source's.
void PrintRow(const Gallery& gallery, const Query& query,
              const ContainmentRanking& ranking, size_t count) {
  std::printf("%s Dq %.2f%s", query.path.c_str(), ranking.distinctiveness,
              ranking.generic ? " generic" : "");
  for (size_t i = 0; i < ranking.matches.size(); ++i) {
    const ContainmentMatch& match = ranking.matches[i].match;
    const std::string& path =
        gallery.shapes[static_cast<size_t>(ranking.matches[i].slot)].path;
    if (i >= count && path != query.source) continue;
    std::printf("; %zu %s S %.3f C %.3f F %.3f places %zu%s", i + 1,
                path.c_str(), match.votes, match.coarse_cover, match.fine_cover,
                match.other_places.size() + 1, match.flipped ? " flipped" : "");
  }
  std::printf("\n");
}

absl::StatusOr<Outcome> RunQuery(const Gallery& gallery,
                                 const std::string& folder, const Query& query,
                                 const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const TriangleMesh mesh,
                           ReadMesh(folder + "/" + query.path));
  ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(mesh));
  absl::StatusOr<QueryWindows> windows;
  const double extract =
      Seconds([&] { windows = ExtractQueryWindows(repaired.mesh); });
  ARGMESH_RETURN_IF_ERROR(windows.status());
  RankContainmentOptions rank = options.rank;
  rank.limit = static_cast<int>(gallery.shapes.size());
  const double start = ThreadSeconds();
  ARGMESH_ASSIGN_OR_RETURN(
      const ContainmentRanking ranking,
      RankContainment(
          *windows, gallery.index,
          [&gallery](int64_t slot)
              -> absl::StatusOr<std::shared_ptr<const TargetWindows>> {
            return gallery.shapes[static_cast<size_t>(slot)].windows;
          },
          rank));
  const double cpu = ThreadSeconds() - start;
  const auto source = std::find_if(
      gallery.shapes.begin(), gallery.shapes.end(),
      [&query](const Shape& shape) { return shape.path == query.source; });
  Outcome outcome;
  outcome.counted = true;
  outcome.odd = source != gallery.shapes.end() && source->odd;
  outcome.row = Judge(gallery, query, ranking,
                      static_cast<size_t>(source - gallery.shapes.begin()));
  outcome.row[10] = extract;
  outcome.row[14] = cpu;
  if (options.rows > 0) {
    PrintRow(gallery, query, ranking, static_cast<size_t>(options.rows));
  }
  return outcome;
}

void PrintMean(const std::string& name, const std::vector<Outcome>& outcomes,
               int parity) {
  Row mean{};
  int count = 0;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.counted || (parity >= 0 && outcome.odd != (parity == 1))) {
      continue;
    }
    ++count;
    for (size_t c = 0; c < mean.size(); ++c) mean[c] += outcome.row[c];
  }
  std::printf("%-28s %4d", name.c_str(), count);
  for (const double x : mean) std::printf(" %7.3f", x / std::max(1, count));
  std::printf("\n");
}

absl::Status RunFolder(const Gallery& gallery, const std::string& folder,
                       const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<Query> queries,
                           ReadQueries(folder));
  std::vector<Outcome> outcomes(queries.size());
  std::vector<absl::Status> statuses(queries.size());
  ParallelFor(queries.size(), options.threads, [&](size_t i) {
    if (i % static_cast<size_t>(options.every) != 0 ||
        !queries[i].path.starts_with(options.only)) {
      return;
    }
    absl::StatusOr<Outcome> outcome =
        RunQuery(gallery, folder, queries[i], options);
    statuses[i] = outcome.status();
    if (outcome.ok()) outcomes[i] = *outcome;
  });
  for (const absl::Status& status : statuses) ARGMESH_RETURN_IF_ERROR(status);
  const std::string name = std::filesystem::path(folder).filename().string();
  PrintMean(name + " odd", outcomes, 1);
  PrintMean(name + " even", outcomes, 0);
  return absl::OkStatus();
}

absl::Status Run(const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const Gallery gallery, MakeGallery(options));
  std::printf("%-28s %4s", "", "n");
  for (const char* column : kColumns) std::printf(" %7s", column);
  std::printf("\n");
  for (const std::string& folder : options.queries) {
    ARGMESH_RETURN_IF_ERROR(RunFolder(gallery, folder, options));
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("How well pieces of shapes are found");
  app.add_option("queries", options.queries, "Folders of make_variants")
      ->required();
  app.add_option("--gallery", options.galleries,
                 "Folder with a labels.tsv, or folder=prefix of paths")
      ->required();
  app.add_option("--exact", options.rank.exact_limit);
  app.add_option("--verify", options.rank.verify_limit);
  app.add_option("--thorough", options.rank.thorough_limit);
  app.add_option("--flipped", options.rank.try_flipped);
  app.add_option("--every", options.every, "Every n-th query only");
  app.add_option("--threads", options.threads);
  app.add_option("--only", options.only, "Queries whose path begins so");
  app.add_option("--rows", options.rows,
                 "A line for each query with so many answers");
  CLI11_PARSE(app, argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const absl::Status status = argmesh::Run(options);
  if (!status.ok()) std::printf("%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
