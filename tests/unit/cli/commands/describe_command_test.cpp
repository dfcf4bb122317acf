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
  const std::string stlsq = run_command({"describe", "stlsq"}).out;
  EXPECT_THAT(stlsq, HasSubstr("threshold  (number, >= 0; default 0.01)"));
  EXPECT_THAT(stlsq, HasSubstr("one of contribution, coefficient"));
  EXPECT_THAT(run_command({"describe", "irls-l1"}).out,
              HasSubstr("inner  (l1-solver; default coordinate-descent)"));
  EXPECT_THAT(run_command({"describe", "savitzky-golay"}).out,
              HasSubstr("window  (whole number or none, samples"));
  EXPECT_THAT(run_command({"describe", "ols"}).out, HasSubstr("no options"));
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
