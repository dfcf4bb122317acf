// SPDX-License-Identifier: MIT
// Records and models of circuits.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <zlib.h>

#include "core/files/atomic_file.hpp"
#include "dynamics/test_systems/rossler_circuit.hpp"
#include "dynamics/test_systems/shipped_record.hpp"
#include "dynamics/test_systems/spice_record.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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
  Dataset record;
  record.states = {{"x", "V"}};
  Trajectory run;
  run.source = "made";
  run.time.resize(800);
  for (Index i = 0; i < 800; ++i)
    run.time[i] =
        1e-3 * (0.01 * static_cast<double>(i) + 0.002 * std::sin(1.0 * static_cast<double>(i)));
  run.states = (run.time.array() * 1e3).sin().matrix();
  run.inputs.resize(800, 0);
  record.trajectories = {run};
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
