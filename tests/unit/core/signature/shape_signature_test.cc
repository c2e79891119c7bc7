#include "core/signature/shape_signature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/mesh/mesh_repair.h"
#include "core/signature/signature_codec.h"
#include "core/signature/signature_similarity.h"
#include "core/synthesis/mesh_decimate.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/sample_shape.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TriangleMesh MakeSample(const char* name, uint64_t seed = 3) {
  SampleShapeOptions options;
  options.target_vertices = 2000;
  auto shape = MakeSampleShape(name, seed, options);
  EXPECT_THAT(shape, IsOk());
  return shape->mesh;
}

ShapeSignature SignatureOf(const TriangleMesh& mesh) {
  const auto repaired = RepairMesh(mesh);
  EXPECT_THAT(repaired, IsOk());
  auto signature = ComputeShapeSignature(repaired->mesh);
  EXPECT_THAT(signature, IsOk());
  return *std::move(signature);
}

TEST(ComputeShapeSignature, IsWellFormedAndStoredWithoutLoss) {
  const ShapeSignature signature = SignatureOf(MakeSample("mug"));
  EXPECT_THAT(CheckShapeSignature(signature), IsOk());
  EXPECT_TRUE(signature.smoothed);
  ASSERT_OK_AND_ASSIGN(const ShapeSignature decoded,
                       DecodeSignature(EncodeSignature(signature)));
  EXPECT_EQ(decoded, signature);
}

TEST(ComputeShapeSignature, RepeatsToTheBit) {
  const TriangleMesh mesh = MakeSample("pliers");
  EXPECT_EQ(SignatureOf(mesh), SignatureOf(mesh));
}

TEST(ComputeShapeSignature, IgnoresMotionScaleAndNumbering) {
  for (const char* name : {"hand", "chair", "octopus"}) {
    const TriangleMesh mesh = MakeSample(name);
    const ShapeSignature signature = SignatureOf(mesh);
    for (uint64_t seed = 1; seed <= 2; ++seed) {
      const ShapeSignature copy = SignatureOf(RandomSimilarity(mesh, seed));
      EXPECT_GE(SignatureSimilarity(signature, copy), 0.98) << name << seed;
    }
  }
}

TEST(ComputeShapeSignature, IsNearlyTheSameForCopiesOfASymmetricShape) {
  const TriangleMesh mesh = MakeTorus(1, 0.4, 48, 24);
  const ShapeSignature signature = SignatureOf(mesh);
  EXPECT_GE(SignatureSimilarity(signature, SignatureOf(RandomlyMoved(mesh, 5))),
            0.98);
}

TEST(ComputeShapeSignature, SurvivesNoiseAndDecimation) {
  const TriangleMesh mesh = MakeSample("quadruped");
  const ShapeSignature signature = SignatureOf(mesh);
  const double noisy =
      SignatureSimilarity(signature, SignatureOf(AddNoise(mesh, 0.005, 1)));
  const double coarse = SignatureSimilarity(
      signature, SignatureOf(DecimateMesh(mesh, mesh.num_vertices() / 4)));
  const double other =
      SignatureSimilarity(signature, SignatureOf(MakeSample("table")));
  EXPECT_GT(noisy, 0.8);
  EXPECT_GT(coarse, 0.8);
  EXPECT_LT(other, 0.4);
}

TEST(ComputeShapeSignature, TakesSheetsAndSoup) {
  const ShapeSignature sheet = SignatureOf(MakeSheet(12));
  EXPECT_FALSE(sheet.smoothed);
  EXPECT_THAT(CheckShapeSignature(sheet), IsOk());
  const TriangleMesh mesh = MakeSample("mug");
  const ShapeSignature soup = SignatureOf(MakeSoup(RemoveFaces(mesh, 0.1, 1)));
  EXPECT_FALSE(soup.smoothed);
  EXPECT_GT(SignatureSimilarity(soup, SignatureOf(mesh)), 0.5);
}

TEST(ComputeShapeSignature, TakesASliverThatNoPixelSees) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0, 0, 0, 1, 0, 0, 0.5, 1e-9, 0;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  const auto signature = ComputeShapeSignature(mesh);
  if (signature.ok()) {
    EXPECT_THAT(CheckShapeSignature(*signature), IsOk());
  } else {
    EXPECT_THAT(signature, StatusIs(absl::StatusCode::kFailedPrecondition,
                                    HasSubstr("area")));
  }
}

TEST(ComputeShapeSignature, NamesWhatIsWrong) {
  TriangleMesh mesh = MakeSheet(2);
  SignatureOptions options;
  options.max_boundary_share = -0.5;
  EXPECT_THAT(ComputeShapeSignature(mesh, options),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("max_boundary_share -0.5")));
  mesh.V(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(ComputeShapeSignature(mesh),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("0")));
  mesh = MakeSheet(2);
  mesh.V.setZero();
  EXPECT_THAT(
      ComputeShapeSignature(mesh),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("area")));
}

TEST(ComputeShapeSignature, Stops) {
  std::stop_source source;
  source.request_stop();
  const StopToken stop(source.get_token(), absl::InfiniteFuture());
  EXPECT_THAT(ComputeShapeSignature(MakeTorus(1, 0.4, 24, 12), {}, stop),
              StatusIs(absl::StatusCode::kCancelled, testing::_));
}

TEST(ComputeShapeSignature, TellsItsTimes) {
  SignatureTimes times;
  ASSERT_THAT(ComputeShapeSignature(MakeTorus(1, 0.4, 24, 12), {}, {}, &times),
              IsOk());
  EXPECT_GT(times.surface, absl::ZeroDuration());
  EXPECT_GT(times.points, absl::ZeroDuration());
  EXPECT_GT(times.views, absl::ZeroDuration());
}

}  // namespace
}  // namespace argmesh
