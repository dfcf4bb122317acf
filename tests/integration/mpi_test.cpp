// SPDX-License-Identifier: MIT
// The command on several processes, where there is an MPI.
#include <gmock/gmock.h>

#include <fstream>

#include "integration/program.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using testing::run_program;
using testing::run_program_well;
using testing::TemporaryFolder;

// Open MPI itself leaves memory when it ends; what lacuna leaves is seen without it. Processes
// of one machine share memory: Open MPI's sockets take their locks in two orders.
const std::string kJob =
    "ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "timeout 100 mpirun --oversubscribe --bind-to none --mca btl self,vader -n ";

/// Whether lacuna-mpi was built, which is optional, and jobs can be started here;
/// scripts/setup.sh installs what that takes.
bool has_mpi() {
  return std::string(LACUNA_MPI_COMMAND) != "" && testing::can_run(kJob + "1 true");
}

std::string job(int processes, const std::string& arguments) {
  return kJob + std::to_string(processes) + " " LACUNA_MPI_COMMAND " " + arguments;
}

std::string long_file(const TemporaryFolder& folder) {
  const Dataset data = testing::long_oscillation(400000, 97.3, 0.001);
  return testing::write_rows(folder.file("a.npy"), testing::table_of(data)) +
         " --map t=1,x=2,v=3 --degree 1 --memory 16MB";
}

TEST(Mpi, ResultsAreThoseOfOneProcessToTheBit) {
  if (!has_mpi()) GTEST_SKIP() << "there is no MPI";
  const TemporaryFolder folder;
  const std::string arguments = "identify " + long_file(folder) + " --json ";
  run_program_well(arguments + folder.file("one.json"));
  for (const int processes : {1, 3}) {
    ASSERT_TRUE(testing::can_run(job(processes, arguments + folder.file("many.json"))));
    EXPECT_EQ(folder.read("many.json"), folder.read("one.json")) << processes;
  }
}

TEST(Mpi, TextIsReadInPiecesByEachProcess) {
  if (!has_mpi()) GTEST_SKIP() << "there is no MPI";
  const TemporaryFolder folder;
  const Matrix values = testing::table_of(testing::long_oscillation(150000, 97.3, 0.001));
  std::ofstream file(folder.file("a.csv"));
  file.precision(17);
  for (Index row = 0; row < values.rows(); ++row)
    file << values(row, 0) << ',' << values(row, 1) << ',' << values(row, 2) << '\n';
  file.close();
  const std::string arguments = "identify " + folder.file("a.csv") +
                                " --map t=1,x=2,v=3 --degree 1 --memory 16MB --json ";
  run_program_well(arguments + folder.file("one.json"));
  ASSERT_TRUE(testing::can_run(job(2, arguments + folder.file("many.json"))));
  EXPECT_EQ(folder.read("many.json"), folder.read("one.json"));
}

TEST(Mpi, AFleetOfRecordsIsDivided) {
  if (!has_mpi()) GTEST_SKIP() << "there is no MPI";
  const TemporaryFolder folder;
  folder.write("m.ode", "dx/dt = -x\n");
  for (const char* name : {"1.csv", "2.csv", "3.csv"}) {
    std::string text = "t,x\n";
    for (int i = 0; i < 300; ++i)
      text += std::to_string(0.01 * i) + "," + std::to_string(std::exp(-0.01 * i)) + "\n";
    folder.write(name, text);
  }
  const std::string arguments = "diagnose --each --model " + folder.file("m.ode") + " '" +
                                folder.file("?.csv") + "' --json ";
  run_program_well(arguments + folder.file("one.json"));
  ASSERT_TRUE(testing::can_run(job(2, arguments + folder.file("two.json"))));
  EXPECT_EQ(folder.read("two.json"), folder.read("one.json"));
}

TEST(Mpi, AnErrorIsSaidOnce) {
  if (!has_mpi()) GTEST_SKIP() << "there is no MPI";
  const TemporaryFolder folder;
  const std::string call = job(3, "identify " + folder.file("none.npy")) + " 2> " +
                           folder.file("err") + " > " + folder.file("out");
  EXPECT_NE(std::system(call.c_str()), 0);
  const std::string errors = folder.read("err");
  const std::size_t first = errors.find("lacuna: error: ");
  ASSERT_NE(first, std::string::npos) << errors;
  EXPECT_EQ(errors.find("lacuna: error: ", first + 1), std::string::npos) << errors;
  EXPECT_EQ(folder.read("out"), "");
}

TEST(Mpi, AKilledProcessEndsTheJobAndLeavesNothing) {
  if (!has_mpi()) GTEST_SKIP() << "there is no MPI";
  const TemporaryFolder folder;
  const std::string arguments =
      "identify " + long_file(folder) + " --json " + folder.file("result.json");
  const std::string members = folder.write(
      "run.sh",
      "[ \"$OMPI_COMM_WORLD_RANK\" = 1 ] && kill -9 $$\nexec " LACUNA_MPI_COMMAND " \"$@\"\n");
  const std::string call = kJob + "3 sh " + members + " " + arguments + " 2> " +
                           folder.file("err") + " > " + folder.file("out");
  EXPECT_NE(std::system(call.c_str()), 0);
  EXPECT_NE(folder.read("err"), "");
  EXPECT_FALSE(std::filesystem::exists(folder.file("result.json")));
}

}  // namespace
}  // namespace lacuna
