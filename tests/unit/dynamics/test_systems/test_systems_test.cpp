// SPDX-License-Identifier: MIT
// Test systems and circuits, and what is measured of them.
#include "lacuna/dynamics/test_systems/test_systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/files/atomic_file.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "dynamics/test_systems/rossler_circuit.hpp"
#include "dynamics/test_systems/shipped_record.hpp"
#include "dynamics/test_systems/spice_record.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/one_record.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

// Test systems and what is measured of them.
Matrix orbit(const std::string& name, double duration, double transient) {
  const TestSystem& system = test_system(name);
  const double h = system.step;
  const Solution solution = simulate(system.model, Dopri8({.substeps = 2}), system.start,
                                     sample_times(0.0, h, static_cast<Index>(duration / h)));
  EXPECT_EQ(solution.status, IntegrationStatus::Completed) << name << " " << solution.message;
  return solution.states.bottomRows(solution.states.rows() - static_cast<Index>(transient / h));
}

Vector extents(const Matrix& states) {
  return (states.colwise().maxCoeff() - states.colwise().minCoeff()).transpose();
}

void expect_extents(const std::string& name, const Vector& expected, double fraction) {
  const Vector found = extents(orbit(name, 1000.0, 100.0));
  for (Index k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], fraction * expected[k]) << name << ", state " << k;
}

TEST(TestSystems, AreOrderedAndComplete) {
  std::vector<std::string> names;
  for (const TestSystem& system : test_systems()) names.push_back(system.name);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(
      names, ::testing::IsSupersetOf({"rossler", "rossler-circuit", "rossler-adjusted", "tl072",
                                      "lorenz", "fitzhugh-nagumo", "chua", "duffing",
                                      "van-der-pol", "pendulum", "memristor"}));
}

TEST(TestSystems, AreDescribedWholly) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems()) {
    EXPECT_FALSE(system.summary.empty()) << system.name;
    EXPECT_FALSE(system.reference.empty()) << system.name;
    EXPECT_GT(system.step, 0.0) << system.name;
    EXPECT_EQ(system.start.size(), system.model.dimension()) << system.name;
  }
}

TEST(TestSystems, StayBounded) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems())
    EXPECT_LT(orbit(system.name, 300.0, 0.0).cwiseAbs().maxCoeff(), 60.0) << system.name;
}

TEST(TestSystems, AttractorsHaveTheirKnownExtents) {
  expect_extents("tl072", Vector{{4.260, 3.932, 3.912}}, 0.005);
  expect_extents("opa2134", Vector{{4.88, 4.43, 8.34}}, 0.01);
  expect_extents("rossler-adjusted", Vector{{5.17, 4.70, 7.58}}, 0.01);
  expect_extents("rossler", Vector{{20.5, 18.6, 22.8}}, 0.03);
  expect_extents("rossler-circuit", Vector{{20.5 / 4, 18.6 / 4, 22.8 / 4}}, 0.03);
  expect_extents("lorenz", Vector{{38.0, 51.5, 46.5}}, 0.05);
}

TEST(TestSystems, ChaoticOnesForgetTheirStart) {
  for (const char* name : {"chua", "duffing", "lorenz", "memristor", "rossler", "tl072"}) {
    const TestSystem& system = test_system(name);
    const Vector times =
        sample_times(0.0, system.step, static_cast<Index>(600.0 / system.step));
    Vector beside = system.start;
    beside[0] += 1e-7;
    const Solution a = simulate(system.model, Dopri8{}, system.start, times);
    const Solution b = simulate(system.model, Dopri8{}, beside, times);
    const Matrix distance = (a.states - b.states).cwiseAbs();
    EXPECT_GT(distance.maxCoeff(), 0.05 * extents(a.states).maxCoeff()) << name;
  }
}

TEST(TestSystems, ChuaVisitsBothScrolls) {
  const Matrix states = orbit("chua", 200.0, 20.0);
  EXPECT_GT(states.col(0).maxCoeff(), 1.5);
  EXPECT_LT(states.col(0).minCoeff(), -1.5);
}

TEST(TestSystems, OscillatorsReachTheirCycle) {
  EXPECT_NEAR(orbit("van-der-pol", 100.0, 50.0).col(0).maxCoeff(), 2.0086, 0.005);
  const Matrix spikes = orbit("fitzhugh-nagumo", 400.0, 200.0);
  EXPECT_GT(spikes.col(0).maxCoeff(), 1.5);
  EXPECT_LT(spikes.col(0).minCoeff(), -1.5);
}

TEST(TestSystems, PendulumComesToRest) {
  const Matrix states = orbit("pendulum", 100.0, 95.0);
  EXPECT_LT(states.cwiseAbs().maxCoeff(), 0.05);
}

TEST(TestSystems, CircuitTableIsWhole) {
  const OdeModel& model = test_system("tl072").model;
  const OdeModel& other = test_system("opa2134").model;
  for (const Equation& equation : model.equations()) EXPECT_EQ(equation.size(), 20u);
  for (const Equation& equation : other.equations()) EXPECT_EQ(equation.size(), 20u);
  EXPECT_EQ(other.coefficient(0, "1"), 0.023157);
  EXPECT_EQ(other.coefficient(2, "z^3"), 0.025367);
  EXPECT_EQ(model.coefficient(0, "1"), 0.019849);
  EXPECT_EQ(model.coefficient(2, "x*z"), 4.2853);
  EXPECT_EQ(model.coefficient(1, "z^3"), -4.1591e-05);
}

TEST(TestSystems, UnknownNameIsAnErrorWithTheNearest) {
  try {
    test_system("rosler");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("rossler"));
  }
}

Dataset lorenz_record(Index n) {
  const TestSystem& system = test_system("lorenz");
  return record_of(system.model, Dopri8{}, system.start, system.step, n);
}

TEST(RecordOf, BringsStatesAndDerivatives) {
  const Dataset record = lorenz_record(2000);
  ASSERT_NO_THROW(check_dataset(record));
  ASSERT_TRUE(record.has_derivatives());
  const Trajectory& run = record.trajectories[0];
  EXPECT_EQ(run.samples(), 2000);
  EXPECT_EQ(run.states(0, 2), 27.0);
  for (Index i = 0; i < 2000; i += 97) {
    const double x = run.states(i, 0), y = run.states(i, 1), z = run.states(i, 2);
    EXPECT_NEAR(run.derivatives(i, 0), 10.0 * (y - x), 1e-11);
    EXPECT_NEAR(run.derivatives(i, 2), x * y - 8.0 / 3.0 * z, 1e-11);
  }
}

TEST(RecordOf, DivergenceIsAnError) {
  const TestSystem& system = test_system("rossler");
  EXPECT_THROW(record_of(system.model, Rk4{}, Vector{{500.0, 0.0, 500.0}}, 0.5, 1000),
               ArgumentError);
}

TEST(AddNoise, HasTheGivenDeviationPerState) {
  const Dataset clean = lorenz_record(20000);
  const Dataset noisy = add_noise(clean, Vector{{0.1, 0.0, 2.0}}, 7);
  const Matrix noise = noisy.trajectories[0].states - clean.trajectories[0].states;
  EXPECT_NEAR(noise.col(0).norm() / std::sqrt(20000.0), 0.1, 0.002);
  EXPECT_EQ(noise.col(1).norm(), 0.0);
  EXPECT_NEAR(noise.col(2).norm() / std::sqrt(20000.0), 2.0, 0.04);
  EXPECT_NEAR(noise.col(2).mean(), 0.0, 0.06);
  EXPECT_FALSE(noisy.has_derivatives());
}

TEST(AddNoise, SeedDecides) {
  const Dataset clean = lorenz_record(100);
  const Vector sigma = Vector::Ones(3);
  const Matrix first = add_noise(clean, sigma, 1).trajectories[0].states;
  EXPECT_EQ(first, add_noise(clean, sigma, 1).trajectories[0].states);
  EXPECT_NE(first, add_noise(clean, sigma, 2).trajectories[0].states);
}

TEST(AddNoise, RelativeNoiseFollowsTheSpread) {
  const Dataset clean = lorenz_record(20000);
  const Matrix& states = clean.trajectories[0].states;
  const Matrix noise = add_relative_noise(clean, 0.01, 5).trajectories[0].states - states;
  for (Index k = 0; k < 3; ++k) {
    const double spread = (states.col(k).array() - states.col(k).mean()).matrix().norm();
    EXPECT_NEAR(noise.col(k).norm() / spread, 0.01, 0.0003);
  }
}

TEST(Quantise, GivesTheNearestLevel) {
  Dataset record;
  record.states = {{"x", "V"}};
  const Vector values{{0.0, 0.3, 0.874, -0.9, -1.2, 3.0}};
  record.trajectories = {{"", Vector::LinSpaced(6, 0.0, 5.0), values, Matrix(6, 0), Matrix()}};
  const Dataset digital = quantise(record, 3, 1.0);
  const Vector expected{{0.0, 0.25, 0.75, -1.0, -1.0, 0.75}};
  EXPECT_EQ(digital.trajectories[0].states, Matrix(expected));
}

TEST(Quantise, ErrorIsAtMostHalfALevel) {
  const Dataset clean = lorenz_record(1000);
  const Matrix digital = quantise(clean, 16, 64.0).trajectories[0].states;
  EXPECT_LE((digital - clean.trajectories[0].states).cwiseAbs().maxCoeff(), 64.0 / 65536.0);
}

// Records and models of circuits.
TEST(RosslerCircuit, IdealPartsGiveTheOriginalSystem) {
  const OdeModel circuit = rossler_circuit({.r4 = 50.0});
  const OdeModel& original = test_system("rossler-circuit").model;
  for (Index k = 0; k < 3; ++k)
    for (const char* term : {"1", "x", "y", "z", "x*z"})
      EXPECT_NEAR(circuit.coefficient(k, term), original.coefficient(k, term), 1e-14)
          << "equation " << k << ", term " << term;
}

TEST(RosslerCircuit, MeasuredPartsGiveTheAdjustedSystem) {
  const OdeModel circuit = rossler_circuit(RosslerComponents::measured());
  EXPECT_NEAR(circuit.coefficient(0, "y"), -100.0 / (9.60 * 10.1), 1e-12);
  EXPECT_NEAR(circuit.coefficient(0, "z"), -100.0 / (9.38 * 10.1), 1e-12);
  EXPECT_NEAR(circuit.coefficient(1, "x"), 100.0 / 96.4, 1e-12);
  EXPECT_NEAR(circuit.coefficient(1, "y"), 100.0 / 415.0, 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "1"), 0.2 * 100.0 / (38.2 * 9.9), 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "x*z"), 100.0 / (9.9 * 9.9) * 9.99 / 2.21, 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "z"), -100.0 / (9.9 * 9.9) * 9.99 * 5.7 / 9.12, 1e-12);
}

const std::string kFile = LACUNA_SOURCE_DIR "/data/tl072_record.csv.gz";

std::string unpacked(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  std::string text;
  std::vector<char> part(65536);
  for (int count = 1; file && count > 0;) {
    count = gzread(file.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
  return text;
}

TEST(ShippedRecord, IsRemadeByteForByte) {
  const std::string made = format_csv(tl072_record(), tl072_record_comment());
  EXPECT_TRUE(made == unpacked(kFile)) << "remake it: make_tl072_record " << kFile;
}

TEST(ShippedRecord, IsWhatItSays) {
  const Dataset record = tl072_record();
  const Trajectory& run = record.trajectories[0];
  EXPECT_EQ(run.samples(), 10000);
  EXPECT_NEAR(*uniform_step(run), 0.1, 1e-12);
  const Matrix levels = run.states * (65536.0 / 20.0);
  EXPECT_EQ(levels, Matrix(levels.array().round()));
  const auto extent = run.states.colwise().maxCoeff() - run.states.colwise().minCoeff();
  EXPECT_NEAR(extent[0], 4.260, 0.02);
  EXPECT_NEAR(extent[1], 3.932, 0.02);
  EXPECT_NEAR(extent[2], 3.912, 0.04);
}

// Differences of order 6 remove the signal; what is left is the noise, 1 mV and a level's own.
TEST(ShippedRecord, HasTheNoiseItSays) {
  const Vector x = tl072_record().trajectories[0].states.col(0);
  const Index n = x.size() - 6;
  const Vector difference = x.segment(0, n) - 6.0 * x.segment(1, n) + 15.0 * x.segment(2, n) -
                            20.0 * x.segment(3, n) + 15.0 * x.segment(4, n) -
                            6.0 * x.segment(5, n) + x.segment(6, n);
  Vector magnitude = difference.cwiseAbs() / std::sqrt(924.0);
  std::sort(magnitude.begin(), magnitude.end());
  EXPECT_NEAR(magnitude[n / 2] / 0.6745, 1e-3, 1e-4);
}

const std::string kHead =
    "Title: a circuit\nPlotname: Transient Analysis\nFlags: real\nNo. Variables: 3\n"
    "No. Points: 3\nVariables:\n\t0\ttime\ttime\n\t1\tv(x)\tvoltage\n"
    "\t2\tv(out)\tvoltage\n";

Dataset read(const std::string& text) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "out.raw", text);
  return read_spice_output(folder.path() / "out.raw");
}

TEST(SpiceOutput, IsARecordOfItsNodes) {
  const Dataset record = read(kHead +
                              "Values:\n 0\t0.0e+00\n\t1.5e+00\n\t-2.0e+00\n\n"
                              " 1\t1.0e-06\n\t1.6e+00\n\t-2.1e+00\n\n"
                              " 2\t3.0e-06\n\t1.7e+00\n\t-2.2e+00\n\n");
  ASSERT_EQ(record.state_count(), 2);
  EXPECT_EQ(record.states[0], (Quantity{"x", "V"}));
  EXPECT_EQ(record.states[1].name, "out");
  EXPECT_EQ(record.trajectories[0].time, (Vector{{0.0, 1e-6, 3e-6}}));
  EXPECT_EQ(record.trajectories[0].states, (Matrix{{1.5, -2.0}, {1.6, -2.1}, {1.7, -2.2}}));
}

TEST(SpiceOutput, OtherFilesAreRefused) {
  EXPECT_THROW(read("t,x\n0,1\n"), DataError);
  EXPECT_THROW(read(kHead + "Binary:\n\x01\x02"), DataError);
  EXPECT_THROW(read(kHead + "Values:\n"), DataError);
  EXPECT_THROW(read_spice_output("/nowhere/out.raw"), FileError);
}

Dataset uneven_sine() {
  Trajectory run;
  run.source = "made";
  run.time.resize(800);
  for (Index i = 0; i < 800; ++i)
    run.time[i] =
        1e-3 * (0.01 * static_cast<double>(i) + 0.002 * std::sin(1.0 * static_cast<double>(i)));
  run.states = (run.time.array() * 1e3).sin().matrix();
  Dataset record = support::one_record({{"x", "V"}}, {}, run);
  return record;
}

TEST(Resampled, IsTheSignalOnAUniformGrid) {
  const Dataset grid = resampled(uneven_sine(), 1e-3, 1e-3, 0.1, 60);
  const Trajectory& run = grid.trajectories[0];
  EXPECT_EQ(run.samples(), 60);
  EXPECT_NEAR(run.time[59], 5.9, 1e-12);
  for (Index i = 0; i < 60; ++i)
    EXPECT_NEAR(run.states(i, 0), std::sin(1.0 + run.time[i]), 1e-12) << i;
}

}  // namespace
}  // namespace lacuna
