#include "server/telemetry/engine_gauges.h"

#include <algorithm>
#include <string>

namespace argmesh {
namespace {

constexpr size_t kMaxCollections = 1000;

constexpr std::pair<WorkClass, const char*> kClasses[] = {
    {WorkClass::kSearch, "search"},
    {WorkClass::kCompute, "compute"},
    {WorkClass::kQuick, "quick"},
    {WorkClass::kBulk, "bulk"}};

void WritePools(Engine& engine, GaugeSheet& sheet) {
  for (const auto& [work_class, name] : kClasses) {
    const WorkLoad load = engine.pool().Load(work_class);
    const GaugeSheet::Labels labels = {{"pool", name}};
    sheet.Gauge("argmesh_pool_threads", "Threads of a pool.", load.threads,
                labels);
    sheet.Gauge("argmesh_pool_running", "Threads of a pool at work.",
                load.running, labels);
    sheet.Gauge("argmesh_pool_queued", "Work that waits for a thread.",
                load.queued, labels);
    sheet.Counter("argmesh_pool_admitted_total", "Work that got a thread.",
                  static_cast<double>(load.admitted), labels);
    sheet.Counter("argmesh_pool_refused_total",
                  "Work that was refused because it waited too long or the "
                  "queue was full.",
                  static_cast<double>(load.refused), labels);
  }
}

void WriteIndex(const Engine& engine, GaugeSheet& sheet) {
  const std::vector<CollectionHealth> all = engine.Health();
  int64_t failed = 0;
  int64_t damaged = 0;
  int64_t outdated = 0;
  for (const CollectionHealth& health : all) {
    failed += health.error.empty() ? 0 : 1;
    damaged += health.damaged_shapes;
    outdated += health.outdated_shapes;
  }
  sheet.Gauge("argmesh_index_serving", "1 while searches are served.",
              engine.index_state() == IndexState::kServing ? 1 : 0);
  sheet.Gauge("argmesh_index_collections", "Collections there are.",
              static_cast<double>(all.size()));
  sheet.Gauge("argmesh_index_failed_collections",
              "Collections that could not be loaded.",
              static_cast<double>(failed));
  sheet.Gauge("argmesh_index_damaged_shapes",
              "Stored shapes that fail their check.",
              static_cast<double>(damaged));
  sheet.Gauge("argmesh_index_outdated_shapes",
              "Stored shapes whose graphs are of another version.",
              static_cast<double>(outdated));
  const size_t shown = std::min(all.size(), kMaxCollections);
  for (size_t i = 0; i < shown; ++i) {
    const GaugeSheet::Labels labels = {{"collection", all[i].id}};
    sheet.Gauge("argmesh_index_shapes", "Shapes in the index.",
                static_cast<double>(all[i].shapes), labels);
    sheet.Gauge("argmesh_index_generation",
                "Generation that the index has reached.",
                static_cast<double>(all[i].generation), labels);
  }
}

void WriteStore(const Engine& engine, GaugeSheet& sheet) {
  const StoreLoad load = engine.Store();
  sheet.Gauge("argmesh_store_database_bytes", "Size of the database file.",
              static_cast<double>(load.database_bytes));
  sheet.Gauge("argmesh_store_wal_bytes", "Size of the write-ahead log.",
              static_cast<double>(load.wal_bytes));
  sheet.Gauge("argmesh_store_meshes", "Mesh files that rows name.",
              static_cast<double>(load.meshes));
  sheet.Gauge("argmesh_store_mesh_bytes", "Bytes of these mesh files.",
              static_cast<double>(load.mesh_bytes));
  sheet.Gauge("argmesh_store_deleted_shapes",
              "Shapes of deleted collections that are not removed yet.",
              static_cast<double>(load.deleted_shapes));
  sheet.Gauge("argmesh_store_free_bytes", "Free space on the store's disk.",
              static_cast<double>(load.free_bytes));
  sheet.Gauge("argmesh_store_writable",
              "0 while writes that add are refused for want of space.",
              load.writable ? 1 : 0);
  sheet.Gauge("argmesh_store_queued_writes", "Writes that wait for a commit.",
              static_cast<double>(load.queued_writes));
  sheet.Counter("argmesh_store_commits_total", "Transactions committed.",
                static_cast<double>(load.commits));
  sheet.Counter("argmesh_store_changes_total", "Writes in them.",
                static_cast<double>(load.changes));
  sheet.Counter("argmesh_store_commit_seconds_total",
                "Time that the commits took.", load.commit_seconds);
}

}  // namespace

void WriteEngineGauges(Engine& engine, GaugeSheet& sheet) {
  WritePools(engine, sheet);
  WriteIndex(engine, sheet);
  WriteStore(engine, sheet);
}

}  // namespace argmesh
