// SPDX-License-Identifier: MIT
// Real measurements; run where the environment variable LACUNA_DATA names their folder.
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "integration/program.hpp"
#include "lacuna/bases/expressions.hpp"
#include "lacuna/data/read.hpp"
#include "lacuna/differentiators/finite_differences.hpp"
#include "lacuna/dynamics/record_input.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/dynamics/simulate.hpp"
#include "lacuna/formulations/embedding.hpp"
#include "lacuna/pipeline/presets.hpp"

namespace lacuna::testing {
namespace {

/// The folder of the measurements; nothing where it is not known.
std::optional<std::string> measurements() {
  const char* folder = std::getenv("LACUNA_DATA");
  return folder == nullptr ? std::nullopt : std::optional<std::string>(folder);
}

/// Electro-mechanical positioning system: M q'' = F - Fv q' - Fc sign(q') - offset, published
/// as 95.11 kg, 203.5 N s/m, 20.39 N, -3.16 N (Janot, Gautier, Brunot 2019).
TEST(MeasuredData, EmpsParametersAreWithinFivePercentOfThePublishedOnes) {
  const auto folder = measurements();
  if (!folder) GTEST_SKIP() << "LACUNA_DATA is not set";
  const CommandResult result = run_program(
      "identify " + *folder + "/emps/emps_train.csv.gz --time t --states q --inputs F " +
      "--embed q=2 --terms 'sign(q_d1),1,F,q_d1' " +
      "--set differentiator.type=savitzky-golay --set differentiator.degree=6 " +
      "--set differentiator.window=31 --json -");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  std::map<std::string, double> found;
  for (const auto& term : json["model"]["equations"][1]["terms"])
    found[term["term"].get<std::string>()] = term["coefficient"].get<double>();
  ASSERT_EQ(found.size(), 4u) << result.out;
  const double mass = 1.0 / found["F"];
  EXPECT_NEAR(mass, 95.11, 0.05 * 95.11);
  EXPECT_NEAR(-mass * found["q_d1"], 203.5, 0.05 * 203.5);
  EXPECT_NEAR(-mass * found["sign(q_d1)"], 20.39, 0.05 * 20.39);
  EXPECT_NEAR(-mass * found["1"], -3.16, 0.05 * 3.16);
}

/// Samples [first, last) of a record of u and y.
Dataset part(const Dataset& all, Index first, Index last) {
  Dataset data = all;
  Trajectory& record = data.trajectories.front();
  const Trajectory& from = all.trajectories.front();
  record.time = from.time.segment(first, last - first);
  record.states = from.states.middleRows(first, last - first);
  record.inputs = from.inputs.middleRows(first, last - first);
  return data;
}

/// Root mean square of y minus its free simulation from the 50th sample on.
double simulation_error(const OdeModel& model, const Dataset& embedded) {
  constexpr Index kStart = 50;
  const Trajectory& record = embedded.trajectories.front();
  const Index n = record.samples() - kStart;
  RecordInput input(record);
  const Vector start = record.states.row(kStart);
  const Solution orbit = simulate(model, Rk4{}, start, record.time.tail(n), input);
  EXPECT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  return std::sqrt((orbit.states.col(0) - record.states.col(0).tail(n)).squaredNorm() /
                   static_cast<double>(n));
}

/// Electronic Duffing oscillator (Wigren, Schoukens 2013): multisines in samples 40 650 to
/// 127 399, the first three quarters for training, the last for testing.
TEST(MeasuredData, SilverboxIsSimulatedToThreeMillivolts) {
  const auto folder = measurements();
  if (!folder) GTEST_SKIP() << "LACUNA_DATA is not set";
  ColumnRoles roles;
  roles.states = {"y"};
  roles.inputs = {"u"};
  const Dataset all = read_dataset({*folder + "/silverbox/silverbox_snls80mv.csv.gz"}, roles);
  constexpr Index kFirst = 40650, kSplit = 105712, kLast = 127400;
  const FiniteDifferences differences{{.order = 10}};
  Pipeline pipeline = algorithm1();
  pipeline.basis = Expressions{{.terms = {"1", "y", "y_d1", "y^2", "y^3", "u"}}};
  const IdentificationResult result =
      identify(embed(part(all, kFirst, kSplit), {{"y", 2}}, differences), pipeline);
  const double error =
      simulation_error(result.model, embed(part(all, kSplit, kLast), {{"y", 2}}, differences));
  EXPECT_LT(error, 3e-3) << to_text(result.model);
  RecordProperty("rmse_mV", std::to_string(1e3 * error));
}

}  // namespace
}  // namespace lacuna::testing
