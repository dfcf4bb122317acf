// SPDX-License-Identifier: MIT
#include "lacuna/shooting/structure_test.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lacuna/core/error.hpp"
#include "unit/shooting/records.hpp"

namespace lacuna {
namespace {

using testing::noisy_record;

std::vector<CandidateTerm> quadratic(const ParametrisedModel& model) {
  TermLibrary library{model.symbolic().variables(), {}};
  for (const char* term : {"1", "x", "y", "z", "x^2", "x*y", "x*z", "y^2", "y*z", "z^2"})
    library.terms.push_back(Term::parse(term, library.variables));
  return candidates_from(library, ParametrisedModel(model.symbolic(), {}));
}

std::set<std::string> terms_of(const OdeModel& model) {
  std::set<std::string> terms;
  for (Index k = 0; k < model.dimension(); ++k)
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)])
      terms.insert(std::to_string(k) + ":" + summand.term.name());
  return terms;
}

const std::set<std::string> kLorenz = {"0:x", "0:y", "1:x", "1:y", "1:x*z", "2:z", "2:x*y"};

TEST(StructureTest, MissingTermsComeBackAndUnneededOnesGo) {
  const OdeModel& lorenz = test_system("lorenz").model;
  const Variables variables = lorenz.variables();
  std::vector<Equation> equations = lorenz.equations();
  equations[1].erase(equations[1].begin() + 1);                   // -y is missing
  equations[0].push_back({Term::parse("z", variables), 0.01});    // is not there
  equations[2].push_back({Term::parse("y^2", variables), 0.01});  // is not there
  const ParametrisedModel wrong =
      with_free_coefficients({lorenz.states(), {}, std::move(equations)});
  const StructureTest test =
      test_structure(wrong, noisy_record("lorenz", 1000, 0.01), quadratic(wrong));
  EXPECT_TRUE(test.settled);
  EXPECT_EQ(terms_of(test.refinement.model.model()), kLorenz);
  EXPECT_TRUE(test.refinement.fits_to_noise);
}

TEST(StructureTest, ARightModelStaysAsItIs) {
  const ParametrisedModel right = with_free_coefficients(test_system("lorenz").model);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const StructureTest test =
        test_structure(right, noisy_record("lorenz", 500, 0.02, seed), quadratic(right));
    EXPECT_TRUE(test.changes.empty()) << test.changes.front().term;
  }
}

TEST(StructureTest, TermsWithAPriorStay) {
  const OdeModel lorenz = test_system("lorenz").model.with_term(
      0, {Term::parse("z", test_system("lorenz").model.variables()), 0.0});
  const ParametrisedModel model(lorenz, {{0, 0}, {0, 1}, {0, 2, Prior{0.0, 1.0}}});
  const StructureTest test = test_structure(model, noisy_record("lorenz", 500, 0.02), {});
  EXPECT_TRUE(test.changes.empty());
  EXPECT_EQ(test.refinement.model.size(), 3);
}

TEST(StructureTest, RejectsARateThatIsNoProbability) {
  const ParametrisedModel right = with_free_coefficients(test_system("lorenz").model);
  EXPECT_THROW(
      test_structure(right, noisy_record("lorenz", 100, 0.02), {}, {.false_alarm = 0.0}),
      ArgumentError);
}

}  // namespace
}  // namespace lacuna
