// Every ErrorReason is produced: each value of the enum, as the descriptor has
// it, is provoked and must come back as itself, with its code. A reason that
// nothing provokes fails the test; so does a provocation of none.
#include <gtest/gtest.h>

#include <string>

#include "argmesh/v1/error_reason.pb.h"
#include "server/engine/error_reason.h"
#include "tests/integration/provoked_errors.h"

namespace argmesh {
namespace {

TEST(ErrorReasons, ComeBackAsThemselvesEveryOne) {
  ProvokedErrors provoked;
  ProvokedErrors::Provocations all = provoked.All();
  const std::string prefix = "ERROR_REASON_";
  const auto& reasons = *v1::ErrorReason_descriptor();
  for (int i = 0; i < reasons.value_count(); ++i) {
    const auto number = reasons.value(i)->number();
    if (number == v1::ERROR_REASON_UNSPECIFIED) continue;
    const std::string name = reasons.value(i)->name().substr(prefix.size());
    SCOPED_TRACE(name);
    const auto provoke = all.find(name);
    if (provoke == all.end()) {
      ADD_FAILURE() << "no test produces this reason";
      continue;
    }
    const ErrorOf error = provoke->second();
    EXPECT_EQ(error.reason, name) << error;
    EXPECT_EQ(error.domain, "argmesh.v1");
    EXPECT_EQ(
        static_cast<int>(error.code),
        static_cast<int>(ErrorReasonCode(static_cast<ErrorReason>(number))));
    all.erase(provoke);
  }
  for (const auto& [name, provoke] : all) {
    ADD_FAILURE() << name << " is no value of the enum";
  }
}

}  // namespace
}  // namespace argmesh
