// SPDX-License-Identifier: MIT
// Likelihoods at published numbers; run where the environment variable LACUNA_DATA names the
// folder of the measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "data/derivatives/finite_differences.hpp"
#include "integration/program.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna::testing {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The model with its parameters known: what is estimated is the noise alone.
SystemModel known_model(std::string text, const std::string& range) {
  for (std::size_t at = text.find(range); at != std::string::npos; at = text.find(range))
    text.replace(at, range.size(), "fixed");
  return parse_ode_system(text, "published.ode");
}

/// STAT5 dimerisation (Boehm et al., J. Proteome Res. 13:5685-5694, 2014), as in the PEtab
/// collection (BSD-3-Clause): -log L = 138.22200 with the deviations of the largest likelihood.
TEST(PublishedLikelihoods, Boehm) {
  const char* folder = std::getenv("LACUNA_DATA");
  if (folder == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const std::string base = std::string(folder) + "/devices/boehm/boehm";
  const SystemModel model = known_model(text_of(base + ".ode"), "in 1e-5..1e5");
  const Fit found = fit(
      model, read_records(model.model(), {base + ".csv"}, {}, FiniteDifferences{}), {});
  EXPECT_NEAR(found.log_likelihood, -138.222, 1e-3);
}

/// The values with a column of standard deviations for each, from the table of deviations.
std::string with_deviations(const std::string& folder) {
  const std::vector<std::string> names{"Naive", "EarlyEffector", "LateEffector", "Memory"};
  std::map<std::pair<std::string, std::string>, std::string> deviations;
  std::istringstream list(text_of(folder + "/deviations.tsv"));
  std::string observable, value, time, deviation;
  std::getline(list, value);
  while (list >> observable >> value >> time >> deviation)
    deviations[{observable.substr(std::string("observable_").size()), time}] = deviation;
  std::istringstream rows(text_of(folder + "/cr.csv"));
  std::string row, text;
  while (std::getline(rows, row)) {
    const std::string at = row.substr(0, row.find(','));
    text += row;
    for (const std::string& name : names)
      text += "," + (at == "t" ? "s" + name : deviations[{name, at}]);
    text += "\n";
  }
  return text;
}

/// T cells after an infection (Crauste et al., Cell Syst. 4:306-317, 2017), as in the PEtab
/// collection: -log L = 190.964 is published. The minimum that is found for the model of the
/// folder is 190.987, where scipy's LSODA gives 190.9871. The published numbers as printed
/// have no finite run; two digits near the minimum have one. The standard deviation of each value
/// is known; values are blank where nothing was counted.
TEST(PublishedLikelihoods, Crauste) {
  const char* data = std::getenv("LACUNA_DATA");
  if (data == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const std::string given = std::string(data) + "/devices/crauste";
  const TemporaryFolder folder;
  std::string text = text_of(given + "/crauste.ode") + "\nfixed dP/dt: P\n";
  for (const auto& [name, value] : std::map<std::string, std::string>{
           {"rE", "0.53"}, {"muEE", "3.3e-5"}, {"dEL", "0.54"}, {"muLL", "7.8e-6"},
           {"dLM", "0.023"}, {"rP", "0.12"}, {"muPL", "2.8e-5"}})
    text = std::regex_replace(text, std::regex("param " + name + " = \\S+"),
                              "param " + name + " = " + value);
  const std::string model = folder.write("c.ode", text);
  const std::string values = folder.write("c.csv", with_deviations(given));
  const CommandResult result = run_program(
      "fit " + model + " " + values +
      " --start-time 0 --deviation Naive=sNaive --deviation EarlyEffector=sEarlyEffector"
      " --deviation LateEffector=sLateEffector --deviation Memory=sMemory --progress never"
      " --starts 0 --json -");
  ASSERT_EQ(result.err, "");
  const double found = -nlohmann::json::parse(result.out)["log_likelihood"].get<double>();
  EXPECT_NEAR(found, 190.987, 0.02);
  EXPECT_NEAR(found, 190.964, 0.1);
}

}  // namespace
}  // namespace lacuna::testing
