// SPDX-License-Identifier: MIT
#include "lacuna/data/formats/write.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/files/file_bytes.hpp"
#include "data/formats/read_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/one_record.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

Trajectory random_record(Index samples) {
  Trajectory record;
  record.time = Vector::LinSpaced(samples, 0.1, 0.1 * static_cast<double>(samples));
  record.states = Matrix::Random(samples, 2) * 1e-7;
  record.inputs = Matrix::Random(samples, 1) * 1e9;
  record.derivatives = Matrix::Random(samples, 2);
  return record;
}

Dataset sample(std::size_t records) {
  Dataset data;
  data.time_unit = "ms";
  data.states = {{"th", "rad"}, {"w", "rad/s"}};
  data.inputs = {{"u", ""}};
  for (std::size_t i = 0; i < records; ++i) data.trajectories.push_back(random_record(40));
  return data;
}

void expect_same(const Dataset& a, const Dataset& b) {
  EXPECT_EQ(a.time_unit, b.time_unit);
  EXPECT_EQ(a.states, b.states);
  EXPECT_EQ(a.inputs, b.inputs);
  ASSERT_EQ(a.trajectories.size(), b.trajectories.size());
  for (std::size_t i = 0; i < a.trajectories.size(); ++i) {
    EXPECT_EQ(a.trajectories[i].time, b.trajectories[i].time);
    EXPECT_EQ(a.trajectories[i].states, b.trajectories[i].states);
    EXPECT_EQ(a.trajectories[i].inputs, b.trajectories[i].inputs);
    EXPECT_EQ(a.trajectories[i].derivatives, b.trajectories[i].derivatives);
  }
}

TEST(FormatCsv, WritesNamesUnitsAndShortestNumbers) {
  Trajectory record;
  record.time = (Vector(2) << 0.0, 0.1).finished();
  record.states = (Vector(2) << 1.5, 1.0 / 3.0).finished();
  Dataset data = support::one_record({{"x", "V"}}, {}, record);
  EXPECT_EQ(format_csv(data, "made by hand\nseed 1"),
            "# made by hand\n# seed 1\nt [s],x [V]\n0,1.5\n0.1,0.3333333333333333\n");
}

TEST(FormatCsv, NamesDerivativesAndKeepsNamesApart) {
  Dataset data = sample(1);
  data.inputs[0].name = "dw";
  EXPECT_EQ(format_csv(data).substr(0, 70).substr(0, format_csv(data).find('\n')),
            "t [ms],th [rad],w [rad/s],dw,dth [rad/ms],dw_ [(rad/s)/ms]");
}

TEST(WriteCsv, ReadsBackAsTheSameDataset) {
  const TemporaryFolder folder;
  const Dataset data = sample(1);
  write_csv(folder.file("a.csv"), data, "comment");
  expect_same(
      read_dataset({folder.file("a.csv")}, {.inputs = {"u"}, .derivatives = {"dth", "dw"}}),
      data);
}

TEST(WriteCsv, NumbersSeveralRecordsAndPacksByTheEnding) {
  const TemporaryFolder folder;
  const Dataset data = sample(3);
  write_csv(folder.file("a.csv.gz"), data);
  EXPECT_EQ(folder.read("a.csv.gz").substr(0, 2), "\x1f\x8b");
  expect_same(
      read_dataset({folder.file("a.csv.gz")},
                   {.inputs = {"u"}, .derivatives = {"dth", "dw"}, .trajectory = "trajectory"}),
      data);
}

TEST(WriteCsv, RefusesAFolderThatIsMissing) {
  EXPECT_THROW(write_csv("/nowhere/a.csv", sample(1)), FileError);
}

}  // namespace
}  // namespace lacuna
