// SPDX-License-Identifier: MIT
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;
using testing::unfolded;

TEST(DescribeCommand, ShowsOptionsOfEveryPart) {
  const Registry registry = default_registry();
  for (const RegistryEntry& entry : registry.entries()) {
    const auto result = run_command({"describe", std::string(entry.info.name)});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.out, HasSubstr("(" + std::string(entry.kind) + ")"));
    EXPECT_THAT(unfolded(result.out), HasSubstr(std::string(entry.info.summary)));
  }
  EXPECT_THAT(run_command({"describe", "stlsq"}).out,
              HasSubstr("threshold  (number, >= 0; default 0.01)"));
}

TEST(DescribeCommand, ShowsPresetsAndSystems) {
  EXPECT_THAT(run_command({"describe", "algorithm1"}).out, HasSubstr("\"filter\":{"));
  const std::string lorenz = run_command({"describe", "lorenz"}).out;
  EXPECT_THAT(lorenz, HasSubstr("dx/dt = "));
  EXPECT_THAT(lorenz, HasSubstr("Start: "));
}

TEST(DescribeCommand, SuggestsTheNearestName) {
  expect_failure(run_command({"describe", "stslq"}), 2, {"stslq", "stlsq"});
}

}  // namespace
}  // namespace lacuna
