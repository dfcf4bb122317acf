// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/model_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

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

TEST(ModelView, HasTheColumnsInTheOrderOfTheModel) {
  const Dataset view = model_view(model_of("u"), record());
  ASSERT_EQ(view.trajectories.size(), 1u);
  EXPECT_EQ(view.trajectories[0].states, (Matrix(2, 2) << 3.0, 1.0, 6.0, 4.0).finished());
  EXPECT_EQ(view.trajectories[0].inputs, (Matrix(2, 1) << 8.0, 10.0).finished());
  EXPECT_EQ(view.trajectories[0].source, "a.csv");
  EXPECT_EQ(view.states[0].name, "b");
}

TEST(ModelView, NamesWhatIsMissing) {
  try {
    model_view(model_of("w"), record());
    FAIL();
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no input 'w'"));
  }
}

}  // namespace
}  // namespace lacuna
