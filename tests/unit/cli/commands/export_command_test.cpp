// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <optional>

#include "lacuna/model/export/export_model.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

TEST(ExportCommand, WritesTheFormatThatIsAskedFor) {
  EXPECT_THAT(run_command({"export", "lorenz", "--format", "c"}).out,
              HasSubstr("rate_[1] = 28.0*x - y - x*z;"));
  const testing::TemporaryFolder place;
  const std::string out = place.file("lorenz.py");
  const auto run = run_command({"export", "lorenz", "--format", "python", "-o", out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.empty());
}

TEST(ExportCommand, NamesTheNearestFormat) {
  expect_failure(run_command({"export", "lorenz", "--format", "pyton"}), 2,
                 {"pyton", "python"});
}

TEST(ExportCommand, FormatsAreListed) {
  for (const std::string& format : export_formats()) {
    EXPECT_THAT(run_command({"list", "export"}).out, HasSubstr("  " + format + " "));
    EXPECT_EQ(run_command({"describe", format}).status, 0) << format;
  }
  EXPECT_THAT(run_command({"list", "export"}).out, HasSubstr("  fmu "));
  expect_failure(run_command({"export", "lorenz", "--format", "fmi"}), 2,
                 {"'fmi'", "did you mean 'fmu'?"});
}

/// An environment variable that has another value for a while.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(ExportCommand, AnFmuNeedsAFolderAndALibrary) {
  const testing::TemporaryFolder place;
  const std::vector<std::string> words{"export", "lorenz", "--format",
                                       "fmu",    "-o",     place.file("x.fmu")};
  {
    const Environment none("TMPDIR", place.file("none"));
    expect_failure(run_command(words), 2, {"none", "TMPDIR"});
  }
  for (const char* compiler : {"true", "no-such-compiler"}) {
    const Environment given("CC", compiler);
    expect_failure(run_command(words), 2, {compiler, "made no library", "CC"});
  }
  EXPECT_EQ(place.count(), 0);
}

}  // namespace
}  // namespace lacuna
