// --decomposition, a setting of collections.
#ifndef ARGMESH_CLIENT_CLI_DECOMPOSITION_OPTION_H_
#define ARGMESH_CLIENT_CLI_DECOMPOSITION_OPTION_H_

#include <CLI/CLI.hpp>
#include <string>

#include "argmesh/v1/graph.pb.h"

namespace argmesh {

// `what` is its help; `name` stays empty when it is not given.
void AddDecompositionOption(CLI::App* command, std::string& name,
                            const std::string& what);

// Of what the option lets through; UNSPECIFIED when empty.
v1::DecompositionKind DecompositionOf(const std::string& name);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_DECOMPOSITION_OPTION_H_
