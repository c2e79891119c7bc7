// SIGTERM, whatever the server is doing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "client/client.h"
#include "tests/reliability/small_service.h"
#include "tests/reliability/witness.h"
#include "tests/support/large_database.h"

namespace argmesh {
namespace {

using testing::HasSubstr;

TEST(StopTest, EndsTheOpeningOfALargeStore) {
  SmallService service;
  ASSERT_EQ(service.Start(1), "");
  Installation& installation = service.installation();
  installation.SignalServer(SIGTERM);
  ASSERT_EQ(installation.WaitForServer(), 0);
  const std::filesystem::path store = installation.folder() / "store";
  ASSERT_TRUE(MakeLarge(store / "catalog.db", 6'000'000).ok());
  ASSERT_TRUE(std::filesystem::remove(store / "clean"));

  installation.LaunchServer();
  ASSERT_TRUE(installation.WaitForLog("opening the store"));
  installation.SignalServer(SIGTERM);
  EXPECT_EQ(installation.WaitForServer(), 0) << installation.ServerLog();
  EXPECT_THAT(installation.ServerLog(), HasSubstr("stopped before it served"));
  EXPECT_FALSE(std::filesystem::exists(store / "clean"))
      << "the check was not done";

  ASSERT_TRUE(installation.StartServer());
  EXPECT_THAT(installation.ServerLog(), HasSubstr("\"check\":true"));
  EXPECT_EQ(service.Caller().Get("torus-0"), "");
}

// A client that tries again for as long as a restart takes.
std::unique_ptr<Client> RetryingClient(const std::string& address) {
  ClientOptions options;
  options.retry.max_attempts = 50;
  options.retry.max_backoff = absl::Milliseconds(500);
  auto client = Client::Connect(address, options);
  EXPECT_TRUE(client.ok()) << client.status();
  return *std::move(client);
}

template <typename Answer>
std::string FailureOf(const absl::StatusOr<Answer>& answer) {
  return answer.ok() ? "" : answer.status().ToString();
}

// Calls that may be repeated: writes by their request_id.
std::vector<std::unique_ptr<Witness>> IdempotentLoad(
    const std::string& address) {
  std::vector<std::unique_ptr<Witness>> clients;
  const auto add = [&](auto&& call) {
    const std::shared_ptr<Client> client = RetryingClient(address);
    clients.push_back(
        std::make_unique<Witness>([client, call, round = 0]() mutable {
          return call(*client, round++);
        }));
  };
  add([](Client& client, int) {
    return FailureOf(client.GetShape(ShapeNamed("torus-0")));
  });
  add([](Client& client, int) {
    v1::ListShapesRequest request;
    request.set_parent(kParts);
    return FailureOf(client.ListShapes(request));
  });
  add([](Client& client, int) {
    v1::SearchShapesRequest request;
    request.set_parent(kParts);
    request.set_shape(ShapeNamed("torus-1"));
    return FailureOf(client.SearchShapes(request));
  });
  add([](Client& client, int round) {
    const std::string id = "added-" + std::to_string(round);
    v1::CreateShapeRequest create = TorusRequest(id, 0.5);
    std::string failure = FailureOf(client.CreateShape(create));
    if (!failure.empty()) return failure;
    v1::DeleteShapeRequest remove;
    remove.set_name(ShapeNamed(id));
    return FailureOf(client.DeleteShape(remove));
  });
  return clients;
}

TEST(StopTest, FailsNoCallThatIsTriedAgain) {
  SmallService service;
  ASSERT_EQ(service.Start(4), "");
  Installation& installation = service.installation();
  auto clients = IdempotentLoad(service.address());
  for (int stop = 0; stop < 3; ++stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    installation.SignalServer(SIGTERM);
    EXPECT_EQ(installation.WaitForServer(), 0) << installation.ServerLog();
    ASSERT_TRUE(installation.StartServer());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  size_t answered = 0;
  for (const auto& client : clients) {
    const Testimony testimony = client->Take();
    EXPECT_EQ(testimony.failed, 0) << testimony.failure;
    EXPECT_FALSE(testimony.milliseconds.empty());
    answered += testimony.milliseconds.size();
  }
  std::printf("measured: 3 stops and starts, %zu calls answered, %s\n",
              answered, HasFailure() ? "some failed" : "none failed");
}

}  // namespace
}  // namespace argmesh
