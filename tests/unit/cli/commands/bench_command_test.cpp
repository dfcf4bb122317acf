// SPDX-License-Identifier: MIT
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;
using testing::TemporaryFolder;

TEST(BenchCommand, ComparesPartsOnATestSystem) {
  const TemporaryFolder folder;
  const auto result = run_command({"bench", "lorenz", "--parts", "regressor=ols,stlsq",
                                   "--parts", "pruner=keep-all", "--noise", "0,0.01", "--draws",
                                   "2", "--degree", "2", "--csv", folder.file("b.csv"),
                                   "--report", folder.file("b.html"), "--samples", "1500"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Noise 0 %"));
  EXPECT_THAT(result.out, HasSubstr("Without a refiner"));
  const std::string csv = folder.read("b.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("regressor,pruner,noise %,draws"));
  EXPECT_THAT(csv, HasSubstr("stlsq,keep-all,0,1,0,1,"));
  EXPECT_THAT(csv, HasSubstr("ols,keep-all,0.01,2,0,0,"));
  EXPECT_THAT(folder.read("b.html"), HasSubstr("class=\"heat\""));
}

TEST(BenchCommand, ComparesOnARecordWithNumbersOfTheConfigurationToo) {
  const Records records;
  const auto result =
      run_command({"bench", records.rossler(), "--parts", "regressor.threshold=0.05,1000",
                   "--set", "regressor=stlsq", "--degree", "2", "--csv", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("regressor.threshold,noise %"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("exact %")));
}

TEST(BenchCommand, AllTakesEveryVariantOfAKind) {
  const auto result = run_command({"bench", "lorenz", "--parts", "differentiator=all",
                                   "--degree", "2", "--samples", "400", "--csv", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name : {"finite-differences", "kalman", "smoothing-spline", "auto"})
    EXPECT_THAT(result.out, HasSubstr(std::string("\n") + name + ","));
}

TEST(BenchCommand, ComparesRefinersWhereTheyAreAskedFor) {
  const auto result = run_command({"bench", "lorenz", "--parts", "refiner=none,trajectory",
                                   "--degree", "2", "--samples", "400"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("trajectory"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("Without a refiner")));
}

TEST(BenchCommand, SaysWhatIsWrong) {
  expect_failure(run_command({"bench", "lorenz", "--parts", "regressor"}), 2, {"KIND=a,b"});
  expect_failure(run_command({"bench", "lorenz", "--parts", "regressor=olss"}), 2, {"ols"});
  expect_failure(run_command({"bench", "lorenz", "--parts", "regressor=ols,ols"}), 2,
                 {"twice"});
  expect_failure(run_command({"bench", "lorenz", "--parts", "filter=abm", "--noise", "x"}), 2,
                 {"percent"});
  expect_failure(run_command({"bench", "no_such.csv", "--parts", "filter=abm"}), 2,
                 {"no_such.csv"});
}

TEST(BenchCommand, ADegreeIsThatOfTheBasesThatHaveOne) {
  const auto result = run_command({"bench", "lorenz", "--parts", "basis=monomials,fourier",
                                   "--degree", "2", "--samples", "400", "--csv", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  expect_failure(run_command({"bench", "lorenz", "--parts", "pruner=all", "--degree", "2",
                              "--set", "basis=fourier"}),
                 2, {"--set basis=fourier", "basis.type"});
}

}  // namespace
}  // namespace lacuna
