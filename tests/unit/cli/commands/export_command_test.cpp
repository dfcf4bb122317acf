// SPDX-License-Identifier: MIT
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

TEST(ExportCommand, WritesTheFormatThatIsAskedFor) {
  EXPECT_THAT(run_command({"export", "lorenz", "--format", "c"}).out,
              HasSubstr("rate_[1] = 28.0*x - y - x*z;"));
  const testing::TemporaryFolder place;
  const std::string out = place.file("lorenz.py");
  const auto run = run_command({"export", "lorenz", "--format", "python", "-o", out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.empty());
}

TEST(ExportCommand, NamesTheNearestFormat) {
  expect_failure(run_command({"export", "lorenz", "--format", "pyton"}), 2,
                 {"pyton", "python"});
}

}  // namespace
}  // namespace lacuna
