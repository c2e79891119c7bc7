#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/cli/command_set.h"
#include "client/cli/mesh_files.h"
#include "client/cli/progress_line.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_write.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/sample_shape.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr char kSampleDetails[] =
    R"(Writes DIR/CLASS/CLASS-NN.off and DIR/labels.tsv: seeded procedural meshes in
named classes, for a first try and for tests. Equal options give equal files.
With --part half of the class's first shape is written to FILE, turned and at
another size, as a query for a partial search.

Examples:
  argmesh sample --out meshes --shapes-per-class 6
  argmesh ingest --collection demo --labels meshes/labels.tsv meshes
  argmesh sample --part quadruped --out half.off)";

struct SampleArguments {
  std::string out;
  std::string part;
  int shapes_per_class = 5;
  uint64_t seed = 1;
  int vertices = 4500;
  std::vector<std::string> classes;
};

absl::StatusOr<std::vector<std::string>> ClassesOf(
    const SampleArguments& arguments) {
  std::vector<std::string> known;
  for (const std::string_view name : SampleClassNames()) {
    known.emplace_back(name);
  }
  if (arguments.classes.empty()) return known;
  for (const std::string& name : arguments.classes) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return UsageError("--classes " + name + ": there are " +
                        absl::StrJoin(known, " "));
    }
  }
  const std::set<std::string> unique(arguments.classes.begin(),
                                     arguments.classes.end());
  return std::vector<std::string>(unique.begin(), unique.end());
}

// Seeds of different classes and variants never meet by small differences of
// the user's seed.
uint64_t VariantSeed(uint64_t seed, int variant) {
  return seed * 1'000'003 + static_cast<uint64_t>(variant);
}

absl::Status CreateFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return absl::OkStatus();
  return absl::UnknownError(absl::StrFormat("%s cannot be made: %s",
                                            folder.string(), error.message()));
}

absl::Status WriteOff(const fs::path& path, const TriangleMesh& mesh) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                           SerializeMesh(mesh, MeshFormat::kOff));
  return WriteFile(path, bytes);
}

absl::StatusOr<int> WriteCollection(const Session& session,
                                    const SampleArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<std::string> classes,
                           ClassesOf(arguments));
  const auto total =
      classes.size() * static_cast<size_t>(arguments.shapes_per_class);
  const fs::path folder(arguments.out);
  ProgressLine progress(session.err, session.err_is_terminal, "sample", total);
  std::string labels;
  size_t written = 0;
  for (const std::string& name : classes) {
    ARGMESH_RETURN_IF_ERROR(CreateFolder(folder / name));
    for (int i = 1; i <= arguments.shapes_per_class; ++i) {
      ARGMESH_ASSIGN_OR_RETURN(
          const SampleShape shape,
          MakeSampleShape(name, VariantSeed(arguments.seed, i),
                          {.target_vertices = arguments.vertices}));
      const std::string file = absl::StrFormat("%s/%s-%02d.off", name, name, i);
      ARGMESH_RETURN_IF_ERROR(WriteOff(folder / file, shape.mesh));
      absl::StrAppend(&labels, file, "\t", name, "\n");
      progress.Advance(++written);
    }
  }
  ARGMESH_RETURN_IF_ERROR(WriteFile(folder / "labels.tsv", labels));
  progress.Clear();
  if (session.options.json) {
    session.Print({{"out", arguments.out},
                   {"classes", classes},
                   {"shapes", written},
                   {"labels", (folder / "labels.tsv").string()}});
  } else {
    session.out << absl::StrFormat("%d shapes in %d classes, labels in %s\n",
                                   written, classes.size(),
                                   (folder / "labels.tsv").string());
  }
  return kExitOk;
}

// Half of a shape, across its longest side.
TriangleMesh HalfOf(const TriangleMesh& mesh) {
  const Eigen::RowVector3d low = mesh.V.colwise().minCoeff();
  const Eigen::RowVector3d high = mesh.V.colwise().maxCoeff();
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  return CutHalf(mesh, static_cast<int>(axis));
}

absl::StatusOr<int> WritePart(const Session& session,
                              const SampleArguments& arguments) {
  SampleArguments only = arguments;
  only.classes = {arguments.part};
  ARGMESH_RETURN_IF_ERROR(ClassesOf(only).status());
  ARGMESH_ASSIGN_OR_RETURN(
      const SampleShape shape,
      MakeSampleShape(arguments.part, VariantSeed(arguments.seed, 1),
                      {.target_vertices = arguments.vertices}));
  const TriangleMesh half =
      RandomSimilarity(HalfOf(shape.mesh), arguments.seed);
  ARGMESH_RETURN_IF_ERROR(WriteOff(arguments.out, half));
  if (session.options.json) {
    session.Print({{"out", arguments.out},
                   {"class", arguments.part},
                   {"vertices", half.num_vertices()},
                   {"faces", half.num_faces()}});
  } else {
    session.out << absl::StrFormat("half of the first %s in %s: %d vertices\n",
                                   arguments.part, arguments.out,
                                   half.num_vertices());
  }
  return kExitOk;
}

}  // namespace

void AddSampleCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<SampleArguments>();
  CLI::App* command = commands.Add(
      app, {"sample", "Write a sample collection of meshes.", kSampleDetails},
      [arguments](const Session& session) {
        return arguments->part.empty() ? WriteCollection(session, *arguments)
                                       : WritePart(session, *arguments);
      });
  command->add_option("--out,-o", arguments->out, "Folder; file with --part")
      ->required()
      ->type_name("PATH");
  command
      ->add_option("--shapes-per-class", arguments->shapes_per_class,
                   "Shapes of each class")
      ->type_name("N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Another seed, other shapes")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--vertices", arguments->vertices, "Of a shape, about")
      ->type_name("N")
      ->check(CLI::Range(1000, 200000))
      ->capture_default_str();
  command
      ->add_option("--classes", arguments->classes,
                   "Only these classes, names with commas")
      ->delimiter(',')
      ->type_name("NAMES");
  command
      ->add_option("--part", arguments->part,
                   "Half of the first shape of a class")
      ->type_name("CLASS");
}

}  // namespace argmesh
