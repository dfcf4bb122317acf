// SPDX-License-Identifier: MIT
// Refinement of measured records: parameters of a positioning system and an electronic Duffing
// oscillator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "lacuna/data/read.hpp"
#include "lacuna/dynamics/record_input.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/dynamics/simulate.hpp"
#include "lacuna/refine/refine.hpp"

namespace lacuna {
namespace {

Dataset measured(const std::string& file, const ColumnRoles& roles) {
  const char* folder = std::getenv("LACUNA_DATA");
  if (!folder) return {};
  return read_dataset({(std::filesystem::path(folder) / file).string()}, roles);
}

/// dq/dt = v exactly; dv/dt from terms with coefficients to start from.
ParametrisedModel second_order(const std::string& q, const std::string& input,
                               const std::vector<std::pair<std::string, double>>& terms) {
  const Variables variables{{q, "v"}, {input}};
  Equation second;
  for (const auto& [term, coefficient] : terms)
    second.push_back({Term::parse(term, variables), coefficient});
  return with_free_coefficients(
      {{{q, ""}, {"v", ""}}, {{input, ""}}, {{{Term::parse("v", variables), 1.0}}, second}},
      {true, false});
}

TEST(RefinedRecords, PositioningSystemWithinThreePercent) {
  const Dataset record = measured("emps/emps_train.csv.gz", {.states = {"q"}, .inputs = {"F"}});
  if (record.trajectories.empty()) GTEST_SKIP() << "LACUNA_DATA is not set";
  const Refinement result =
      refine(second_order("q", "F", {{"F", 0.01}, {"v", -1.0}, {"sign(v)", -0.1}, {"1", 0.0}}),
             record);
  const Vector values = result.model.values();
  const double mass = 1.0 / values[0];
  EXPECT_NEAR(mass / 95.11, 1.0, 0.03);
  EXPECT_NEAR(-values[1] * mass / 203.5, 1.0, 0.03);
  EXPECT_NEAR(-values[2] * mass / 20.39, 1.0, 0.03);
  EXPECT_NEAR(-values[3] * mass / -3.16, 1.0, 0.03);
  EXPECT_FALSE(result.fits_to_noise);  // friction is more than these two numbers
}

Dataset rows(const Dataset& data, Index first, Index count) {
  Dataset part = data;
  const Trajectory& run = data.trajectories[0];
  part.trajectories = {{run.source, run.time.segment(first, count),
                        run.states.middleRows(first, count),
                        run.inputs.middleRows(first, count), Matrix()}};
  return part;
}

/// Root mean square error of a free simulation, its start being fitted to 50 samples.
double simulation_error(const OdeModel& model, const Dataset& record) {
  constexpr Index kStart = 50;
  const Refinement start =
      refine(ParametrisedModel(model, {}), rows(record, 0, kStart), {.window_samples = kStart});
  const Trajectory& run = record.trajectories[0];
  RecordInput input(run);
  const Solution orbit = simulate(model, Dopri8{}, start.states.row(0), run.time, input);
  return std::sqrt(
      (orbit.states.col(0) - run.states.col(0)).tail(run.samples() - kStart).squaredNorm() /
      static_cast<double>(run.samples() - kStart));
}

TEST(RefinedRecords, ElectronicOscillatorSimulatesToHalfAMillivolt) {
  const Dataset record =
      measured("silverbox/silverbox_snls80mv.csv.gz", {.states = {"y"}, .inputs = {"u"}});
  if (record.trajectories.empty()) GTEST_SKIP() << "LACUNA_DATA is not set";
  const ParametrisedModel start = second_order(
      "y", "u",
      {{"u", 1.5e5}, {"v", -50.0}, {"y", -1.7e5}, {"1", 0.0}, {"y^2", 0.0}, {"y^3", 0.0}});
  const OdeModel model = refine(start, rows(record, 40650, 65062)).model.model();
  EXPECT_LT(simulation_error(model, rows(record, 105712, 21688)), 0.47e-3);
  EXPECT_LT(simulation_error(model, rows(record, 100, 40475)), 0.55e-3);
}

}  // namespace
}  // namespace lacuna
