// The program `argmesh`: the command line of an argmesh server.
#ifndef ARGMESH_CLIENT_CLI_APP_H_
#define ARGMESH_CLIENT_CLI_APP_H_

#include <ostream>

namespace argmesh {

// Parses the arguments, does what they say, and returns the exit code: 0 ok,
// 1 something failed, 2 wrong usage, 3 no server answers, 130 interrupted.
int RunArgmesh(int argc, const char* const* argv, std::ostream& out,
               std::ostream& err, bool err_is_terminal);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_APP_H_
