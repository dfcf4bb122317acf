// SPDX-License-Identifier: MIT

#include "lacuna/regression/stages/formulation.hpp"

#include "bases/monomials.hpp"
#include "contract/contract.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "support/one_record.hpp"

namespace lacuna::contract {
namespace {

constexpr double kStep = 0.01;

/// dx/dt = y, dy/dt = -4 x, exactly.
Dataset oscillator(Index samples) {
  Trajectory record;
  record.source = "oscillator";
  record.time = Vector::LinSpaced(samples, 0.0, kStep * static_cast<double>(samples - 1));
  record.states.resize(samples, 2);
  record.states.col(0) = (2.0 * record.time.array()).cos();
  record.states.col(1) = -2.0 * (2.0 * record.time.array()).sin();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
}

/// Coefficients of 1, x, y in both equations: of the flow, or of the map that it makes of a
/// step.
Matrix coefficients_of(Evolution evolution) {
  const double c = std::cos(2.0 * kStep), s = std::sin(2.0 * kStep);
  Matrix coefficients(3, 2);
  if (evolution == Evolution::Map)
    coefficients << 0.0, 0.0, c, -2.0 * s, 0.5 * s, c;
  else
    coefficients << 0.0, 0.0, 0.0, -4.0, 1.0, 0.0;
  return coefficients;
}

class EveryFormulation : public testing::TestWithParam<StageVariant> {
 protected:
  LeastSquaresSystem assemble(const Dataset& data, const TermLibrary& library,
                              int threads = 1) const {
    RunContext context;
    context.threads = threads;
    return stage_of<Formulation>(GetParam())->assemble(data, library, context);
  }
  TermLibrary library_ = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
};

TEST_P(EveryFormulation, GivesOneTargetPerStateThatTheTrueTermsExplain) {
  const LeastSquaresSystem system = assemble(oscillator(1000), library_);
  ASSERT_EQ(system.targets(), 2);
  EXPECT_EQ(system.term_names(), library_.names());
  const Vector first = system.subproblem(0, {0, 1, 2}).solve();
  const Vector second = system.subproblem(1, {0, 1, 2}).solve();
  const Matrix expected = coefficients_of(stage_of<Formulation>(GetParam())->evolution());
  EXPECT_LT((first - expected.col(0)).norm(), 1e-4);
  EXPECT_LT((second - expected.col(1)).norm(), 1e-4);
}

TEST_P(EveryFormulation, ThreadsDoNotChangeTheSystem) {
  EXPECT_EQ(assemble(oscillator(1000), library_, 1).factor().triangle,
            assemble(oscillator(1000), library_, 2).factor().triangle);
}

TEST_P(EveryFormulation, RefusesDataThatCannotTellAnything) {
  Dataset constant = oscillator(1000);
  constant.trajectories[0].states.col(1).setConstant(3.0);
  EXPECT_THROW(assemble(constant, library_), DataError);
  EXPECT_THROW(assemble(Dataset{}, library_), DataError);
  const TermLibrary many = Monomials{{.max_degree = 12}}.library({{"x", "y"}, {}});
  EXPECT_THROW(assemble(oscillator(60), many), DataError);
}

TEST_P(EveryFormulation, NamesTheTermThatIsNotFinite) {
  Dataset data = oscillator(1000);
  data.trajectories[0].states(0, 0) = 0.0;
  const TermLibrary library{{{"x", "y"}, {}}, {Term::parse("log(x-5)", {{"x", "y"}, {}})}};
  try {
    assemble(data, library);
    FAIL() << "the logarithm of a negative number went through";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("log(x-5)"), std::string::npos) << error.what();
  }
}

TEST_P(EveryFormulation, NoiseOfTheTargetGrowsWithThatOfTheStates) {
  const auto formulation = stage_of<Formulation>(GetParam());
  const Dataset data = oscillator(1000);
  const auto once = formulation->target_noise(data, Eigen::Vector2d(1e-3, 1e-2));
  const auto twice = formulation->target_noise(data, Eigen::Vector2d(2e-3, 2e-2));
  ASSERT_EQ(once.has_value(), twice.has_value());
  if (!once) return;  // it cannot say
  EXPECT_GT((*once)[0], 0.0);
  EXPECT_NEAR((*twice)[0], 2.0 * (*once)[0], 1e-9 * (*once)[0]);
  EXPECT_NEAR((*once)[1], 10.0 * (*once)[0], 1e-9 * (*once)[1]);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFormulation,
                         testing::ValuesIn(available(Formulation::kKind)), test_name);

INSTANTIATE_TEST_SUITE_P(Registry, BasisContract, ::testing::ValuesIn(stages_of<Basis>()),
                         name_of_stage<Basis>);
INSTANTIATE_TEST_SUITE_P(Registry, DifferentiatorContract,
                         ::testing::ValuesIn(stages_of<Differentiator>()),
                         name_of_stage<Differentiator>);

class EveryBasis : public BasisContract {};

TEST_P(EveryBasis, ContainsTheStatesThemselves) {
  const auto library = library_of({{"x", "y"}, {}});
  if (!library) return;
  const std::vector<std::string> names = library->names();
  for (const std::string state : {"x", "y"})
    EXPECT_EQ(std::count(names.begin(), names.end(), state), 1) << state;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBasis, ::testing::ValuesIn(stages_of<Basis>()),
                         name_of_stage<Basis>);

}  // namespace
}  // namespace lacuna::contract
