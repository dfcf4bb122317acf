// SPDX-License-Identifier: MIT
#include "cli/terminal/browser.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

/// BROWSER as long as it lives.
class Browser {
 public:
  explicit Browser(const std::string& program) { setenv("BROWSER", program.c_str(), 1); }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() { unsetenv("BROWSER"); }
};

TEST(OpenInBrowser, TheChosenProgramGetsTheFileAsOneWord) {
  const testing::TemporaryFolder folder;
  const std::string program =
      folder.write("show", "#!/bin/sh\nprintf '%s|%s' \"$#\" \"$1\" > '" +
                               folder.file("shown") + "'\n");
  fs::permissions(program, fs::perms::owner_all);
  const Browser browser(program);
  const std::string file = folder.file("a $(touch evil) page.html");
  EXPECT_TRUE(open_in_browser(file));
  EXPECT_EQ(folder.read("shown"), "1|" + file);
}

TEST(OpenInBrowser, APathIsGivenWhole) {
  const testing::TemporaryFolder folder;
  const std::string program =
      folder.write("show", "#!/bin/sh\nprintf '%s' \"$1\" > '" + folder.file("shown") + "'\n");
  fs::permissions(program, fs::perms::owner_all);
  const Browser browser(program);
  EXPECT_TRUE(open_in_browser("page.html"));
  EXPECT_EQ(folder.read("shown"), (fs::current_path() / "page.html").string());
}

TEST(OpenInBrowser, NoProgramOrAFailureIsSaid) {
  {
    const Browser browser("/there/is/no/such/program");
    EXPECT_FALSE(open_in_browser("page.html"));
  }
  const Browser browser("false");
  EXPECT_FALSE(open_in_browser("page.html"));
}

}  // namespace
}  // namespace lacuna::cli
