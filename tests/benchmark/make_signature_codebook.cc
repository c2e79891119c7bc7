// Makes core/signature/signature_codebook.bin: the scales, axes and mixtures
// that signatures are measured against.
//
//   make_signature_codebook --folder shrec07_dev --folder psb_train
//       core/signature/signature_codebook.bin
//
// Learns from the odd-numbered meshes (1st, 3rd, .. line of labels.tsv) of each
// folder, without looking at their classes, and from generated samples. Equal
// meshes give equal bytes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "core/mesh/mesh_repair.h"
#include "core/signature/codebook.h"
#include "core/signature/mixture_fit.h"
#include "core/signature/point_fields.h"
#include "core/signature/signature_surface.h"
#include "core/signature/view_patches.h"
#include "core/synthesis/sample_collection.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::string out;
  std::vector<std::string> folders;
  int samples_per_class = 0;
  int threads = 2;
};

// Axes and mixtures are fitted to every n-th row of each mesh: as much of a
// small mesh as of a large one.
constexpr Eigen::Index kPointStride = 8;
constexpr Eigen::Index kPatchStride = 47;

// About 1.6 MB a mesh.
struct Learned {
  PointRows fields;
  PointRows patches;
};

absl::StatusOr<Learned> LearnFrom(const TriangleMesh& mesh) {
  ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(mesh));
  ARGMESH_ASSIGN_OR_RETURN(const SignatureSurface surface,
                           PrepareSurface(repaired.mesh));
  Learned learned;
  ARGMESH_ASSIGN_OR_RETURN(learned.fields, MeasurePointFields(surface));
  ARGMESH_ASSIGN_OR_RETURN(learned.patches, DescribeViews(surface));
  return learned;
}

// Every n-th row of each mesh, one below the other.
PointRows Stack(const std::vector<Learned>& learned, PointRows Learned::*part,
                Eigen::Index stride) {
  Eigen::Index rows = 0;
  for (const Learned& item : learned) {
    rows += ((item.*part).rows() + stride - 1) / stride;
  }
  PointRows all(rows, (learned.front().*part).cols());
  Eigen::Index next = 0;
  for (const Learned& item : learned) {
    const PointRows& from = item.*part;
    for (Eigen::Index i = 0; i < from.rows(); i += stride) {
      all.row(next++) = from.row(i);
    }
  }
  return all;
}

PointRows FieldKnots(const PointRows& fields) {
  PointRows knots(kNumFields, kFieldKnots);
  for (int f = 0; f < kNumFields; ++f) {
    std::vector<float> values(static_cast<size_t>(fields.rows()));
    for (Eigen::Index i = 0; i < fields.rows(); ++i) {
      values[static_cast<size_t>(i)] = fields(i, f);
    }
    std::sort(values.begin(), values.end());
    for (int k = 0; k < kFieldKnots; ++k) {
      const double score =
          static_cast<double>(kMaxScore) * (2.0 * k / (kFieldKnots - 1) - 1);
      const double share = std::erfc(-score / std::numbers::sqrt2) / 2;
      knots(f, k) = values[static_cast<size_t>(
          share * static_cast<double>(values.size() - 1) + 0.5)];
    }
  }
  return knots;
}

absl::Status FitPoints(const PointRows& fields, Codebook& codebook) {
  codebook.field_knots = FieldKnots(fields);
  PointRows scores(fields.rows(), kNumFields);
  for (Eigen::Index i = 0; i < fields.rows(); ++i) {
    for (int f = 0; f < kNumFields; ++f) {
      scores(i, f) = FieldScore(codebook, f, fields(i, f));
    }
  }
  ARGMESH_ASSIGN_OR_RETURN(const PrincipalAxes axes,
                           FitPrincipalAxes(scores, kNumFields));
  codebook.field_mean = axes.mean;
  codebook.field_axes =
      axes.axes *
      axes.variances.cwiseMax(1e-6F).cwiseSqrt().cwiseInverse().asDiagonal();
  MixtureFitOptions fit;
  fit.components = kPointMixtureSize;
  ARGMESH_ASSIGN_OR_RETURN(
      codebook.points,
      FitDiagonalMixture(NormalizeFields(codebook, fields), fit));
  return absl::OkStatus();
}

absl::Status FitPatches(const PointRows& patches, Codebook& codebook) {
  ARGMESH_ASSIGN_OR_RETURN(
      const PrincipalAxes axes,
      FitPrincipalAxes(patches.leftCols(kPatchDims), kPatchAxes));
  codebook.patch_mean = axes.mean;
  codebook.patch_axes = axes.axes;
  MixtureFitOptions fit;
  fit.components = kViewMixtureSize;
  ARGMESH_ASSIGN_OR_RETURN(
      codebook.patches,
      FitDiagonalMixture(ProjectPatches(codebook, patches), fit));
  return absl::OkStatus();
}

// Over all meshes; an unseen surface counts as a zero.
void FitMeans(const std::vector<Learned>& learned, Codebook& codebook) {
  Eigen::VectorXf points = Eigen::VectorXf::Zero(kPointDims);
  Eigen::VectorXf views = Eigen::VectorXf::Zero(kViewDims);
  codebook.point_mean = points;
  codebook.view_mean = views;
  for (const Learned& item : learned) {
    points += EncodeFields(codebook, item.fields);
    views += EncodePatches(codebook, item.patches);
  }
  codebook.point_mean = points / static_cast<float>(learned.size());
  codebook.view_mean = views / static_cast<float>(learned.size());
}

absl::StatusOr<std::vector<TriangleMesh>> LoadMeshes(const Options& options) {
  std::vector<TriangleMesh> meshes;
  for (const std::string& folder : options.folders) {
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<LabelledMesh> items,
                             ReadLabels(folder));
    for (size_t i = 0; i < items.size(); i += 2) {
      ARGMESH_ASSIGN_OR_RETURN(
          TriangleMesh mesh,
          ReadMesh(std::filesystem::path(folder) / items[i].path));
      meshes.push_back(std::move(mesh));
    }
  }
  if (options.samples_per_class > 0) {
    SampleCollectionOptions samples;
    samples.shapes_per_class = options.samples_per_class;
    ARGMESH_RETURN_IF_ERROR(MakeSampleCollection(samples, [&](SampleItem item) {
      meshes.push_back(std::move(item.mesh));
      return absl::OkStatus();
    }));
  }
  return meshes;
}

absl::Status Run(const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<TriangleMesh> meshes,
                           LoadMeshes(options));
  std::vector<absl::StatusOr<Learned>> results(
      meshes.size(), absl::UnknownError("not measured"));
  ParallelFor(meshes.size(), options.threads,
              [&](size_t i) { results[i] = LearnFrom(meshes[i]); });
  std::vector<Learned> learned;
  for (absl::StatusOr<Learned>& result : results) {
    ARGMESH_RETURN_IF_ERROR(result.status());
    learned.push_back(std::move(*result));
  }
  if (learned.empty()) return absl::InvalidArgumentError("no meshes");
  Codebook codebook;
  ARGMESH_RETURN_IF_ERROR(
      FitPoints(Stack(learned, &Learned::fields, kPointStride), codebook));
  ARGMESH_RETURN_IF_ERROR(
      FitPatches(Stack(learned, &Learned::patches, kPatchStride), codebook));
  FitMeans(learned, codebook);
  const std::string bytes = EncodeCodebook(codebook);
  ARGMESH_RETURN_IF_ERROR(DecodeCodebook(bytes).status());
  std::ofstream(options.out, std::ios::binary) << bytes;
  std::printf("%zu meshes, %zu bytes\n", learned.size(), bytes.size());
  return absl::OkStatus();
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("The codebook of signatures");
  app.add_option("out", options.out, "File to write")->required();
  app.add_option("--folder", options.folders, "Meshes with a labels.tsv");
  app.add_option("--samples", options.samples_per_class,
                 "Generated shapes of each class");
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = argmesh::Run(options);
  if (!status.ok()) std::printf("%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
