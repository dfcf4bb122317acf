// SPDX-License-Identifier: MIT
#include "lacuna/data/formats/read.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/joined_files.hpp"
#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

const std::string kRun = "t [s],x [V],y [V]\n0,1,2\n1,3,4\n2,5,6\n";

TEST(ReadTable, ReadsTextAndGzipAlike) {
  const TemporaryFolder folder;
  const Table plain = read_table(folder.write("a.csv", kRun));
  const Table packed =
      read_table(folder.write("a.csv.gz", gzip(kRun.substr(0, 20)) + gzip(kRun.substr(20))));
  EXPECT_EQ(plain.values, packed.values);
  EXPECT_EQ(plain.columns, packed.columns);
  EXPECT_EQ(plain.source, folder.file("a.csv"));
}

TEST(ReadTable, ReadsNpyByItsEnding) {
  const TemporaryFolder folder;
  const Matrix values = Matrix::Random(5, 3);
  write_npy(folder.file("a.npy"), values);
  EXPECT_EQ(read_table(folder.file("a.npy")).values, values);
  const std::string path = folder.write("b.npy.gz", gzip(folder.read("a.npy")));
  EXPECT_EQ(read_table(path).values, values);
}

TEST(ReadTable, NamesFilesItCannotRead) {
  const TemporaryFolder folder;
  const std::string matlab = folder.write("a.mat", "MATLAB 5.0 MAT-file, made by hand");
  expect_error<DataError>([&] { read_table(matlab); }, matlab, "MATLAB file", ".csv");
  const std::string hdf = folder.write("a.h5", "\x89HDF\r\n\x1a\n");
  expect_error<DataError>([&] { read_table(hdf); }, hdf, "HDF5 file", ".csv");
  const std::string tdms = folder.write("a.tdms", "TDSm1234");
  expect_error<DataError>([&] { read_table(tdms); }, tdms, "LabVIEW TDMS file", "nptdms");
  expect_error<FileError>([&] { read_table(folder.file("b.csv")); }, folder.file("b.csv"),
                          "cannot be read", "check the name");
  const std::string empty = folder.write("empty.csv", "");
  expect_error<DataError>([&] { read_table(empty); }, empty, "the file is empty", "header");
}

TEST(ReadDataset, JoinsFilesAndPatternsInOrder) {
  const TemporaryFolder folder;
  folder.write("run2.csv", kRun);
  folder.write("run1.csv", kRun);
  folder.write("other.csv", kRun);
  const Dataset data = read_dataset({folder.file("other.csv"), folder.file("run*.csv")});
  ASSERT_EQ(data.trajectories.size(), 3u);
  EXPECT_EQ(data.trajectories[0].source, folder.file("other.csv"));
  EXPECT_EQ(data.trajectories[1].source, folder.file("run1.csv"));
  EXPECT_EQ(data.trajectories[2].source, folder.file("run2.csv"));
  EXPECT_EQ(data.samples(), 9);
}

TEST(ReadDataset, AFileMayBeNamedLikeAPattern) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_dataset({folder.write("run[1].csv", kRun)}).samples(), 3);
}

TEST(ReadDataset, ColumnsMayStandInAnotherOrder) {
  const TemporaryFolder folder;
  const Dataset data =
      read_dataset({folder.write("a.csv", kRun),
                    folder.write("b.csv", "y [V],x [V],t [s]\n2,1,0\n4,3,1\n")});
  EXPECT_EQ(data.trajectories[1].states, data.trajectories[0].states.topRows(2));
  const Dataset other = read_dataset({folder.write("c.csv", "t,time,x\n0,5,1\n1,6,2\n"),
                                      folder.write("d.csv", "time,t,x\n5,0,1\n6,1,2\n")});
  EXPECT_EQ(other.trajectories[1].states, other.trajectories[0].states)
      << "the time is that of the first file";
}

TEST(ReadDataset, RefusesOtherColumns) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.csv", kRun);
  const std::string b = folder.write("b.csv", "t,x\n0,1\n1,2\n");
  const std::string c = folder.write("c.csv", "t [s],x [V],y [K]\n0,1,2\n1,2,3\n");
  const std::string d = folder.write("d.csv", "t [ms],x [V],y [V]\n0,1,2\n1,2,3\n");
  expect_error<DataError>(
      [&] {
        read_dataset({a, b});
      },
      b, "its columns (t, x) are not those of " + a + " (t, x, y)", "same columns");
  expect_error<DataError>(
      [&] {
        read_dataset({a, c});
      },
      c, "the unit of 'y' is K, in " + a, "same unit");
  expect_error<DataError>(
      [&] {
        read_dataset({a, d});
      },
      d, "the unit of 'time' is ms", "same unit");
}

TEST(ReadDataset, UnitsComeToThoseOfTheFirstFile) {
  const TemporaryFolder folder;
  const Dataset data = read_dataset({folder.write("a.csv", "t [s],y [V]\n0,1\n1,2\n"),
                                     folder.write("b.csv", "t [s],y [mV]\n0,1500\n1,2500\n")});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.trajectories[1].states(0, 0), 1.5);
}

TEST(ReadDataset, RefusesAPatternWithoutFiles) {
  expect_error<DataError>([] { read_dataset({"/nowhere/run*.csv"}); }, "/nowhere/run*.csv",
                          "no file matches", "check the folder");
  expect_error<DataError>([] { read_dataset({}); }, "data", "no file", "at least one");
}

TEST(ReadDataset, KeepsTheNotesOfEveryFile) {
  const TemporaryFolder folder;
  const std::string gap = "t [s],x [V],y [V]\n0,1,2\n1,3,4\n2,,6\n3,1,1\n4,1,1\n";
  const Dataset data = read_dataset({folder.write("a.csv", gap), folder.write("b.csv", gap)});
  ASSERT_EQ(data.notes.size(), 2u);
  EXPECT_THAT(data.notes[1], HasSubstr("b.csv:4:2: value of 'x' missing"));
  EXPECT_EQ(data.trajectories.size(), 4u);
}

TEST(ReadDataset, ReadsMeasuredRecords) {
  const char* folder = std::getenv("LACUNA_DATA");
  if (folder == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const std::string base = folder;
  const Dataset emps = read_dataset({base + "/emps/emps_train.csv.gz"},
                                    {.time = "t", .states = {"q"}, .inputs = {"F"}});
  EXPECT_EQ(emps.samples(), 24841);
  EXPECT_EQ(emps.inputs, (std::vector<Quantity>{{"F", "N"}}));
  EXPECT_EQ(emps.trajectories.size(), 1u);
  const Dataset silverbox = read_dataset({base + "/silverbox/silverbox_snls80mv.csv.gz"});
  EXPECT_EQ(silverbox.samples(), 131072);
  const Dataset chaos =
      read_dataset({base + "/chaos70/train/Lorenz.csv.gz"}, {.trajectory = "trajectory"});
  EXPECT_EQ(chaos.trajectories.size(), 5u);
}

/// Rates of a cycle beside its states.
std::string states_and_rates() {
  std::string text = "t,x,y,dx/dt,dy/dt\n";
  for (int i = 0; i < 200; ++i) {
    const double t = 0.1 * i, x = std::cos(t), y = 1.0 + std::sin(t) * std::cos(t);
    for (const double value : {t, x, y, -std::sin(t)}) text += format_number(value) + ",";
    text += format_number(std::cos(2.0 * t)) + "\n";
  }
  return text;
}

TEST(ReadDataset, DerivativesOfOtherColumnsAreNoStates) {
  const TemporaryFolder folder;
  const std::vector<std::string> files{folder.write("a.csv", states_and_rates()),
                                       folder.write("b.csv", states_and_rates())};
  const Dataset data = read_dataset(files);
  EXPECT_EQ(names_of(data.states), (std::vector<std::string>{"x", "y"}));
  EXPECT_THAT(data.notes.back(), HasSubstr("--states x,y,dx_dt,dy_dt"));
  const ColumnRoles all{.states = {"x", "y", "dx_dt", "dy_dt"}};
  EXPECT_EQ(read_dataset(files, all).state_count(), 4);
  const ColumnRoles given{.derivatives = {"dx_dt", "dy_dt"}};
  EXPECT_TRUE(read_dataset(files, given).has_derivatives());
  const Dataset of_tables = dataset_of_tables({read_table(files[0]), read_table(files[1])});
  EXPECT_EQ(of_tables.states, data.states);
}

TEST(DatasetOfTables, IsThatOfFilesWithTheSameColumns) {
  const TemporaryFolder folder;
  const std::vector<std::string> paths{
      folder.write("a.csv", kRun), folder.write("b.csv", "y [V],t [s],x [V]\n1,0,2\n3,1,4\n")};
  const ColumnRoles roles{.inputs = {"y"}, .names = {{"q", "x"}}};
  const Dataset files = read_dataset(paths, roles);
  const Dataset tables = dataset_of_tables({read_table(paths[0]), read_table(paths[1])}, roles);
  EXPECT_EQ(tables.states, files.states);
  EXPECT_EQ(tables.states.at(0).name, "q");
  EXPECT_EQ(tables.inputs, files.inputs);
  ASSERT_EQ(tables.trajectories.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(tables.trajectories[i].states, files.trajectories[i].states);
    EXPECT_EQ(tables.trajectories[i].source, files.trajectories[i].source);
  }
}

TEST(DatasetOfTables, NeedsOneAndTheSameColumns) {
  expect_error<DataError>([] { dataset_of_tables({}); }, "data", "no record", "at least one");
  const TemporaryFolder folder;
  const Table a = read_table(folder.write("a.csv", kRun));
  const Table b = read_table(folder.write("b.csv", "t,x\n0,1\n1,2\n"));
  EXPECT_THROW(dataset_of_tables({a, b}), DataError);
  Table nameless = a;
  nameless.columns.pop_back();
  expect_error<DataError>([&] { dataset_of_tables({nameless}); }, a.source, "2 names for 3",
                          "one name for each");
}

TEST(JoinedFiles, ANameThatHoldsASignIsThatFile) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a", ""), c = folder.write("c.csv", "");
  folder.write("b.csv", "");
  const std::string both = folder.write("a+b.csv", "");
  EXPECT_THAT(joined_files(both), ElementsAre(both));
  EXPECT_THAT(joined_files(both + "+" + c), ElementsAre(both, c));
  EXPECT_THAT(joined_files(folder.file("no+thing.csv")),
              ElementsAre(folder.file("no+thing.csv")));
}

TEST(JoinedFiles, PatternsAndSheetsAreParts) {
  const TemporaryFolder folder;
  const std::string book = folder.write("book.xlsx", ""), b = folder.write("b.csv", "");
  folder.write("run_1.csv", "");
  EXPECT_THAT(joined_files(folder.file("run_*.csv") + "+" + b),
              ElementsAre(folder.file("run_1.csv"), b));
  EXPECT_THAT(joined_files(book + "#A+" + b), ElementsAre(book + "#A", b));
  EXPECT_THAT(joined_files(b + "+" + book + "#A+B"), ElementsAre(b, book + "#A+B"));
  EXPECT_THAT(joined_files(book + "#A+B"), ElementsAre(book + "#A+B"));
  folder.write("run_2.csv", "");
  testing::expect_error<DataError>([&] { joined_files(b + "+" + folder.file("run_*.csv")); },
                                   folder.file("run_*.csv"), "matches 2 files", "join one");
}

TEST(JoinedFiles, AMisspeltOneIsSaid) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.csv", "t,x\n0,1\n1,2\n");
  testing::expect_error<FileError>([&] { read_table(a + "+" + folder.file("b.csv")); },
                                   folder.file("b.csv"), "cannot be read", "");
}

}  // namespace
}  // namespace lacuna
