// SPDX-License-Identifier: MIT
#include "identify/journey/lower_terms.hpp"

#include <gmock/gmock.h>

#include "identify/journey/centred_library.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::Not;

/// A flow about (0, 0), moved to (1000, -500), with noise of a hundredth of each deviation.
class LowerTerms : public ::testing::Test {
 protected:
  void record(const std::string& text) {
    data_ = add_relative_noise(
        testing::without_derivatives(record_of(parse_ode(text, "flow"), Dopri87{},
                                               Eigen::Vector2d(1.0, 1.0), 0.05, 400)),
        0.01, 3);
    data_.trajectories[0].states.col(0).array() += 1000.0;
    data_.trajectories[0].states.col(1).array() -= 500.0;
    plain_ = algorithm1();
    plain_.basis = Monomials{{.max_degree = 2}};
    std::vector<std::string> warnings;
    centred_ = with_centred_library(plain_, data_, warnings);
    names_ = centred_.basis->library({{"x", "y"}, {}}).names();
    ASSERT_EQ(names_.size(), 6u);
  }

  /// What is found where dx/dt may have these of 1, x, y, x^2, x*y, y^2 about the centre.
  IdentificationResult found_with(const std::vector<std::size_t>& places) {
    Pipeline restricted = centred_;
    EquationTerms own{"x", {}};
    for (const std::size_t place : places) own.terms.push_back(names_[place]);
    restricted.equations = {own};
    return identify(data_, restricted);
  }

  std::vector<std::string> terms_after(const IdentificationResult& found) {
    result_ = with_lower_terms(plain_, centred_, data_, found, {});
    std::vector<std::string> terms;
    for (const WeightedTerm& summand : result_->model.equations()[0])
      terms.push_back(summand.term.name());
    return terms;
  }

  Dataset data_;
  Pipeline plain_ = algorithm1(), centred_ = algorithm1();
  std::vector<std::string> names_;
  std::optional<IdentificationResult> result_;
};

TEST_F(LowerTerms, APowerThatStandsInForThemGoes) {
  record("dx/dt = 0.7*x - 0.5*x*y\ndy/dt = -0.6*y + 0.4*x*y\n");
  IdentificationResult odd = found_with({2, 4});
  std::vector<Equation> equations = odd.model.equations();
  equations[0].push_back({Term::parse(names_[3], {{"x", "y"}, {}}), 1e-3});
  odd.model = odd.model.with_equations(equations);
  EXPECT_THAT(terms_after(odd), Not(Contains(names_[3])));
  EXPECT_THAT(terms_after(odd), Contains(names_[4]));
  EXPECT_THAT(result_->trail, Contains(::testing::AllOf(
                                  ::testing::Field(&TrailEntry::term, names_[3]),
                                  ::testing::Field(&TrailEntry::stage, "lower terms"))));
}

TEST_F(LowerTerms, ASquareAboutTheCentreStays) {
  // dx/dt of y only through (y - c)^2.
  record("dx/dt = y^2 - 1.2\ndy/dt = -x\n");
  const IdentificationResult found = found_with({0, 1, 2, 3, 4, 5});
  EXPECT_THAT(terms_after(found), Contains(names_[5]));
}

}  // namespace
}  // namespace lacuna
