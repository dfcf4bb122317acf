// SPDX-License-Identifier: MIT
#include "lacuna/shooting/score_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"
#include "unit/shooting/records.hpp"

namespace lacuna {
namespace {

using testing::clean_record;

constexpr double kSmall = 0.003;

/// Lorenz with a small further term, and the refined model that lacks it.
struct Lacking {
  const TestSystem& system = test_system("lorenz");
  Term missing = Term::parse("y*z", system.model.variables());
  OdeModel truth = system.model.with_term(1, {missing, kSmall});
  Dataset record = add_relative_noise(clean_record(truth, system, 1000), 0.005, 3);
  RefineOptions options{.sigma = estimate_noise(record)};
  Refinement refined = refine(with_free_coefficients(system.model), record, options);

  std::vector<CandidateTerm> quadratic() const {
    TermLibrary library{system.model.variables(), {}};
    for (const char* term : {"1", "x", "y", "z", "x^2", "x*y", "x*z", "y^2", "y*z", "z^2"})
      library.terms.push_back(Term::parse(term, library.variables));
    return candidates_from(library, refined.model);
  }
};

TEST(ScoreSystem, FindsTheMissingTerm) {
  const Lacking lacking;
  const std::vector<CandidateTerm> candidates = lacking.quadratic();
  EXPECT_EQ(candidates.size(), 23u);
  const auto scores =
      ScoreSystem(lacking.refined, lacking.record, candidates, lacking.options).scores();
  const auto best = std::max_element(
      scores.begin(), scores.end(),
      [](const CandidateScore& a, const CandidateScore& b) { return a.gain < b.gain; });
  const CandidateTerm& found = candidates[static_cast<std::size_t>(best - scores.begin())];
  EXPECT_EQ(found.equation, 1);
  EXPECT_EQ(found.term.name(), "y*z");
  EXPECT_NEAR(best->coefficient, kSmall, 4.0 * best->standard_error);
}

TEST(ScoreSystem, PredictsWhatARefitReaches) {
  const Lacking lacking;
  const ScoreSystem system(lacking.refined, lacking.record, {{1, lacking.missing}},
                           lacking.options);
  const CandidateScore score = system.scores()[0];
  const Refinement refit =
      refine(with_free_coefficients(lacking.truth), lacking.record, lacking.options);
  ASSERT_EQ(refit.windows.size(), lacking.refined.windows.size());
  EXPECT_NEAR(score.gain, lacking.refined.chi_squared - refit.chi_squared, 0.1 * score.gain);
  EXPECT_NEAR(score.coefficient, refit.model.values()[5], 0.1 * kSmall);
  EXPECT_NEAR(score.standard_error, refit.standard_errors[5], 0.05 * score.standard_error);
}

TEST(ScoreSystem, SubproblemsGiveChangesAndValues) {
  const Lacking lacking;
  const ScoreSystem system(lacking.refined, lacking.record, lacking.quadratic(),
                           lacking.options);
  TermSet parameters;
  for (Index i = 0; i < system.parameters(); ++i) parameters.push_back(i);
  const Vector change = system.subproblem(ScoreSystem::kChange, parameters).solve();
  const Vector values = system.subproblem(ScoreSystem::kAbsolute, parameters).solve();
  EXPECT_LT(change.cwiseQuotient(lacking.refined.standard_errors).cwiseAbs().maxCoeff(), 1e-2);
  EXPECT_LT((values - lacking.refined.model.values() - change).norm(), 1e-9);
  const Vector variance =
      system.subproblem(ScoreSystem::kChange, parameters).inverse_gram_diagonal();
  EXPECT_LT((variance.cwiseSqrt() - lacking.refined.bound).norm(),
            1e-6 * lacking.refined.bound.norm());
}

TEST(ScoreSystem, NamesItsColumns) {
  const Lacking lacking;
  const ScoreSystem system(lacking.refined, lacking.record, {{1, lacking.missing}},
                           lacking.options);
  EXPECT_EQ(system.names().front(), "x: x");
  EXPECT_EQ(system.names().back(), "y: y*z");
  EXPECT_EQ(system.parameters(), 7);
  EXPECT_EQ(system.candidates(), 1);
}

TEST(ScoreSystem, RejectsTermsThatTheModelHas) {
  const Lacking lacking;
  const Term present = Term::parse("x*y", lacking.system.model.variables());
  EXPECT_THROW(ScoreSystem(lacking.refined, lacking.record, {{2, present}}), ArgumentError);
  EXPECT_THROW(ScoreSystem(lacking.refined, lacking.record, {{7, present}}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
