// SPDX-License-Identifier: MIT
// Bad input given to the built program: one line that names the place and the remedy, status 2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// "t,x,y" and n rows of an oscillation.
std::string good_rows(int n) {
  std::string text = "t,x,y\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," +
            std::to_string(-std::sin(0.1 * i)) + "\n";
  return text;
}

/// n rows of an oscillation and a further column.
std::string rows_with(const std::string& name, const std::string& value) {
  std::string text = "t,x," + name + "\n";
  for (int i = 0; i < 50; ++i)
    text +=
        std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," + value + "\n";
  return text;
}

TEST(BadInput, RecordsAreRefusedInOneLine) {
  const struct {
    std::string content, options;
    std::vector<std::string> parts;
  } records[] = {
      {"", "", {"bad.csv", "empty", "; "}},
      {"t,x\n0,1\n", "", {"bad.csv", "; "}},
      {good_rows(50) + "5,1\n", "", {"bad.csv:52", "; "}},
      {good_rows(50) + "5,one,1\n", "", {"bad.csv:52:", "one", "; "}},
      {"t,x\n0,nan\n1,nan\n2,nan\n", "", {"bad.csv", "; "}},
      {good_rows(50) + "5,inf,1\n", "", {"bad.csv:52", "; "}},
      {good_rows(50) + "4.05,1,1\n", "", {"bad.csv:52", "; "}},
      {"t,x,x\n0,1,2\n1,2,3\n2,3,4\n", "", {"bad.csv", "'x'", "; "}},
      {good_rows(28), "--degree 6", {"rows", "28", "; "}},
      {good_rows(25), "--degree 10", {"25 samples", "66", "; "}},
      {rows_with("y", "3"), "", {"'y'", "; "}},
      {rows_with("dx", "0"), "--states x --derivatives dx", {"x", "; "}},
      {good_rows(60), "--terms 'x,sin(q)'", {"sin(q)", "column 5"}},
      {good_rows(50), "--states x,w", {"'w'", "; "}},
  };
  const TemporaryFolder folder;
  for (const auto& record : records)
    expect_program_error(
        "identify " + folder.write("bad.csv", record.content) + " " + record.options, 2,
        record.parts);
  expect_program_error("identify no.csv", 2, {"no.csv", "; "});
}

TEST(BadInput, ConfigurationsAndModelsAreRefusedInOneLine) {
  const TemporaryFolder folder;
  const std::string identify =
      "identify " + folder.write("r.csv", good_rows(60)) + " --config ";
  expect_program_error(
      identify + folder.write("c.json", R"({"regressor": {"type": "stlsq", "treshold": 0.1}})"),
      2, {"$.regressor.treshold", "threshold"});
  expect_program_error(identify + folder.write("c.json", "{\"regressor\": }"), 2,
                       {"c.json:1:15", "not valid JSON", "; "});
  const std::string model = folder.write(
      "m.json", R"({"format": "lacuna.model/1", "time_unit": "s", "states": [{"name": "x"}],
          "inputs": [], "equations": [{"state": "x", "terms": [{"term": "x*q",
          "coefficient": 1.0}]}]})");
  expect_program_error("simulate " + model + " --x0 1 --t-end 1 --dt 0.1", 2,
                       {"m.json", "$.equations[0].terms[0].term", "q", "; "});
}

}  // namespace
}  // namespace lacuna::testing
