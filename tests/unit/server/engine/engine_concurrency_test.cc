// Many threads against one engine, compared with what each of them was told.
#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "absl/time/clock.h"
#include "core/base/random.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/server/engine/engine_bench.h"

namespace argmesh {
namespace {

constexpr int kThreads = 8;
constexpr int kMeshes = 3;
constexpr absl::Duration kRunTime = absl::Seconds(2);

class EngineConcurrencyTest : public ::testing::Test {
 protected:
  void Open() {
    engine_.reset();
    ASSERT_OK_AND_ASSIGN(
        const std::shared_ptr<DataDirectory> directory,
        DataDirectory::Open(
            folder_.path() / "data",
            {.min_free_bytes = 0, .allow_network_file_system = true}));
    ASSERT_OK_AND_ASSIGN(auto catalog, SqliteCatalog::Open(directory));
    ASSERT_OK_AND_ASSIGN(auto meshes, DirectoryMeshStore::Open(directory));
    ASSERT_OK_AND_ASSIGN(
        engine_, Engine::Create({}, std::move(catalog), std::move(meshes)));
    ASSERT_TRUE(engine_->WaitUntilServing().ok());
  }

  static CollectionSettings SmallSettings(int vertex_budget) {
    CollectionSettings settings = QuickSettings();
    settings.vertex_budget = vertex_budget;
    return settings;
  }
  void MakeCups(int vertex_budget) {
    NewCollection cups;
    cups.id = "cups";
    cups.settings = SmallSettings(vertex_budget);
    ASSERT_THAT(engine_->CreateCollection(cups), IsOk());
  }

  static SearchQuery QueryFor(QueryShape shape) {
    SearchQuery query;
    query.collection = "cups";
    query.query = std::move(shape);
    return query;
  }
  std::map<std::string, double> ScoresOf(const SearchQuery& query) {
    const absl::StatusOr<SearchAnswer> answer = engine_->Search(query);
    EXPECT_TRUE(answer.ok()) << answer.status();
    std::map<std::string, double> scores;
    if (!answer.ok()) return scores;
    for (const SearchMatch& match : answer->matches) {
      scores[match.shape.id] = match.score;
    }
    return scores;
  }

  // What one thread does; it alone writes the shapes that begin with its name.
  void Work(int thread, absl::Time end) {
    Random random(static_cast<uint64_t>(thread) + 1);
    const std::string prefix = "t" + std::to_string(thread) + "-";
    std::map<std::string, std::string>& model =
        models_[static_cast<size_t>(thread)];
    while (absl::Now() < end) {
      NewShape shape;
      shape.collection = "cups";
      shape.id = prefix + std::to_string(random.Below(4));
      switch (random.Below(4)) {
        case 0:
          Delete(shape.id, model);
          break;
        case 1:
          Search(prefix, model);
          break;
        default:
          Add(shape, meshes_[random.Below(kMeshes)], model);
      }
      ++operations_;
    }
  }

  void Add(NewShape shape, const std::string& mesh,
           std::map<std::string, std::string>& model) {
    shape.if_exists = IfExists::kReplace;
    const absl::StatusOr<AddedShape> added = engine_->AddShape(shape, mesh);
    EXPECT_TRUE(added.ok()) << added.status();
    model[shape.id] = mesh;
  }

  void Delete(const std::string& id,
              std::map<std::string, std::string>& model) {
    const absl::Status status =
        engine_->DeleteShape({{"cups", id}, "", {}}).status();
    EXPECT_EQ(status.ok(), model.erase(id) == 1) << status;
  }

  // The thread's own shapes are found exactly as it left them.
  void Search(const std::string& prefix,
              const std::map<std::string, std::string>& model) {
    SearchQuery query;
    query.collection = "cups";
    query.query = MeshBytes{meshes_[0]};
    query.limit = 1000;
    const absl::StatusOr<SearchAnswer> answer = engine_->Search(query);
    ASSERT_TRUE(answer.ok()) << answer.status();
    std::map<std::string, Sha256Digest> found;
    for (const SearchMatch& match : answer->matches) {
      if (match.shape.id.starts_with(prefix)) {
        found[match.shape.id] = match.shape.sha256;
      }
    }
    EXPECT_EQ(found.size(), model.size());
    for (const auto& [id, mesh] : model) {
      EXPECT_EQ(found[id], ComputeSha256(mesh)) << id;
    }
  }

  void CompareWithModels() {
    std::map<std::string, Sha256Digest> expected;
    for (const auto& model : models_) {
      for (const auto& [id, mesh] : model) expected[id] = ComputeSha256(mesh);
    }
    PageRequest all;
    all.page_size = 1000;
    ASSERT_OK_AND_ASSIGN(const ShapePage page,
                         engine_->ListShapes("cups", all));
    std::map<std::string, Sha256Digest> listed;
    for (const ShapeRecord& record : page.shapes) {
      listed[record.id] = record.sha256;
      ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshReader> reader,
                           engine_->OpenMesh({"cups", record.id}));
      EXPECT_TRUE(reader->Read(1 << 20).ok()) << record.id;
    }
    EXPECT_EQ(listed, expected);
    ASSERT_OK_AND_ASSIGN(const CollectionRecord cups,
                         engine_->GetCollection("cups"));
    EXPECT_EQ(cups.shape_count, static_cast<int64_t>(expected.size()));
    EXPECT_EQ(engine_->Health().at(0).generation, cups.generation);
    EXPECT_EQ(engine_->Health().at(0).shapes, cups.shape_count);
  }

  TemporaryDirectory folder_;
  std::unique_ptr<Engine> engine_;
  std::vector<std::string> meshes_;
  std::vector<std::map<std::string, std::string>> models_ =
      std::vector<std::map<std::string, std::string>>(kThreads);
  std::atomic<int> operations_{0};
};

// Searches that run while a collection is switched to and fro answer one state
// or the other.
TEST_F(EngineConcurrencyTest, SearchesSeeOneSideOfASwitchWhole) {
  Open();
  ASSERT_NO_FATAL_FAILURE(MakeCups(100));
  for (int i = 0; i < 4; ++i) {
    NewShape shape;
    shape.collection = "cups";
    shape.id = "s" + std::to_string(i);
    ASSERT_THAT(engine_->AddShape(shape, TorusOff(2 + i)), IsOk());
  }
  const std::vector<CollectionSettings> sides = {SmallSettings(100),
                                                 SmallSettings(140)};
  const std::vector<SearchQuery> queries = {QueryFor(ShapeRef{"cups", "s1"}),
                                            QueryFor(MeshBytes{TorusOff(3)})};
  // What each query answers on each side.
  std::vector<std::vector<std::map<std::string, double>>> answers(2);
  for (const size_t side : {1U, 0U}) {
    ASSERT_THAT(engine_->Reindex("cups", sides[side], {}), IsOk());
    for (const SearchQuery& query : queries) {
      answers[side].push_back(ScoresOf(query));
    }
  }
  ASSERT_NE(answers[0][0], answers[1][0]);
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      while (!stop) {
        const std::map<std::string, double> found = ScoresOf(queries[t % 2]);
        EXPECT_TRUE(found == answers[0][t % 2] || found == answers[1][t % 2]);
      }
    });
  }
  for (int i = 1; i <= 6; ++i) {
    const auto report =
        engine_->Reindex("cups", sides[static_cast<size_t>(i % 2)], {});
    EXPECT_TRUE(report.ok() && report->run.failed == 0) << report.status();
    EXPECT_EQ(ScoresOf(queries[0]), answers[static_cast<size_t>(i % 2)][0]);
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

TEST_F(EngineConcurrencyTest, HoldsWhatEveryThreadWasToldAlsoAfterARestart) {
  for (int i = 0; i < kMeshes; ++i) meshes_.push_back(TorusOff(2 + i));
  Open();
  ASSERT_NO_FATAL_FAILURE(MakeCups(100));
  const absl::Time end = absl::Now() + kRunTime;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t, end] { Work(t, end); });
  }
  // Two switches at least, whatever the time they take.
  int switches = 0;
  while (switches < 2 || absl::Now() < end) {
    const auto report = engine_->Reindex(
        "cups", SmallSettings(switches % 2 == 0 ? 140 : 100), {});
    EXPECT_TRUE(report.ok() && report->run.failed == 0) << report.status();
    ++switches;
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(operations_, kThreads);
  CompareWithModels();
  ASSERT_THAT(engine_->Close(), IsOk());
  Open();
  CompareWithModels();
}

}  // namespace
}  // namespace argmesh
