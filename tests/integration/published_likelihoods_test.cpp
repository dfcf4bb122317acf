// SPDX-License-Identifier: MIT
// Likelihoods at published numbers; run where the environment variable LACUNA_DATA names the
// folder of the measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/model/files/ode_text.hpp"
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

std::string with_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from))
    text.replace(at, from.size(), to);
  return text;
}

/// The model with its parameters known: what is estimated is the noise alone.
SystemModel known_model(const std::string& text, const std::string& range) {
  return parse_ode_system(with_all(text, range, "fixed"), "published.ode");
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

/// Deviations by observable and time, of lines "observable_x<tab>value<tab>time<tab>deviation".
std::map<std::pair<std::string, double>, double> deviations_of(const std::string& path) {
  std::map<std::pair<std::string, double>, double> all;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  for (std::string name; file >> name;) {
    double value = 0.0, time = 0.0, deviation = 0.0;
    file >> value >> time >> deviation;
    all[{name.substr(name.find('_') + 1), time}] = deviation;
  }
  return all;
}

/// T cells (Crauste et al., Cell Systems 4:306-317, 2017), as in the PEtab collection
/// (BSD-3-Clause): -log L = 190.964 with the published deviation of each value.
TEST(PublishedLikelihoods, Crauste) {
  const char* folder = std::getenv("LACUNA_DATA");
  if (folder == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const std::string base = std::string(folder) + "/devices/crauste/";
  const std::string text = text_of(base + "crauste.ode");
  const SystemModel published = known_model(with_all(text, "in 1e-10..1000", "fixed"),
                                            "in 1e-5..1000");
  const SystemModel start = parse_ode_system(text, "crauste.ode");
  Dataset data = read_records(start.model(), {base + "cr.csv"}, {.blanks = Blanks::Keep},
                              FiniteDifferences{});
  const auto deviations = deviations_of(base + "deviations.tsv");
  ASSERT_EQ(deviations.size(), 21u);
  FitOptions options{.start_time = 0.0};
  ASSERT_EQ(data.trajectories.size(), 1u);
  Trajectory& record = data.trajectories[0];
  for (const std::string name : {"Naive", "EarlyEffector", "LateEffector", "Memory"}) {
    record.inputs.conservativeResize(record.samples(), data.input_count() + 1);
    for (Index i = 0; i < record.samples(); ++i) {
      const auto own = deviations.find({name, record.time[i]});
      record.inputs(i, data.input_count()) = own == deviations.end() ? 1.0 : own->second;
    }
    data.inputs.push_back({"sd_" + name, ""});
    options.deviations.push_back({name, "sd_" + name});
  }
  EXPECT_NEAR(fit(published, data, {}, options).log_likelihood, -190.964, 1e-3);
  EXPECT_GT(fit(start, data, {}, options).log_likelihood, -190.965);
}

}  // namespace
}  // namespace lacuna::testing
