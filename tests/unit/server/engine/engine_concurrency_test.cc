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

TEST_F(EngineConcurrencyTest, HoldsWhatEveryThreadWasToldAlsoAfterARestart) {
  for (int i = 0; i < kMeshes; ++i) meshes_.push_back(TorusOff(2 + i));
  Open();
  NewCollection cups;
  cups.id = "cups";
  cups.settings = QuickSettings();
  cups.settings.vertex_budget = 100;
  ASSERT_THAT(engine_->CreateCollection(cups), IsOk());
  const absl::Time end = absl::Now() + kRunTime;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t, end] { Work(t, end); });
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
