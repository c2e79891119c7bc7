// What must hold for any bytes: else the fuzzer has found something.
#ifndef ARGMESH_TESTS_FUZZ_REQUIRE_H_
#define ARGMESH_TESTS_FUZZ_REQUIRE_H_

#include <cstdio>
#include <cstdlib>

namespace argmesh {

inline void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_FUZZ_REQUIRE_H_
