// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/spice_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/files/atomic_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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
