// SPDX-License-Identifier: MIT
// Bad input given to the built program: one line that names the place and the remedy, status 2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// Identifies a file of the given content; expects an error with all the given parts.
void expect_bad_record(const std::string& content, const std::vector<std::string>& parts,
                       const std::string& options = "") {
  const TemporaryFolder folder;
  const std::string path = folder.write("bad.csv", content);
  expect_program_error("identify " + path + " " + options, 2, parts);
}

/// "t,x,y" and n rows of an oscillation.
std::string good_rows(int n) {
  std::string text = "t,x,y\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," +
            std::to_string(-std::sin(0.1 * i)) + "\n";
  return text;
}

TEST(BadInput, EmptyFile) { expect_bad_record("", {"bad.csv", "empty", "; "}); }

TEST(BadInput, AbsentFile) { expect_program_error("identify no.csv", 2, {"no.csv", "; "}); }

TEST(BadInput, OneRow) { expect_bad_record("t,x\n0,1\n", {"bad.csv", "; "}); }

TEST(BadInput, RaggedLine) { expect_bad_record(good_rows(50) + "5,1\n", {"bad.csv:52", "; "}); }

TEST(BadInput, TextInAColumn) {
  expect_bad_record(good_rows(50) + "5,one,1\n", {"bad.csv:52:", "one", "; "});
}

TEST(BadInput, OnlyMissingValues) {
  expect_bad_record("t,x\n0,nan\n1,nan\n2,nan\n", {"bad.csv", "; "});
}

TEST(BadInput, Infinity) {
  expect_bad_record(good_rows(50) + "5,inf,1\n", {"bad.csv:52", "; "});
}

TEST(BadInput, TimeBackwards) {
  expect_bad_record(good_rows(50) + "4.05,1,1\n", {"bad.csv:52", "; "});
}

TEST(BadInput, DuplicateNames) {
  expect_bad_record("t,x,x\n0,1,2\n1,2,3\n2,3,4\n", {"bad.csv", "'x'", "; "});
}

TEST(BadInput, FewerRowsThanTerms) {
  expect_bad_record(good_rows(28), {"rows", "28", "; "}, "--degree 6");
}

TEST(BadInput, FewerSamplesThanTerms) {
  expect_bad_record(good_rows(25), {"25 samples", "66", "; "}, "--degree 10");
}

TEST(BadInput, ConstantColumn) {
  std::string text = "t,x,y\n";
  for (int i = 0; i < 50; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + ",3\n";
  expect_bad_record(text, {"'y'", "; "});
}

TEST(BadInput, AllZeroDerivative) {
  std::string text = "t,x,dx\n";
  for (int i = 0; i < 50; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + ",0\n";
  expect_bad_record(text, {"x", "; "}, "--states x --derivatives dx");
}

TEST(BadInput, UnknownOptionInAConfiguration) {
  const TemporaryFolder folder;
  const std::string config =
      folder.write("c.json", R"({"regressor": {"type": "stlsq", "treshold": 0.1}})");
  expect_program_error(
      "identify " + folder.write("r.csv", good_rows(60)) + " --config " + config, 2,
      {"$.regressor.treshold", "threshold"});
}

TEST(BadInput, ConfigurationThatIsNotJson) {
  const TemporaryFolder folder;
  const std::string config = folder.write("c.json", "{\"regressor\": }");
  expect_program_error(
      "identify " + folder.write("r.csv", good_rows(60)) + " --config " + config, 2,
      {"c.json:1:15", "not valid JSON", "; "});
}

TEST(BadInput, UnknownTermInAModel) {
  const TemporaryFolder folder;
  const std::string model = folder.write(
      "m.json", R"({"format": "lacuna.model/1", "time_unit": "s", "states": [{"name": "x"}],
          "inputs": [], "equations": [{"state": "x", "terms": [{"term": "x*q",
          "coefficient": 1.0}]}]})");
  expect_program_error("simulate " + model + " --x0 1 --t-end 1 --dt 0.1", 2,
                       {"m.json", "$.equations[0].terms[0].term", "q", "; "});
}

TEST(BadInput, UnknownTermOnTheCommandLine) {
  const TemporaryFolder folder;
  expect_program_error(
      "identify " + folder.write("r.csv", good_rows(60)) + " --terms 'x,sin(q)'", 2,
      {"sin(q)", "column 5"});
}

TEST(BadInput, UnknownColumn) {
  expect_bad_record(good_rows(50), {"'w'", "; "}, "--states x,w");
}

}  // namespace
}  // namespace lacuna::testing
