// SPDX-License-Identifier: MIT
#include "identify/pipeline/equation_terms.hpp"

#include <gtest/gtest.h>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna {
namespace {

/// A circle: x' = -y, y' = x.
Dataset circle() {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(400, 0.0, 10.0);
  record.states.resize(400, 2);
  record.states << record.time.array().cos(), record.time.array().sin();
  record.inputs.resize(400, 0);
  return data;
}

TermLibrary linear_library() {
  return Stage<Basis>(Monomials{{.max_degree = 1}})->library({{"x", "y"}, {}});
}

EquationLibraries libraries(std::vector<EquationTerms> equations) {
  Pipeline pipeline = algorithm1();
  pipeline.equations = std::move(equations);
  return equation_libraries(linear_library(), circle(), pipeline);
}

TEST(EquationTerms, WidenTheLibraryAndKeepToTheirEquation) {
  const EquationLibraries found = libraries({{"dx", {"sin(y)", "y"}}});
  EXPECT_EQ(found.library.names(), (std::vector<std::string>{"1", "x", "y", "sin(y)"}));
  EXPECT_EQ(found.allowed[0], (TermSet{2, 3}));
  EXPECT_EQ(found.allowed[1], (TermSet{0, 1, 2}));
  EXPECT_EQ(found.own, (std::vector<bool>{true, false}));
}

TEST(EquationTerms, ErrorsNameTheEquation) {
  EXPECT_THROW(libraries({{"z", {"x"}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {"y"}}, {"dx/dt", {"x"}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {"q"}}}), ModelError);
}

TEST(EquationTerms, OnlyTheyStandInTheModel) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = preset(name);
    pipeline.equations = {{"x", {"y", "y^3"}}, {"y", {"x", "x^2"}}};
    const IdentificationResult result = identify(circle(), pipeline);
    ASSERT_EQ(result.model.equations()[0].size(), 1U) << name;
    EXPECT_NEAR(result.model.coefficient(0, "y"), -1.0, 1e-3) << name;
    ASSERT_EQ(result.model.equations()[1].size(), 1U) << name;
    EXPECT_NEAR(result.model.coefficient(1, "x"), 1.0, 1e-3) << name;
    for (const TrailEntry& entry : result.trail)
      if (entry.equation == "x" && entry.term == "x") {
        EXPECT_EQ(entry.stage, "library") << name;
      }
  }
}

TEST(EquationTerms, ABoundAdmitsWhatItsInequalityDoes) {
  for (const auto relation : {ConstraintRelation::AtMost, ConstraintRelation::AtLeast}) {
    Pipeline pipeline = algorithm1();
    pipeline.constraints = {{{{"x", "x", 2.0}, {"x", "y", 3.0}}, 5.0, relation}};
    const auto bounds = equation_libraries(linear_library(), circle(), pipeline).bounds;
    ASSERT_EQ(bounds.size(), 1U);
    ASSERT_EQ(bounds[0].summands.size(), 2U);
    for (const double a : {-2.0, 0.0, 4.0})
      for (const double b : {-1.5, 0.5, 2.0}) {
        const bool admitted =
            bounds[0].summands[0].factor * a + bounds[0].summands[1].factor * b <=
            bounds[0].value;
        const double sum = 2.0 * a + 3.0 * b;
        EXPECT_EQ(admitted, relation == ConstraintRelation::AtMost ? sum <= 5.0 : sum >= 5.0);
      }
  }
}

}  // namespace
}  // namespace lacuna
