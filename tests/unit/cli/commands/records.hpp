// SPDX-License-Identifier: MIT
// Small records on disk for the tests of the command line.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_command.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {

/// Runs a command that has to end with status 0.
inline CommandResult run_well(const std::vector<std::string>& words) {
  CommandResult result = run_command(words);
  EXPECT_EQ(result.status, 0) << ::testing::PrintToString(words) << result.err;
  return result;
}

/// Its answer as JSON.
inline nlohmann::json json_of(std::vector<std::string> words) {
  words.insert(words.end(), {"--json", "-"});
  return nlohmann::json::parse(run_well(words).out);
}

/// A folder with an orbit of Rossler's system in "r.csv" and a model of a linear oscillator in
/// "osc.json" (dx/dt = v, dv/dt = -4 x + u) with a record of x and u in "osc.csv".
class Records {
 public:
  Records() {
    run_well({"simulate", "rossler", "--x0", "1,1,0", "--t-end", "100", "--dt", "0.05", "-o",
              rossler()});
    folder_.write("osc.json", R"({"format": "lacuna.model/1", "time_unit": "s",
      "states": [{"name": "x", "unit": "m"}, {"name": "v", "unit": "m/s"}],
      "inputs": [{"name": "u", "unit": "N"}],
      "equations": [{"state": "x", "terms": [{"term": "v", "coefficient": 1.0}]},
                    {"state": "v", "terms": [{"term": "x", "coefficient": -4.0},
                                             {"term": "u", "coefficient": 1.0}]}]})");
    std::string record = "t [s],x [m],u [N]\n";
    for (int i = 0; i < 400; ++i) {
      const double t = 0.02 * i;
      const double x = std::cos(2.0 * t) + std::sin(t) / 3.0;
      record += std::to_string(t) + "," + std::to_string(x) + "," +
                std::to_string(std::sin(t)) + "\n";
    }
    folder_.write("osc.csv", record);
  }

  std::string rossler() const { return folder_.file("r.csv"); }
  std::string oscillator() const { return folder_.file("osc.csv"); }
  std::string oscillator_model() const { return folder_.file("osc.json"); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

/// Whether a run ended with an error of one line that has all the given parts.
inline void expect_failure(const CommandResult& result, int status,
                           const std::vector<std::string>& parts) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.err.rfind("lacuna: error: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) EXPECT_THAT(result.err, ::testing::HasSubstr(part));
}

/// The same of a command that ends with status 2.
inline void expect_refused(const std::vector<std::string>& words,
                           const std::vector<std::string>& parts) {
  expect_failure(run_command(words), 2, parts);
}

}  // namespace lacuna::testing
