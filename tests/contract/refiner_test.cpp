// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/refiner.hpp"

#include "contract/contract.hpp"
#include "lacuna/bases/monomials.hpp"

namespace lacuna::contract {
namespace {

/// x = cos 2t, y = -2 sin 2t.
Dataset oscillator() {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.source = "oscillator";
  record.time = Vector::LinSpaced(400, 0.0, 7.98);
  record.states.resize(400, 2);
  record.states.col(0) = (2.0 * record.time.array()).cos();
  record.states.col(1) = -2.0 * (2.0 * record.time.array()).sin();
  record.inputs.resize(400, 0);
  data.trajectories.push_back(record);
  return data;
}

OdeModel nearly_right(const Dataset& data) {
  const Variables variables{{"x", "y"}, {}};
  return OdeModel(
      data.states, {},
      {{{Term::parse("y", variables), 0.97}}, {{Term::parse("x", variables), -3.9}}});
}

class EveryRefiner : public testing::TestWithParam<StageVariant> {};

TEST_P(EveryRefiner, GivesTheRightModelOrLeavesItAsItIs) {
  const Dataset data = oscillator();
  const OdeModel start = nearly_right(data);
  const TermLibrary library = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
  const RefinedModel refined = stage_of<Refiner>(GetParam())->refine({data, library, start});
  if (!refined.usable) {
    EXPECT_EQ(to_text(refined.model), to_text(start));
    return;
  }
  EXPECT_NEAR(refined.model.coefficient(0, "y"), 1.0, 1e-5);
  EXPECT_NEAR(refined.model.coefficient(1, "x"), -4.0, 1e-5);
  EXPECT_EQ(refined.misfit.size(), 2U);
}

TEST_P(EveryRefiner, RefusesAModelOfOtherStates) {
  const Dataset data = oscillator();
  const TermLibrary library = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
  const OdeModel other({{"a", ""}, {"b", ""}}, {}, {{}, {}});
  EXPECT_THROW(stage_of<Refiner>(GetParam())->refine({data, library, other}), ArgumentError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryRefiner, testing::ValuesIn(available(Refiner::kKind)),
                         test_name);

}  // namespace
}  // namespace lacuna::contract
