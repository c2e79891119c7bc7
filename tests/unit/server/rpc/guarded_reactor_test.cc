#include "server/rpc/guarded_reactor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <sstream>
#include <thread>

#include "tests/support/memory_catalog.h"
#include "tests/support/memory_mesh_store.h"

namespace argmesh {
namespace {

using Message = google::protobuf::Message;

// Everything that a call uses, without gRPC.
struct Surroundings {
  std::ostringstream log;
  std::unique_ptr<Telemetry> telemetry = *Telemetry::Open({}, log);
  std::unique_ptr<Engine> engine =
      *Engine::Create({}, std::make_unique<MemoryCatalog>(),
                      std::make_unique<MemoryMeshStore>());
  ServiceEnvironment environment{*engine, *telemetry, "test", {}, nullptr};
  grpc::CallbackServerContext context;
};

// Is entered among the slow requests by a tick that is still at work when gRPC
// is done with the call.
class LateReactor final
    : public GuardedReactor<grpc::ServerBidiReactor<Message, Message>> {
 public:
  explicit LateReactor(Surroundings& around)
      : GuardedReactor(around.environment, &around.context,
                       "ShapeService.GetShape") {}

  void OnTick(absl::Time) override {
    if (ticked_) return;
    ticked_ = true;
    in_tick.set_value();
    done_begun.get_future().wait();
    // Time for OnDone to do what it does before it waits for this tick.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    holdings().Hold(environment().requests, 1);
  }

  std::promise<void> in_tick;
  std::promise<void> done_begun;

 protected:
  void Begin() override {}

 private:
  bool ticked_ = false;
};

TEST(GuardedReactor, LeavesNothingInABudgetWhenATickMeetsItsEnd) {
  Surroundings around;
  const auto reactor = std::make_shared<LateReactor>(around);
  reactor->Enter();
  reactor->in_tick.get_future().wait();
  reactor->done_begun.set_value();
  reactor->OnDone();
  EXPECT_EQ(around.environment.requests.bytes(), 0);
}

}  // namespace
}  // namespace argmesh
