// SPDX-License-Identifier: MIT
#include "cli/commands/answers.hpp"

#include "lacuna/bases/expressions.hpp"
#include "report/pages/folded_text.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;

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

}  // namespace
}  // namespace lacuna
