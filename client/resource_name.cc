#include "client/resource_name.h"

namespace argmesh {

std::string CollectionName(std::string_view collection_id) {
  return "collections/" + std::string(collection_id);
}

std::string ShapeName(std::string_view collection_id,
                      std::string_view shape_id) {
  return CollectionName(collection_id) + "/shapes/" + std::string(shape_id);
}

std::string ResourceId(std::string_view name) {
  const size_t slash = name.rfind('/');
  return std::string(slash == std::string_view::npos ? name
                                                     : name.substr(slash + 1));
}

}  // namespace argmesh
