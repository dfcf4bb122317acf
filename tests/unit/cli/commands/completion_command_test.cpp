// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::run_command;

TEST(CompletionCommand, KnowsCommandsAndTheirOptions) {
  for (const char* shell : {"bash", "zsh"}) {
    const auto result = run_command({"completion", shell});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("identify"));
    EXPECT_THAT(result.out, HasSubstr("--report"));
    EXPECT_THAT(result.out, HasSubstr("    sync) options='"));
  }
  EXPECT_EQ(run_command({"completion", "fish"}).status, 2);
}

TEST(CompletionCommand, BashTakesItsScript) {
  const testing::TemporaryFolder folder;
  const std::string script = folder.write("s", run_command({"completion", "bash"}).out);
  const std::string test = ". '" + script +
                           "'; COMP_WORDS=(lacuna dia); COMP_CWORD=1; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = diagnose ] || exit 3; "
                           "COMP_WORDS=(lacuna sync --coup); COMP_CWORD=2; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = --coupling ] || exit 4; "
                           "COMP_WORDS=(lacuna help dia); COMP_CWORD=2; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = diagnose ]";
  const std::string run = folder.write("run.sh", test);
  EXPECT_EQ(std::system(("bash '" + run + "'").c_str()), 0);
}

}  // namespace
}  // namespace lacuna
