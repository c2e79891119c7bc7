// SIGTERM, whatever the server is doing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <thread>

#include "tests/reliability/small_service.h"
#include "tests/support/large_database.h"

namespace argmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

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

}  // namespace
}  // namespace argmesh
