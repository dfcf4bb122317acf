// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/model_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/bound_records.hpp"
#include "support/expect_error.hpp"
#include "support/harmonic_model.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;

const FiniteDifferences kDifferences{{.order = 8}};

OdeModel model_of(const std::string& input) {
  return OdeModel({{"b", "V"}, {"a", "A"}}, {{input, "N"}}, {{}, {}});
}

Dataset record() {
  Dataset data;
  data.states = {{"a", "mA"}, {"spare", ""}, {"b", "mV"}};
  data.inputs = {{"v", ""}, {"u", ""}};
  Matrix states(2, 3), inputs(2, 2);
  states << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  inputs << 7.0, 8.0, 9.0, 10.0;
  data.trajectories = {{"a.csv", Vector{{0.0, 1.0}}, states, inputs, Matrix()}};
  return data;
}

/// An identity for each entry: dx_i/dt is the state of that name; none for "".
OdeModel chain_model(const std::vector<std::string>& states,
                     const std::vector<std::string>& rates) {
  std::vector<Quantity> quantities;
  for (const std::string& state : states) quantities.push_back({state, ""});
  std::vector<Equation> equations;
  for (const std::string& rate : rates) {
    equations.emplace_back();
    if (!rate.empty()) equations.back() = {{Term::parse(rate, {states, {}}), 1.0}};
  }
  return {quantities, {}, equations};
}

/// x = sin(t), and a second column y = cos(2 t), without inputs.
Dataset waves() {
  Dataset data;
  data.states = {{"y", ""}, {"x", ""}};
  Trajectory record;
  record.source = "waves";
  record.time = Vector::LinSpaced(400, 0.0, 8.0);
  record.states.resize(400, 2);
  record.states << (2.0 * record.time.array()).cos(), record.time.array().sin();
  data.trajectories = {record};
  return data;
}

double largest_of(const Vector& values) { return values.cwiseAbs().maxCoeff(); }

TEST(ModelView, HasTheColumnsInTheOrderOfTheModel) {
  const Dataset view = model_view(model_of("u"), record());
  ASSERT_EQ(view.trajectories.size(), 1u);
  EXPECT_EQ(view.trajectories[0].states, (Matrix(2, 2) << 3.0, 1.0, 6.0, 4.0).finished());
  EXPECT_EQ(view.trajectories[0].inputs, (Matrix(2, 1) << 8.0, 10.0).finished());
  EXPECT_EQ(view.trajectories[0].source, "a.csv");
  EXPECT_EQ(view.states[0].name, "b");
}

TEST(ModelView, FindsAnInputAmongTheStatesOfARecord) {
  const Dataset view = model_view(model_of("spare"), record());
  EXPECT_EQ(view.trajectories[0].inputs, (Matrix(2, 1) << 2.0, 5.0).finished());
}

TEST(ModelView, NamesWhatIsMissing) {
  expect_error<DataError>([] { model_view(model_of("w"), record()); }, "a.csv", "input 'w'",
                          "add the column");
  Dataset unnamed = record();
  unnamed.trajectories[0].source.clear();
  unnamed.states[2].name = "c";
  expect_error<DataError>([&] { model_view(model_of("u"), unnamed); }, "record", "state 'b'",
                          "column");
}

TEST(ModelView, KeepsWhichStatesWereMade) {
  Dataset data = record();
  data.reconstructed = {true, false, false};
  EXPECT_THAT(model_view(model_of("u"), data).reconstructed, ElementsAre(false, true));
}

TEST(ModelView, MakesStatesThatAreDerivatives) {
  const OdeModel model = chain_model({"v", "x", "a", "y"}, {"a", "v", "", ""});
  const Dataset view = model_view(model, waves(), kDifferences);
  EXPECT_EQ(view.states, model.states());
  EXPECT_THAT(view.reconstructed, ElementsAre(true, false, true, false));
  EXPECT_TRUE(view.rate_of.empty());
  const Trajectory& run = view.trajectories[0];
  EXPECT_LT(largest_of(run.states.col(0) - Vector(run.time.array().cos())), 1e-6);
  EXPECT_LT(largest_of(run.states.col(2) + Vector(run.time.array().sin())), 1e-4);
  EXPECT_LT(largest_of(run.states.col(3) - Vector((2.0 * run.time.array()).cos())), 1e-9);
}

TEST(ModelView, AStateIsMadeOnceWhereTwoIdentitiesNameIt) {
  const OdeModel model = chain_model({"x", "y", "v"}, {"v", "v", ""});
  const Trajectory run = model_view(model, waves(), kDifferences).trajectories[0];
  ASSERT_EQ(run.states.cols(), 3);
  EXPECT_LT(largest_of(run.states.col(2) - Vector(run.time.array().cos())), 1e-6)
      << "of the first state that has a column";
}

TEST(ModelView, AChainThatRunsIntoItselfEnds) {
  const OdeModel model = chain_model({"x", "v", "w", "y"}, {"v", "w", "v", ""});
  EXPECT_EQ(model_view(model, waves(), kDifferences).trajectories[0].states.cols(), 4);
}

TEST(ModelView, BringsTimeToTheUnitOfTheModel) {
  Dataset data = waves();
  data.inputs = {{"u", ""}};
  data.trajectories[0].inputs = data.trajectories[0].time;
  data.time_unit = "ms";
  data.states[1].name = "spare";
  data.states[0].name = "x";
  const Dataset view = model_view(support::harmonic_model(), data, kDifferences);
  EXPECT_EQ(view.time_unit, "s");
  const Trajectory& run = view.trajectories[0];
  EXPECT_NEAR(run.duration(), 8e-3, 1e-15);
  const Vector rate = -2e3 * (2e3 * run.time.array()).sin();
  EXPECT_LT(largest_of(run.states.col(1) - rate), 1e-2) << "per second";
}

/// x' = -2 z, z' = 3 x, y = `formula`; the record has columns x, y of waves() called as given.
struct Seen {
  OdeModel model;
  Dataset data;
};

Seen seen(const std::string& output, const std::string& formula,
          const std::vector<std::string>& columns) {
  const Variables variables{{"x", "z"}, {}};
  const OdeModel model(
      {{"x", "m"}, {"z", "V"}}, {},
      {{{Term::parse("z", variables), -2.0}}, {{Term::parse("x", variables), 3.0}}});
  Dataset data = waves();
  for (std::size_t i = 0; i < columns.size(); ++i) data.states[i].name = columns[i];
  return {model.with_outputs({{output, "V", parse_expression(formula)}}), data};
}

TEST(ModelView, AnOutputThatIsAStateMeasuresIt) {
  const auto [model, data] = seen("y", "x", {"y", "z"});
  const Dataset view = model_view(model, data, kDifferences);
  EXPECT_EQ(view.states, model.states());
  EXPECT_EQ(view.trajectories[0].states, data.trajectories[0].states);
  EXPECT_EQ(model_view(model, data).trajectories[0].states, data.trajectories[0].states);
  EXPECT_TRUE(measured_outputs(model, view).empty());
  EXPECT_NO_THROW(check_outputs_are_states(model, view));
}

TEST(ModelView, AColumnOfItsOwnNameGoesFirst) {
  const auto [model, data] = seen("y", "z", {"y", "z"});
  const Dataset view = model_view(model, data, kDifferences);
  EXPECT_EQ(view.trajectories[0].states.col(1), data.trajectories[0].states.col(1));
  EXPECT_TRUE(is_hidden(view, 0));
}

TEST(ModelView, AStateThatNobodyMeasuredIsHidden) {
  const auto scene = seen("y", "x", {"y", "spare"});
  const auto& model = scene.model;
  const auto& data = scene.data;
  const Dataset view = model_view(model, data, kDifferences);
  EXPECT_THAT(view.reconstructed, ElementsAre(false, true));
  EXPECT_FALSE(is_hidden(view, 0));
  EXPECT_TRUE(is_hidden(view, 1));
  EXPECT_EQ(view.trajectories[0].states.col(1), Vector::Zero(400));
  EXPECT_EQ(mark_of(view.trajectories[0].marks, 7, 1), Mark::Missing);
  EXPECT_EQ(mark_of(view.trajectories[0].marks, 7, 0), Mark::Value);
  EXPECT_NO_THROW(check_dataset(view));
  EXPECT_FALSE(observed(model_view(model, data, kDifferences)).channels[1].measured);
  EXPECT_NO_THROW(check_outputs_are_states(model, view));
  expect_error<DataError>([&] { model_view(model, data); }, "waves", "the state 'z'", "column");
}

TEST(ModelView, AFormulaHasAColumnBehindTheStates) {
  const auto [model, data] = seen("y", "abs(x)+z", {"z", "y"});
  const Dataset view = model_view(model, data, kDifferences);
  ASSERT_EQ(view.state_count(), 3);
  EXPECT_EQ(view.states[2].name, "y");
  EXPECT_EQ(view.trajectories[0].states.col(2), data.trajectories[0].states.col(1));
  const std::vector<MeasuredOutput> outputs = measured_outputs(model, view);
  ASSERT_EQ(outputs.size(), 1u);
  EXPECT_EQ(outputs[0].column, 2);
  EXPECT_EQ(outputs[0].output.formula.to_string(), "abs(x)+z");
  EXPECT_TRUE(is_hidden(view, 0));
  const BoundRecords records = observed(model_view(model, data, kDifferences));
  ASSERT_EQ(records.channels.size(), 3u);
  EXPECT_TRUE(records.channels[2].measured);
}

TEST(ModelView, NothingMeasuredIsAnError) {
  const auto scene = seen("y", "abs(x)+z", {"z", "Y"});
  const auto& model = scene.model;
  const auto& data = scene.data;
  expect_error<DataError>([&] { model_view(model, data, kDifferences); }, "waves",
                          "the output 'y'", "--map");
  const auto second = seen("y", "x", {"a", "b"});
  const auto& other = second.model;
  const auto& unnamed = second.data;
  expect_error<DataError>([&] { model_view(other, unnamed, kDifferences); }, "waves",
                          "the output 'y'", "'x'");
  expect_error<DataError>([&] { model_view(other.with_outputs({}), unnamed, kDifferences); },
                          "waves", "the state 'x', nor for any other", "outputs");
}

TEST(ModelView, RecordsInAnotherOrderAreNoView) {
  const OdeModel model = model_of("u");
  EXPECT_NO_THROW(check_is_view(model, model_view(model, record())));
  Dataset view = model_view(model, record());
  view.states[0].name = "other";
  EXPECT_THROW(check_is_view(model, view), DataError);
  EXPECT_THROW(check_is_view(model, record()), DataError);
  EXPECT_FALSE(is_view(model, record()));
  EXPECT_TRUE(is_view(model, model_view(model, record())));
  view = model_view(model, record());
  view.inputs.clear();
  EXPECT_THROW(check_is_view(model, view), DataError);
}

TEST(ModelView, ColumnsComeToTheUnitsOfTheModel) {
  const Dataset view = model_view(model_of("u"), record(), kDifferences);
  EXPECT_NEAR(view.trajectories[0].states(0, 0), 3e-3, 1e-15) << "b, in V";
  EXPECT_NEAR(view.trajectories[0].states(1, 1), 4e-3, 1e-15) << "a, in A";
  EXPECT_EQ(view.states[0].unit, "V");
  EXPECT_EQ(view.trajectories[0].inputs(1, 0), 10.0) << "a column without a unit";
  EXPECT_THAT(view.notes, ::testing::Contains(::testing::HasSubstr(
                              "b is taken from mV to V (factor 0.001)")));
}

TEST(ModelView, AUnitThatNothingConvertsStaysWithItsColumn) {
  Dataset data = record();
  data.states[0].unit = "counts";
  const Dataset view = model_view(model_of("u"), data, kDifferences);
  EXPECT_EQ(view.states[1].unit, "counts");
  EXPECT_EQ(view.trajectories[0].states(1, 1), 4.0);
  EXPECT_THAT(view.notes,
              ::testing::Contains(::testing::HasSubstr("a is in counts, wanted is A")));
}

}  // namespace
}  // namespace lacuna
