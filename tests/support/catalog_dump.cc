#include "tests/support/catalog_dump.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "server/engine/record_codec.h"

namespace argmesh {
namespace {

constexpr int kAll = 100'000;

std::string DumpGraph(const Catalog& catalog, const std::string& uid,
                      const ScannedGraph& graph) {
  const std::string& id = graph.record.id;
  const auto stored = catalog.ReadGraph(graph.record.collection, id, true);
  const auto windows = catalog.ReadWindows(uid, id);
  return absl::StrCat(SerializeShapeRecord(graph.record), graph.graph,
                      graph.signature, graph.window_words,
                      graph.status.ToString(),
                      stored.ok() ? stored->labels : stored.status().ToString(),
                      windows.ok() ? *windows : windows.status().ToString());
}

std::string Dump(const Catalog& catalog, const CollectionRecord& collection) {
  std::string text = SerializeCollectionRecord(collection);
  const auto graphs = catalog.ScanGraphs(collection.uid, "", kAll);
  const auto changes = catalog.ReadChanges(collection.uid, 0, kAll);
  if (!graphs.ok() || !changes.ok()) {
    return absl::StrCat(text, graphs.status().ToString(),
                        changes.status().ToString());
  }
  for (const ScannedGraph& graph : *graphs) {
    text += DumpGraph(catalog, collection.uid, graph);
  }
  const auto unstaged = catalog.ListUnstaged(collection.uid, "", kAll);
  const auto staged = catalog.ScanStaged(collection.uid, "", kAll);
  if (!unstaged.ok() || !staged.ok()) {
    return absl::StrCat(text, unstaged.status().ToString(),
                        staged.status().ToString());
  }
  for (const std::string& id : *unstaged) absl::StrAppend(&text, id, " ");
  for (const ScannedGraph& graph : *staged) {
    absl::StrAppend(&text, SerializeShapeRecord(graph.record), graph.graph);
  }
  for (const ShapeChange& change : *changes) {
    absl::StrAppend(&text, change.generation, change.id,
                    static_cast<int>(change.kind));
  }
  return text;
}

}  // namespace

std::string DumpCatalog(const Catalog& catalog) {
  const auto collections = catalog.ListCollections("", kAll);
  if (!collections.ok()) return collections.status().ToString();
  std::string text;
  for (const CollectionRecord& collection : *collections) {
    text += Dump(catalog, collection);
  }
  return text;
}

std::string DumpCollection(const Catalog& catalog, const std::string& id) {
  const auto collection = catalog.GetCollection(id);
  if (absl::IsNotFound(collection.status())) return "";
  return collection.ok() ? Dump(catalog, *collection)
                         : collection.status().ToString();
}

}  // namespace argmesh
