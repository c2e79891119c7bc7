#include "server/engine/engine.h"

#include <map>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "server/engine/mesh_analysis.h"
#include "tests/support/random_graph.h"
#include "tests/unit/server/engine/engine_bench.h"

namespace argmesh {
namespace {

using ::testing::IsEmpty;

constexpr char kRequest[] = "00000000-0000-4000-8000-000000000001";

TEST_F(EngineTest, StoresAShapeWithItsGraphItsReportAndItsMesh) {
  NewShape shape = Named("red");
  shape.display_name = "Red";
  shape.metadata = {{"colour", "red"}};
  const std::string mesh = TorusOff(3);
  ASSERT_OK_AND_ASSIGN(const AddedShape added, engine_->AddShape(shape, mesh));
  EXPECT_FALSE(added.already_stored);
  EXPECT_EQ(added.record.state, ShapeState::kActive);
  EXPECT_EQ(added.record.format, MeshFormat::kOff);
  EXPECT_EQ(added.record.sha256, ComputeSha256(mesh));
  EXPECT_EQ(added.record.report.euler_characteristic, 0);
  EXPECT_FALSE(added.record.graph.levels.empty());
  ASSERT_OK_AND_ASSIGN(const ShapeGraphAnswer graph,
                       engine_->GetGraph({"cups", "red"}, true));
  EXPECT_EQ(graph.record.display_name, "Red");
  EXPECT_EQ(graph.labels.component.size(),
            static_cast<size_t>(added.record.report.faces));
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshReader> reader,
                       engine_->OpenMesh({"cups", "red"}));
  ASSERT_OK_AND_ASSIGN(const std::string bytes, reader->Read(1 << 20));
  EXPECT_EQ(bytes, mesh);
}

TEST_F(EngineTest, TakesAMeshThatCameInPieces) {
  const std::string mesh = TorusOff(3);
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshUpload> upload,
                       engine_->StartUpload({static_cast<int64_t>(mesh.size()),
                                             ComputeSha256(mesh)}));
  for (size_t at = 0; at < mesh.size(); at += 100) {
    ASSERT_THAT(upload->Append(mesh.substr(at, 100)), IsOk());
  }
  ASSERT_OK_AND_ASSIGN(std::unique_ptr<StagedMesh> staged, upload->Finish());
  ASSERT_OK_AND_ASSIGN(const AddedShape added,
                       engine_->AddShape(Named("red"), std::move(staged)));
  EXPECT_EQ(added.record.sha256, ComputeSha256(mesh));
  EXPECT_EQ(meshes_->size(), 1U);
}

TEST_F(EngineTest, RefusesAnUploadThatIsNotWhatWasAnnounced) {
  ASSERT_OK_AND_ASSIGN(std::unique_ptr<MeshUpload> upload,
                       engine_->StartUpload({4, ComputeSha256("mesh")}));
  EXPECT_EQ(ReasonOrOk(upload->Append("meshes")),
            ErrorReason::kMeshSizeMismatch);
  ASSERT_THAT(upload->Append("mes"), IsOk());
  EXPECT_EQ(ReasonOrOk(upload->Finish()), ErrorReason::kMeshSizeMismatch);
  ASSERT_OK_AND_ASSIGN(upload,
                       engine_->StartUpload({4, ComputeSha256("mesh")}));
  ASSERT_THAT(upload->Append("mash"), IsOk());
  EXPECT_EQ(ReasonOrOk(upload->Finish()), ErrorReason::kMeshDigestMismatch);
  EXPECT_EQ(ReasonOrOk(engine_->StartUpload({0, {}})), ErrorReason::kMeshEmpty);
  EXPECT_EQ(ReasonOrOk(engine_->StartUpload({int64_t{1} << 40, {}})),
            ErrorReason::kMeshTooLarge);
}

TEST_F(EngineTest, RefusesBadMeshesWithTheirReasonAndLeavesNothingBehind) {
  struct Case {
    const char* name;
    std::string bytes;
    ErrorReason reason;
  };
  const std::vector<Case> cases = {
      {"nothing", "", ErrorReason::kMeshEmpty},
      {"no faces", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n",
       ErrorReason::kMeshEmpty},
      {"no area", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n",
       ErrorReason::kMeshDegenerate},
      {"a bad index", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n",
       ErrorReason::kMeshMalformed},
      {"cut", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ErrorReason::kMeshMalformed},
      {"no mesh", "%PDF-1.4 and more", ErrorReason::kMeshFormatUnknown},
      {"too many", "OFF\n99999999 1 0\n", ErrorReason::kMeshTooLarge},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), c.bytes)), c.reason)
        << c.name << ": " << engine_->AddShape(Named("red"), c.bytes).status();
  }
  EXPECT_EQ(meshes_->size(), 0U);
  EXPECT_EQ(ReasonOrOk(engine_->GetShape({"cups", "red"})),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(engine_->GetCollection("cups").value().generation, 0);
}

TEST_F(EngineTest, SaysWhereAMeshIsMalformed) {
  const absl::Status status =
      engine_
          ->AddShape(Named("red"), "OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n")
          .status();
  EXPECT_EQ(ReasonOf(status), ErrorReason::kMeshMalformed);
  EXPECT_EQ(MetadataOf(status)["line"], "4") << status;
}

TEST_F(EngineTest, RefusesADigestThatDoesNotFit) {
  NewShape shape = Named("red");
  shape.sha256 = ComputeSha256("another");
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(shape, TorusOff(3))),
            ErrorReason::kMeshDigestMismatch);
}

TEST_F(EngineTest, GivesUpOnAMeshThatTakesTooLong) {
  EngineOptions options;
  options.max_compute_time = absl::Nanoseconds(1);
  Start(options);
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), TorusOff(3))),
            ErrorReason::kMeshTooLarge);
}

TEST_F(EngineTest, RefusesAMeshThatTakesTooMuchMemory) {
  EngineOptions options;
  options.mesh_memory = 24 * 12 * (370 + 2 * 150) - 1;  // of a torus
  Start(options);
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), TorusOff(3))),
            ErrorReason::kMeshTooLarge);
  EXPECT_EQ(ReasonOrOk(engine_->Search(SearchFor(MeshBytes{TorusOff(3)}))),
            ErrorReason::kMeshTooLarge);
  ++options.mesh_memory;
  Start(options);
  for (const char* id : {"red", "blue"}) {
    EXPECT_THAT(engine_->AddShape(Named(id), TorusOff(3)), IsOk());
  }
}

TEST(MeshAnalyzer, LeavesTheRestOfItsTimeToWhatFollows) {
  EngineOptions options;
  options.max_compute_time = absl::Seconds(60);
  MeshMemory memory(options.mesh_memory);
  const MeshAnalyzer analyzer(options, memory, absl::ZeroDuration());
  const absl::Time before = absl::Now();
  ASSERT_OK_AND_ASSIGN(
      const AnalyzedMesh analyzed,
      analyzer.Analyze(TorusOff(3), MeshFormat::kOff, QuickSettings(), {}));
  EXPECT_LT(analyzed.within.deadline(), absl::Now() + absl::Seconds(60));
  EXPECT_GE(analyzed.within.deadline(), before + absl::Seconds(60));
  const absl::Status over = absl::DeadlineExceededError("over");
  EXPECT_EQ(ReasonOrOk(OverComputeTime(over, {}, options)),
            ErrorReason::kMeshTooLarge);
  const StopToken late({}, before);
  EXPECT_EQ(OverComputeTime(over, late, options), over);
}

TEST_F(EngineTest, TellsTheCallersDeadlineFromItsOwn) {
  const StopToken late({}, absl::Now() - absl::Seconds(1));
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), TorusOff(3), late)),
            ErrorReason::kDeadlineExceeded);
  std::stop_source source;
  source.request_stop();
  const StopToken cancelled(source.get_token(), absl::InfiniteFuture());
  EXPECT_EQ(
      ReasonOrOk(engine_->Search(SearchFor(MeshBytes{TorusOff(3)}), cancelled)),
      ErrorReason::kCancelled);
  EXPECT_EQ(meshes_->size(), 0U);
}

TEST_F(EngineTest, LeavesNoMeshWhenTheRowCannotBeWritten) {
  catalog_->FailNextPut(absl::UnavailableError("later"));
  EXPECT_FALSE(engine_->AddShape(Named("red"), TorusOff(3)).ok());
  EXPECT_EQ(meshes_->size(), 0U);
  EXPECT_THAT(engine_->AddShape(Named("red"), TorusOff(3)), IsOk());
  // The mesh of another shape survives a failure of the same bytes.
  catalog_->FailNextPut(absl::UnavailableError("later"));
  EXPECT_FALSE(engine_->AddShape(Named("blue"), TorusOff(3)).ok());
  EXPECT_EQ(meshes_->size(), 1U);
}

TEST_F(EngineTest, TellsAFullDisk) {
  meshes_->FillUp();
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), TorusOff(3))),
            ErrorReason::kStoreFull);
}

TEST_F(EngineTest, KeepsNoMeshesForACollectionThatWantsNone) {
  NewCollection graphs;
  graphs.id = "graphs";
  graphs.settings = QuickSettings();
  graphs.settings.store_meshes = false;
  ASSERT_THAT(engine_->CreateCollection(graphs), IsOk());
  NewShape shape = Named("red");
  shape.collection = "graphs";
  ASSERT_THAT(engine_->AddShape(shape, TorusOff(3)), IsOk());
  EXPECT_EQ(meshes_->size(), 0U);
  EXPECT_EQ(ReasonOrOk(engine_->OpenMesh({"graphs", "red"})),
            ErrorReason::kMeshNotStored);
  EXPECT_THAT(engine_->GetGraph({"graphs", "red"}, true), IsOk());
}

TEST_F(EngineTest, AnswersARepeatedRequestOnce) {
  NewShape shape = Named("red");
  shape.request.request_id = kRequest;
  ASSERT_OK_AND_ASSIGN(const AddedShape first,
                       engine_->AddShape(shape, TorusOff(3)));
  ASSERT_OK_AND_ASSIGN(const AddedShape second,
                       engine_->AddShape(shape, TorusOff(3)));
  EXPECT_TRUE(second.already_stored);
  EXPECT_EQ(second.record.uid, first.record.uid);
  EXPECT_EQ(second.record.generation, first.record.generation);
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(shape, TorusOff(4))),
            ErrorReason::kRequestIdReused);
  shape.request.request_id = "7";
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(shape, TorusOff(3))),
            ErrorReason::kFieldInvalid);
}

TEST_F(EngineTest, AnswersATakenIdByItsPolicy) {
  ASSERT_OK_AND_ASSIGN(const AddedShape first,
                       engine_->AddShape(Named("red"), TorusOff(3)));
  NewShape shape = Named("red");
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(shape, TorusOff(3))),
            ErrorReason::kShapeExists);
  shape.if_exists = IfExists::kReturnSame;
  ASSERT_OK_AND_ASSIGN(const AddedShape same,
                       engine_->AddShape(shape, TorusOff(3)));
  EXPECT_TRUE(same.already_stored);
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(shape, TorusOff(4))),
            ErrorReason::kShapeExists);
  shape.if_exists = IfExists::kReplace;
  ASSERT_OK_AND_ASSIGN(const AddedShape other,
                       engine_->AddShape(shape, TorusOff(4)));
  EXPECT_EQ(other.record.uid, first.record.uid);
  EXPECT_EQ(meshes_->size(), 1U);
  ASSERT_OK_AND_ASSIGN(const SearchAnswer answer,
                       engine_->Search(SearchFor(MeshBytes{TorusOff(4)})));
  ASSERT_EQ(answer.matches.size(), 1U);
  EXPECT_EQ(answer.matches[0].match.score, 1);
  EXPECT_EQ(answer.matches[0].shape.sha256, ComputeSha256(TorusOff(4)));
}

TEST_F(EngineTest, RemovesAMeshWithItsLastShape) {
  ASSERT_THAT(engine_->AddShape(Named("red"), TorusOff(3)), IsOk());
  ASSERT_THAT(engine_->AddShape(Named("blue"), TorusOff(3)), IsOk());
  EXPECT_EQ(meshes_->size(), 1U);
  ASSERT_OK_AND_ASSIGN(const int64_t generation,
                       engine_->DeleteShape({{"cups", "red"}, "", {}}));
  EXPECT_EQ(generation, 3);
  EXPECT_EQ(meshes_->size(), 1U);
  ASSERT_THAT(engine_->DeleteShape({{"cups", "blue"}, "", {}}), IsOk());
  EXPECT_EQ(meshes_->size(), 0U);
  EXPECT_EQ(ReasonOrOk(engine_->DeleteShape({{"cups", "blue"}, "", {}})),
            ErrorReason::kShapeNotFound);
}

TEST_F(EngineTest, CutsPagesByCountAndByBytes) {
  NewShape shape = Named("");
  for (const char* id : {"c", "a", "e", "b", "d"}) {
    shape.id = id;
    ASSERT_THAT(engine_->AddShape(shape, TorusOff(3)), IsOk());
  }
  for (const int64_t max_bytes : {int64_t{1}, int64_t{1} << 20}) {
    std::vector<std::string> ids;
    PageRequest page{.page_size = 2, .page_token = "", .max_bytes = max_bytes};
    int pages = 0;
    do {
      ASSERT_OK_AND_ASSIGN(const ShapePage answer,
                           engine_->ListShapes("cups", page));
      EXPECT_LE(answer.shapes.size(), max_bytes == 1 ? 1U : 2U);
      for (const ShapeRecord& record : answer.shapes) ids.push_back(record.id);
      page.page_token = answer.next_page_token;
      ++pages;
    } while (!page.page_token.empty());
    EXPECT_EQ(ids, (std::vector<std::string>{"a", "b", "c", "d", "e"}));
    EXPECT_EQ(pages, max_bytes == 1 ? 5 : 3);
  }
  EXPECT_EQ(ReasonOrOk(engine_->ListShapes("cups", {.page_token = "x"})),
            ErrorReason::kPageTokenInvalid);
  EXPECT_EQ(ReasonOrOk(engine_->ListShapes("jugs", {})),
            ErrorReason::kCollectionNotFound);
}

TEST_F(EngineTest, RefusesEverythingOnceItIsClosed) {
  ASSERT_THAT(engine_->Close(), IsOk());
  ASSERT_THAT(engine_->Close(), IsOk());
  EXPECT_EQ(engine_->index_state(), IndexState::kClosed);
  EXPECT_EQ(ReasonOrOk(engine_->AddShape(Named("red"), TorusOff(3))),
            ErrorReason::kDraining);
  EXPECT_EQ(ReasonOrOk(engine_->GetCollection("cups")), ErrorReason::kDraining);
  EXPECT_EQ(ReasonOrOk(engine_->Search(SearchFor(ShapeRef{"cups", "red"}))),
            ErrorReason::kDraining);
}

}  // namespace
}  // namespace argmesh
