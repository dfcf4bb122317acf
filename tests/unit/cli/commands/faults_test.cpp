// SPDX-License-Identifier: MIT
// What a command line is refused with.
#include "unit/cli/commands/records.hpp"

namespace lacuna::cli {
namespace {

using lacuna::testing::expect_failure;
using lacuna::testing::run_command;

TEST(Faults, NoWordIsOfTheParser) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> faults = {
      {{"identify", "r", "--effort", "QUICK"},
       "--effort: 'QUICK' is none of full, normal, quick"},
      {{"identify", "r", "--degree", "abc"}, "--degree: 'abc' is no number"},
      {{"identify", "r", "--degree", "1.5"}, "--degree: '1.5' is no whole number"},
      {{"identify", "r", "--threads", "0"}, "--threads: '0' is no number from 1 to 1024"},
      {{"identify", "r", "--discrete=maybe"}, "--discrete takes no value"},
      {{"identify", "r", "--json"}, "--json: the value is missing"},
      {{"identify", "r", "--json", "a", "--json", "b"}, "--json: 2 values are given; keep one"},
      {{"identify", "r", "--terms", "x", "--degree", "2"}, "exclude each other"},
      {{"identify"}, "DATA is missing"},
      {{}, "no command is given"},
      {{"identfy"}, "did you mean 'identify'"},
      {{"report"}, "'report' is an option, as in `lacuna "},
      {{"simulate", "lorenz", "--t-end", "nan", "--dt", "1"}, "'nan' is no finite number"},
      {{"identify", "r", "--degre", "2"}, "'--degre' is not known; did you mean '--degree'?"}};
  for (const auto& [words, sentence] : faults)
    expect_failure(run_command(words), 2, {"command line: ", sentence, "--help`"});
}

}  // namespace
}  // namespace lacuna::cli
