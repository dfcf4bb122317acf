// SPDX-License-Identifier: MIT
#include "data/formats/joined_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::TemporaryFolder;

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
