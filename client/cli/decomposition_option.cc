#include "client/cli/decomposition_option.h"

#include <set>

#include "client/cli/json.h"

namespace argmesh {
namespace {

constexpr v1::DecompositionKind kKinds[] = {
    v1::DECOMPOSITION_KIND_BIHARMONIC, v1::DECOMPOSITION_KIND_NORMAL_CURVATURE,
    v1::DECOMPOSITION_KIND_VORONOI};

}  // namespace

void AddDecompositionOption(CLI::App* command, std::string& name,
                            const std::string& what) {
  std::set<std::string> names;
  for (const v1::DecompositionKind kind : kKinds) {
    names.insert(DecompositionName(kind));
  }
  command
      ->add_option("--decomposition", name,
                   what + ": biharmonic, normal-curvature, voronoi")
      ->type_name("KIND")
      ->check(CLI::IsMember(names));
}

v1::DecompositionKind DecompositionOf(const std::string& name) {
  for (const v1::DecompositionKind kind : kKinds) {
    if (DecompositionName(kind) == name) return kind;
  }
  return v1::DECOMPOSITION_KIND_UNSPECIFIED;
}

}  // namespace argmesh
