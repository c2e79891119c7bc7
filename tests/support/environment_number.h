// Numbers that a person may give a test: how much it does, from which seed.
#ifndef ARGMESH_TESTS_SUPPORT_ENVIRONMENT_NUMBER_H_
#define ARGMESH_TESTS_SUPPORT_ENVIRONMENT_NUMBER_H_

#include <cstdint>
#include <cstdlib>

namespace argmesh {

inline uint64_t EnvironmentNumber(const char* variable, uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_ENVIRONMENT_NUMBER_H_
