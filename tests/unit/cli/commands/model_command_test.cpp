// SPDX-License-Identifier: MIT
#include <fstream>

#include "lacuna/model/files/ode_text.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ModelCommand, ShowsTheOtherFormat) {
  const testing::TemporaryFolder place;
  const std::string ode = place.write("a.ode", "time s\nstate x\ndx/dt = -0.5*x\n");
  const std::string json = place.file("a.json");
  ASSERT_EQ(run_command({"model", ode, "-o", json}).status, 0);
  EXPECT_EQ(run_command({"model", ode}).out, text_of(json));
  EXPECT_EQ(run_command({"model", json}).out, text_of(ode));
}

TEST(ModelCommand, TheNameOfTheOutputSaysItsFormat) {
  const testing::TemporaryFolder place;
  const std::string out = place.file("lorenz.ode");
  ASSERT_EQ(run_command({"model", "lorenz", "-o", out}).status, 0);
  EXPECT_THAT(text_of(out), HasSubstr("dy/dt = 28*x - y - x*z"));
  EXPECT_EQ(run_command({"model", "lorenz"}).out, text_of(out));
  EXPECT_EQ(
      run_command({"simulate", out, "--x0", "1,1,1", "--t-end", "0.1", "--dt", "0.1"}).out,
      run_command({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "0.1", "--dt", "0.1"})
          .out);
}

TEST(ModelCommand, ErrorsHaveAPlace) {
  const testing::TemporaryFolder place;
  const std::string ode = place.write("a.ode", "dx/dt = -0.5*y\n");
  expect_failure(run_command({"model", ode}), 2, {"a.ode:1:14", "unknown name 'y'"});
}

}  // namespace
}  // namespace lacuna
