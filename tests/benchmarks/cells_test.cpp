// SPDX-License-Identifier: MIT
#include "support/cells.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "lacuna/core/base/error.hpp"
#include "support/environment.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::benchmarks {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::Environment;
using testing::expect_error;
using testing::TemporaryFolder;

/// What a cell of the study gives.
struct Row {
  double value = 0.0;
  std::string text;

  auto fields() { return std::tie(value, text); }
};

/// A study that counts how many cells it has computed.
struct Counted {
  std::atomic<int> computed = 0;
  std::size_t ends_at = 1000;  ///< the cell at which it ends by an exception

  Cells<Row> cells(Pace pace = Pace::AllCores) {
    Cells<Row> cells(pace);
    for (std::size_t k = 0; k < 7; ++k)
      cells.add("case " + std::to_string(k) + "/a", [this, k] {
        if (k == ends_at) throw std::runtime_error("ended");
        ++computed;
        return Row{1.0 / (1.0 + static_cast<double>(k)), "row"};
      });
    return cells;
  }
};

CellStore store_in(const TemporaryFolder& folder, Share share = {}) {
  return {"some", "preset a", folder.path(), share};
}

/// The table of a study, with all that it says of its making.
std::string table_of(const Finished<Row>& finished) {
  std::string text = finished.origin.machine + finished.origin.day;
  for (const Row& row : finished.values) text += row.text + std::to_string(row.value) + "\n";
  return text;
}

std::string uninterrupted() {
  Counted study;
  return table_of(*run_cells({"some", "preset a"}, study.cells()));
}

std::vector<fs::path> files_in(const TemporaryFolder& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.path() / "some"))
    files.push_back(entry.path());
  return files;
}

TEST(Cells, AreComputedOnceAndReadAfterwards) {
  const TemporaryFolder folder;
  Counted first, second;
  const auto before = run_cells(store_in(folder), first.cells());
  const auto after = run_cells(store_in(folder), second.cells());
  EXPECT_EQ(first.computed, 7);
  EXPECT_EQ(second.computed, 0);
  EXPECT_EQ(table_of(*before), uninterrupted());
  EXPECT_EQ(table_of(*after), uninterrupted());
  EXPECT_EQ(after->seconds, before->seconds);
  EXPECT_EQ(after->origin.seconds, before->origin.seconds);
}

TEST(Cells, StandInGroups) {
  Cells<double> cells;
  cells.add_draws("first", 2, [](std::size_t draw) { return static_cast<double>(draw); });
  cells.begin_group("none");
  cells.begin_group("last");
  cells.add("a", [] { return 0.5; });
  EXPECT_THAT(cells.names(), ElementsAre("first 1", "first 2", "last a"));
  const auto finished = run_cells({"some", ""}, cells);
  EXPECT_THAT(finished->group(0), ElementsAre(1.0, 2.0));
  EXPECT_THAT(finished->group(1), ElementsAre());
  EXPECT_THAT(finished->group(2), ElementsAre(0.5));
  EXPECT_EQ(finished->seconds_of_group(0), finished->seconds[0] + finished->seconds[1]);
}

TEST(Cells, GoOnWhereAStudyHasEnded) {
  const TemporaryFolder folder;
  Counted first, second;
  first.ends_at = 4;
  EXPECT_THROW(run_cells(store_in(folder), first.cells(Pace::OneByOne)), std::runtime_error);
  const auto finished = run_cells(store_in(folder), second.cells());
  EXPECT_EQ(first.computed, 4);
  EXPECT_EQ(second.computed, 3);
  EXPECT_EQ(table_of(*finished), uninterrupted());
}

TEST(Cells, OfProcessesAreSharedAndWhoeverFinishesLastHasAll) {
  const TemporaryFolder folder;
  Counted first, second;
  EXPECT_FALSE(run_cells(store_in(folder, {0, 2}), first.cells()).has_value());
  const auto finished = run_cells(store_in(folder, {1, 2}), second.cells());
  EXPECT_EQ(first.computed, 4);
  EXPECT_EQ(second.computed, 3);
  EXPECT_EQ(table_of(*finished), uninterrupted());
  Counted again;
  EXPECT_EQ(table_of(*run_cells(store_in(folder, {0, 2}), again.cells())), uninterrupted());
  EXPECT_EQ(again.computed, 0);
}

TEST(Cells, OfOtherSettingsOrStudiesAreOthers) {
  const TemporaryFolder folder;
  Counted first, other_settings, other_study;
  run_cells(store_in(folder), first.cells());
  CellStore store = store_in(folder);
  store.settings = "preset b";
  run_cells(store, other_settings.cells());
  store.study = "other";
  run_cells(store, other_study.cells());
  EXPECT_EQ(other_settings.computed, 7);
  EXPECT_EQ(other_study.computed, 7);
  EXPECT_EQ(files_in(folder).size(), 14u);
}

TEST(Cells, ThatAreHalfWrittenAreComputedAgain) {
  const TemporaryFolder folder;
  Counted first, second, third;
  run_cells(store_in(folder), first.cells());
  const std::vector<fs::path> files = files_in(folder);
  fs::resize_file(files[0], fs::file_size(files[0]) / 2);
  fs::resize_file(files[1], 0);
  folder.write("some/case_1_a-0.json.01234567.tmp", "{");
  EXPECT_EQ(table_of(*run_cells(store_in(folder), second.cells())), uninterrupted());
  EXPECT_EQ(second.computed, 2);
  run_cells(store_in(folder), third.cells());
  EXPECT_EQ(third.computed, 0);
}

TEST(Cells, ThatAreForeignAreAnError) {
  const TemporaryFolder folder;
  Counted first, second;
  run_cells(store_in(folder), first.cells());
  const std::vector<fs::path> files = files_in(folder);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  expect_error<DataError>([&] { run_cells(store_in(folder), second.cells()); },
                          files[1].string(), "is not the cell 'case", "remove the file");
  folder.write("some/" + files[1].filename().string(), "[1, 2]");
  expect_error<DataError>([&] { run_cells(store_in(folder), second.cells()); },
                          files[1].string(), "is not the cell 'case", "remove the file");
}

TEST(Cells, OfSeveralProcessesNeedAFolder) {
  Counted study;
  expect_error<ConfigError>(
      [&] {
        run_cells({"some", "", {}, {0, 2}}, study.cells());
      },
      "study_some", "2 processes have no folder", "--cells FOLDER");
  EXPECT_EQ(study.computed, 0);
}

TEST(ShareOfLauncher, IsReadFromEachLauncher) {
  for (const auto& [rank, size] : {std::pair{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                   {"PMI_RANK", "PMI_SIZE"},
                                   {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}}) {
    const Environment environment({{rank, "2"}, {size, "5"}});
    EXPECT_EQ(share_of_launcher().rank, 2) << rank;
    EXPECT_EQ(share_of_launcher().size, 5) << size;
  }
}

TEST(ShareOfLauncher, IsAllInABatchScript) {
  const Environment environment({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "64"}});
  EXPECT_EQ(share_of_launcher().size, 1);
}

TEST(ShareOfLauncher, RefusesWhatIsNoRankAndSize) {
  {
    const Environment environment({{"PMI_RANK", "one"}, {"PMI_SIZE", "2"}});
    expect_error<ConfigError>(share_of_launcher, "PMI_RANK", "'one'", "mpirun or srun");
  }
  const Environment environment({{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}});
  expect_error<ConfigError>(share_of_launcher, "PMI_RANK", "not below PMI_SIZE", "unset");
}

TEST(ShareOfLauncher, TwoProcessesOfAJobMakeTheTableOfOne) {
  const TemporaryFolder folder;
  std::string table;
  for (const char* rank : {"1", "0"}) {
    const Environment environment(
        {{"OMPI_COMM_WORLD_RANK", rank}, {"OMPI_COMM_WORLD_SIZE", "2"}});
    Counted study;
    const auto finished = run_cells(store_in(folder, share_of_launcher()), study.cells());
    EXPECT_EQ(finished.has_value(), *rank == '0');
    if (finished) table = table_of(*finished);
  }
  EXPECT_EQ(table, uninterrupted());
}

}  // namespace
}  // namespace lacuna::benchmarks
