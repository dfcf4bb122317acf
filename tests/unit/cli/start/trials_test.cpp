// SPDX-License-Identifier: MIT
#include "cli/start/trials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::Not;

/// Installed: <prefix>/bin/lacuna and <prefix>/share/lacuna/data. Built: <source>/build/x/lacuna.
TEST(ShippedData, IsBesideAnInstalledProgramAndAboveABuiltOne) {
  const testing::TemporaryFolder folder;
  const fs::path root = folder.path();
  fs::create_directories(root / "share/lacuna/data");
  fs::create_directories(root / "tree/data");
  EXPECT_FALSE(shipped_data(root / "bin/lacuna"));
  folder.write("share/lacuna/data/pendulum.ode", "");
  folder.write("tree/data/pendulum.ode", "");
  EXPECT_EQ(shipped_data(root / "bin/lacuna"), root / "share/lacuna/data");
  EXPECT_EQ(shipped_data(root / "tree/build/check/lacuna"), root / "tree/data");
}

TEST(Trials, NameFilesThatAreThere) {
  const fs::path data = fs::path(LACUNA_SOURCE_DIR) / "data";
  int files = 0;
  for (const TrialCommand& trial : trials(data))
    for (const std::string& word : trial.words)
      if (word.find('/') != std::string::npos) {
        EXPECT_TRUE(fs::exists(word)) << word;
        ++files;
      }
  EXPECT_EQ(files, 5);
}

TEST(Welcome, ShowsThreeThingsToTryWhereTheRecordsAre) {
  const std::string text = welcome(fs::path("/usr/share/lacuna/data"));
  for (const char* part :
       {"lacuna start FILE", "  lacuna check /usr/share/lacuna/data/pendulum_scope_1.csv.gz\n",
        "  lacuna diagnose --model /usr/share", "  lacuna identify /usr/share", "lacuna --help"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(welcome({}), Not(HasSubstr("demo")));
}

}  // namespace
}  // namespace lacuna::cli
