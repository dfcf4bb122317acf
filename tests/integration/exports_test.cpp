// SPDX-License-Identifier: MIT
// Exported models, run by the programs they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/text.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

TEST(Exports, PythonRunsThroughSolveIvp) {
  const std::string python = python_with("scipy");
  if (python.empty()) GTEST_SKIP() << "there is no SciPy";
  const TestSystem& lorenz = test_system("lorenz");
  const TemporaryFolder place;
  std::vector<std::string> start;
  for (const double value : lorenz.start) start.push_back(format_number(value));
  const std::string script =
      place.write("run.py", export_model(lorenz.model, "python") +
                                "\nfrom scipy.integrate import solve_ivp\n"
                                "run = solve_ivp(lambda t, x: rate(t, x, []), (0, 5), [" +
                                join(start, ", ") +
                                "], method='DOP853', rtol=1e-12, atol=1e-12)\n"
                                "print(*('%.17g' % x for x in run.y[:, -1]))\n");
  const std::vector<double> end = printed_numbers(python + " " + script);
  const Solution orbit =
      simulate(lorenz.model, Dopri87{}, lorenz.start, sample_times(0.0, 0.001, 5001), {});
  ASSERT_EQ(end.size(), 3u);
  for (Index k = 0; k < 3; ++k)
    EXPECT_NEAR(end[static_cast<std::size_t>(k)], orbit.end_state[k], 1e-6);
}

/// Two stretches of a chaotic orbit, of 290 turns each: extents of the attractor.
TEST(Exports, RosslersCircuitHasItsAttractorInNgspice) {
  if (!can_run("ngspice --version")) GTEST_SKIP() << "there is no ngspice";
  const TestSystem& circuit = test_system("tl072");
  const TemporaryFolder place;
  std::string deck = "* circuit\n" + export_model(circuit.model, "spice") +
                     "X1 x y z lacuna_model\n.ic v(x)=0.5 v(y)=0.1 v(z)=0.1\n"
                     ".tran 0.05 2000 200 0.02 uic\n";
  for (const char* name : {"x", "y", "z"})
    for (const char* end : {"min", "max"})
      deck += std::string(".meas tran ") + name + end + " " + end + " v(" + name + ")\n";
  const std::string file = place.write("deck.cir", deck + ".end\n");
  const std::vector<double> found =
      printed_numbers("ngspice -b " + file +
                      " 2>/dev/null | sed -n 's/^[xyz]m[ainx]* *= *\\([^ ]*\\).*/\\1/p'");
  ASSERT_EQ(found.size(), 6u);
  const Solution orbit =
      simulate(circuit.model, Dopri87{}, circuit.start, sample_times(0.0, 0.05, 40001), {});
  const Matrix settled = orbit.states.bottomRows(36000);
  for (Index k = 0; k < 3; ++k) {
    const auto place_of = static_cast<std::size_t>(2 * k);
    const double low = settled.col(k).minCoeff(), high = settled.col(k).maxCoeff();
    EXPECT_NEAR(found[place_of], low, 0.01 * (high - low)) << k;
    EXPECT_NEAR(found[place_of + 1], high, 0.01 * (high - low)) << k;
  }
}

}  // namespace
}  // namespace lacuna::testing
