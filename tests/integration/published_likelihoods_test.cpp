// SPDX-License-Identifier: MIT
// Likelihoods at published numbers; run where the environment variable LACUNA_DATA names the
// folder of the measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

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

}  // namespace
}  // namespace lacuna::testing
