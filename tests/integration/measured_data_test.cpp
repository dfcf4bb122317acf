// SPDX-License-Identifier: MIT
// Real measurements; run where the environment variable LACUNA_DATA names their folder.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "integration/program.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "support/temporary_folder.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna::testing {
namespace {

/// The folder of the measurements; nothing where it is not known.
std::optional<std::string> measurements() {
  const char* folder = std::getenv("LACUNA_DATA");
  return folder == nullptr ? std::nullopt : std::optional<std::string>(folder);
}

/// Electro-mechanical positioning system: M q'' = F - Fv q' - Fc sign(q') - offset, published
/// as 95.11 kg, 203.5 N s/m, 20.39 N, -3.16 N (Janot, Gautier, Brunot 2019).
TEST(MeasuredData, EmpsParametersAreWithinThreePercentOfThePublishedOnes) {
  const auto folder = measurements();
  if (!folder) GTEST_SKIP() << "LACUNA_DATA is not set";
  const CommandResult result = run_program_well(
      "identify " + *folder + "/emps/emps_train.csv.gz --time t --states q --inputs F " +
      "--embed q=2 --terms 'sign(q_d1),1,F,q_d1' --json -");
  const auto json = nlohmann::json::parse(result.out);
  std::map<std::string, double> found;
  for (const auto& term : json["model"]["equations"][1]["terms"])
    found[term["term"].get<std::string>()] = term["coefficient"].get<double>();
  ASSERT_EQ(found.size(), 4u) << result.out;
  const double mass = 1.0 / found["F"];
  EXPECT_NEAR(mass, 95.11, 0.03 * 95.11);
  EXPECT_NEAR(-mass * found["q_d1"], 203.5, 0.03 * 203.5);
  EXPECT_NEAR(-mass * found["sign(q_d1)"], 20.39, 0.03 * 20.39);
  EXPECT_NEAR(-mass * found["1"], -3.16, 0.03 * 3.16);
}

/// Some samples of a record of u and y.
Dataset part(const Dataset& all, Index first, Index count) {
  Dataset data = all;
  const Trajectory& from = all.trajectories.front();
  data.trajectories = {{from.source, from.time.segment(first, count),
                        from.states.middleRows(first, count),
                        from.inputs.middleRows(first, count), Matrix()}};
  return data;
}

/// Root mean square of y minus its free simulation after 50 samples, to which its start is
/// fitted.
double simulation_error(const OdeModel& model, const Dataset& record) {
  constexpr Index kStart = 50;
  const Refinement start =
      refine(ParametrisedModel(model, {}), part(record, 0, kStart), {.window_samples = kStart});
  const Trajectory& run = record.trajectories.front();
  RecordInput input(run);
  const Solution orbit =
      simulate(DrivenModel{model, input}, Dopri8{}, start.states.row(0), run.time);
  EXPECT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  const Index n = run.samples() - kStart;
  return std::sqrt((orbit.states.col(0) - run.states.col(0)).tail(n).squaredNorm() /
                   static_cast<double>(n));
}

/// Electronic Duffing oscillator (Wigren, Schoukens 2013): an arrow up to sample 40 575, then
/// ten multisines, of which three quarters are for training and the last for testing.
TEST(MeasuredData, SilverboxIsSimulatedToHalfAMillivolt) {
  const auto folder = measurements();
  if (!folder) GTEST_SKIP() << "LACUNA_DATA is not set";
  ColumnRoles roles;
  roles.states = {"y"};
  roles.inputs = {"u"};
  const Dataset all = read_dataset({*folder + "/silverbox/silverbox_snls80mv.csv.gz"}, roles);
  const Dataset training =
      embed(part(all, 40650, 65062), {{"y", 2}}, FiniteDifferences{{.order = 10}});
  const OdeModel model = identify(training, algorithm1()).model;
  EXPECT_LE(model.equations()[1].size(), 7u) << to_text(model);
  EXPECT_LT(simulation_error(model, part(all, 105712, 21688)), 0.40e-3) << to_text(model);
  EXPECT_LT(simulation_error(model, part(all, 100, 40475)), 0.51e-3) << to_text(model);
}

/// A record of u and y as text.
std::string text_of(const Dataset& record) {
  const Trajectory& run = record.trajectories.front();
  std::ostringstream out;
  out << "t,u,y\n" << std::setprecision(12);
  for (Index i = 0; i < run.samples(); ++i)
    out << run.time[i] << ',' << run.inputs(i, 0) << ',' << run.states(i, 0) << '\n';
  return out.str();
}

/// The diagnosis of the linear resonator with the whole vocabulary, on the first samples of the
/// training part, compared with the first multisine of the test part.
nlohmann::json silverbox_diagnosis(const Dataset& all, Index samples,
                                   const std::string& nominal, const std::string& model_out) {
  const TemporaryFolder place;
  const std::string train = place.write("train.csv", text_of(part(all, 40650, samples)));
  const std::string test = place.write("test.csv", text_of(part(all, 105712, 8692)));
  const CommandResult run =
      run_program_well("diagnose --model " + nominal + " " + train + " --holdout " + test +
                       " --model-out " + model_out + " --json -");
  return nlohmann::json::parse(run.out);
}

/// A longer record of the same thing gives no other answer.
TEST(MeasuredData, SilverboxLacksCubicStiffnessAndNothingElseAtAnyLength) {
  const auto folder = measurements();
  if (!folder) GTEST_SKIP() << "LACUNA_DATA is not set";
  const Dataset all = read_dataset({*folder + "/silverbox/silverbox_snls80mv.csv.gz"},
                                   {.states = {"y"}, .inputs = {"u"}});
  const TemporaryFolder place;
  const std::string found = place.file("found.json");
  std::vector<double> stiffness;
  for (const Index samples : {8692, 30000}) {
    const auto json =
        silverbox_diagnosis(all, samples, *folder + "/silverbox/nominal.json", found);
    ASSERT_EQ(json["effects"].size(), 1u) << json["effects"];
    EXPECT_EQ(json["effects"][0]["name"], "cubic-stiffness");
    stiffness.push_back(json["effects"][0]["coefficient"].get<double>());
    const double after = json["gap"]["after"].get<double>();
    EXPECT_LT(json["gap"]["ratio"].get<double>(), 0.2);
    if (after > 1.5 * json["gap"]["noise_floor"].get<double>()) {
      EXPECT_NE(json["verdict"], "explained");
    }
    const OdeModel model = read_model(found);
    EXPECT_LE(simulation_error(model, part(all, 105712, 21688)), 0.39e-3) << to_text(model);
    EXPECT_LE(simulation_error(model, part(all, 100, 40475)), 0.49e-3) << to_text(model);
  }
  const auto [least, most] = std::minmax_element(stiffness.begin(), stiffness.end());
  EXPECT_GT(*most / *least, 0.97) << "negative: the least is the largest stiffness";
}

}  // namespace
}  // namespace lacuna::testing
