#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return argmesh::FuzzMesh(data, size, argmesh::MeshFormat::kPly);
}
