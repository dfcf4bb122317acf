// SPDX-License-Identifier: MIT

#include "cli/commands/answers.hpp"

#include "bases/expressions.hpp"
#include "report/pages/folded_text.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;
using testing::run_well;
using testing::TemporaryFolder;

/// The record of the oscillator as a table in memory.
cli::DataOptions in_memory(const Records& records) {
  cli::DataOptions data;
  data.tables = {read_table(records.oscillator())};
  return data;
}

TEST(Answers, TablesInMemoryAreAsGoodAsFiles) {
  const Records records;
  const Registry registry = default_registry();
  cli::SyncRequest request{.model = {records.oscillator_model()}, .data = in_memory(records)};
  const cli::SyncAnswer found = answer(registry, request, {});
  const auto shown = run_command({"sync", records.oscillator_model(), records.oscillator()});
  EXPECT_EQ(folded(text_of(found)), shown.out);
  EXPECT_EQ(failure_of(found), "");
  const cli::CheckRequest check{.data = in_memory(records)};
  EXPECT_EQ(folded(format_text(answer(registry, check))),
            run_command({"check", records.oscillator()}).out);
}

TEST(Answers, AModelInMemoryIsAsGoodAsItsFile) {
  const Records records;
  const SystemModel model = cli::load_system({records.oscillator_model()});
  const cli::SimulateRequest request{.model = {.given = model},
                                     .x0 = "1,0",
                                     .times = Vector(Eigen::Vector3d(0.0, 0.1, 0.5)),
                                     .inputs = {.tables = in_memory(records).tables}};
  const cli::SimulateAnswer found = answer(default_registry(), request, {});
  EXPECT_EQ(found.problem, "");
  EXPECT_EQ(found.data.trajectories.at(0).time, Vector(Eigen::Vector3d(0.0, 0.1, 0.5)));
  EXPECT_NEAR(found.data.trajectories.at(0).states(1, 0), std::cos(0.2), 1e-3);
}

TEST(Answers, WhatIsBeyondTheInputsIsNoted) {
  const Records records;
  const cli::SimulateRequest request{.model = {records.oscillator_model()},
                                     .x0 = "1,0",
                                     .t_end = 20.0,
                                     .step = 1.0,
                                     .inputs = {.paths = {records.oscillator()}}};
  EXPECT_THAT(answer(default_registry(), request, {}).notes,
              ::testing::ElementsAre(HasSubstr("ends at 7.98")));
}

TEST(Answers, AStageOfItsOwnTakesThePlaceOfThePipelines) {
  const Records records;
  cli::IdentifyRequest request{.data = in_memory(records)};
  request.data.inputs = "u";
  request.config_text = R"({"preset": "sindy"})";
  request.basis = Expressions({.terms = {"x", "u"}});
  const cli::IdentifyAnswer found = answer(default_registry(), request, {});
  EXPECT_EQ(found.report.pipeline.basis->info().name, "expressions");
  EXPECT_THAT(found.report.asked, HasSubstr("sindy"));
  EXPECT_EQ(found.report.result.trail.size(), 2u);
}

TEST(Answers, TwoRecordsAreComparedAndNoMore) {
  const Records records;
  cli::CompareRequest request{.first = {.tables = in_memory(records).tables},
                              .data = in_memory(records)};
  const cli::CompareAnswer found = answer(default_registry(), request, {});
  EXPECT_EQ(found.report.first, records.oscillator());
  EXPECT_TRUE(found.report.agree());
  request.data.tables.push_back(request.data.tables.front());
  EXPECT_THROW(answer(default_registry(), request, {}), ConfigError);
}

TEST(BenchCommand, ComparesPartsOnATestSystem) {
  const TemporaryFolder folder;
  const auto result = run_well({"bench", "lorenz", "--parts", "regressor=ols,stlsq", "--parts",
                                "pruner=keep-all", "--noise", "0,0.01", "--draws", "2",
                                "--degree", "2", "--csv", folder.file("b.csv"), "--report",
                                folder.file("b.html"), "--samples", "1500"});
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
      run_well({"bench", records.rossler(), "--parts", "regressor.threshold=0.05,1000", "--set",
                "regressor=stlsq", "--degree", "2", "--csv", "-"});
  EXPECT_THAT(result.out, HasSubstr("regressor.threshold,noise %"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("exact %")));
}

TEST(BenchCommand, AllTakesEveryVariantOfAKind) {
  const auto result = run_well({"bench", "lorenz", "--parts", "differentiator=all", "--degree",
                                "2", "--samples", "400", "--csv", "-"});
  for (const char* name : {"finite-differences", "kalman", "smoothing-spline", "auto"})
    EXPECT_THAT(result.out, HasSubstr(std::string("\n") + name + ","));
}

TEST(BenchCommand, ComparesRefinersWhereTheyAreAskedFor) {
  const auto result = run_well({"bench", "lorenz", "--parts", "refiner=none,trajectory",
                                "--degree", "2", "--samples", "400"});
  EXPECT_THAT(result.out, HasSubstr("trajectory"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("Without a refiner")));
}

TEST(BenchCommand, SaysWhatIsWrong) {
  expect_refused({"bench", "lorenz", "--parts", "regressor"}, {"KIND=a,b"});
  expect_refused({"bench", "lorenz", "--parts", "regressor=olss"}, {"ols"});
  expect_refused({"bench", "lorenz", "--parts", "regressor=ols,ols"}, {"twice"});
  expect_refused({"bench", "lorenz", "--parts", "filter=abm", "--noise", "x"}, {"percent"});
  expect_refused({"bench", "no_such.csv", "--parts", "filter=abm"}, {"no_such.csv"});
}

TEST(BenchCommand, ADegreeIsThatOfTheBasesThatHaveOne) {
  const auto result = run_well({"bench", "lorenz", "--parts", "basis=monomials,fourier",
                                "--degree", "2", "--samples", "400", "--csv", "-"});
  expect_refused(
      {"bench", "lorenz", "--parts", "pruner=all", "--degree", "2", "--set", "basis=fourier"},
      {"--set basis=fourier", "basis.type"});
}

}  // namespace
}  // namespace lacuna
