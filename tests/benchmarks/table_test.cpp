// SPDX-License-Identifier: MIT
#include "support/table.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace lacuna::benchmarks {
namespace {

using testing::TemporaryFolder;

const ResultTable kTable{{"system", "error"}, {{"Lorenz, chaotic", "0.1"}, {"SIR", "2"}}};

TEST(ResultTable, IsWrittenForPeopleAndForPrograms) {
  EXPECT_EQ(kTable.csv(), "system,error\n\"Lorenz, chaotic\",0.1\nSIR,2\n");
  EXPECT_EQ(kTable.markdown(),
            "| system | error |\n| --- | --- |\n| Lorenz, chaotic | 0.1 |\n| SIR | 2 |\n");
}

TEST(ResultTable, GoesIntoAFolderThatIsMade) {
  const TemporaryFolder folder;
  write_results(folder.path() / "a" / "b", "some", kTable.csv(), "# Some\n");
  EXPECT_EQ(folder.read("a/b/some.csv"), kTable.csv());
  EXPECT_EQ(folder.read("a/b/some.md"), "# Some\n");
}

}  // namespace
}  // namespace lacuna::benchmarks
