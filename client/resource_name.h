// Names of resources: `collections/{c}` and `collections/{c}/shapes/{s}`.
#ifndef ARGMESH_CLIENT_RESOURCE_NAME_H_
#define ARGMESH_CLIENT_RESOURCE_NAME_H_

#include <string>
#include <string_view>

namespace argmesh {

std::string CollectionName(std::string_view collection_id);
std::string ShapeName(std::string_view collection_id,
                      std::string_view shape_id);

// What follows the last '/'; all of it without one.
std::string ResourceId(std::string_view name);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_RESOURCE_NAME_H_
