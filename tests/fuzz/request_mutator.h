// Changes of a request that a service may take: values that a field can have,
// names of things that are there, numbers at the edges, fields that come and
// go. Bytes changed blindly seldom pass the first check.
#ifndef ARGMESH_TESTS_FUZZ_REQUEST_MUTATOR_H_
#define ARGMESH_TESTS_FUZZ_REQUEST_MUTATOR_H_

#include <google/protobuf/message.h>

#include "core/base/random.h"

namespace argmesh {

void MutateRequest(google::protobuf::Message& request, Random& random);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_FUZZ_REQUEST_MUTATOR_H_
