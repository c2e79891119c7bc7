// Everything in a catalog as one text: equal catalogs give equal texts.
#ifndef ARGMESH_TESTS_SUPPORT_CATALOG_DUMP_H_
#define ARGMESH_TESTS_SUPPORT_CATALOG_DUMP_H_

#include <string>

#include "server/engine/catalog.h"

namespace argmesh {

std::string DumpCatalog(const Catalog& catalog);
// One collection with its shapes and its changes; "" when it is not there.
std::string DumpCollection(const Catalog& catalog, const std::string& id);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_CATALOG_DUMP_H_
