// The words of the embedded codebook, ready for finding the nearest.
#ifndef ARGMESH_CORE_CONTAINMENT_WORD_TABLE_H_
#define ARGMESH_CORE_CONTAINMENT_WORD_TABLE_H_

#include "core/containment/descriptor_table.h"

namespace argmesh {

const DescriptorTable& DefaultWordTable();  // made once; thread-safe

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WORD_TABLE_H_
