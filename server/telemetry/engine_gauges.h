// The engine and the process as gauges (docs/operations.md).
#ifndef ARGMESH_SERVER_TELEMETRY_ENGINE_GAUGES_H_
#define ARGMESH_SERVER_TELEMETRY_ENGINE_GAUGES_H_

#include "server/engine/engine.h"
#include "server/telemetry/gauge_sheet.h"

namespace argmesh {

// Pools, index, store. Per collection only for the first 1,000 by name.
void WriteEngineGauges(Engine& engine, GaugeSheet& sheet);

// Memory, CPU time, open files and start of this process, under the names that
// Prometheus' own client libraries use. What /proc does not say is left out.
void WriteProcessGauges(GaugeSheet& sheet);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_ENGINE_GAUGES_H_
