// SPDX-License-Identifier: MIT
#include "identify/forms_beside/extended_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/model_comparison.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

/// What x gives to y saturates: dx/dt = 1 - 3 x y / (1 + y^2/0.25), dy/dt = the same flux less
/// 0.7 y.
class ExtendedPipelines : public testing::Test {
 protected:
  static OdeModel truth() {
    const Variables variables{{"x", "y"}, {}};
    const Term flux = Term::parse("x*y/(1+y^2/0.25)", variables);
    return OdeModel({{"x", ""}, {"y", ""}}, {},
                    {{{Term::parse("1", variables), 1.0}, {flux, -3.0}},
                     {{flux, 3.0}, {Term::parse("y", variables), -0.7}}});
  }

  /// The saturating form with a number for its shape.
  MissingForm form(Index equation, double shape) const {
    const auto& all = candidates_[static_cast<std::size_t>(equation)];
    const auto found = std::find_if(all.begin(), all.end(), [](const Candidate& one) {
      return one.form.to_string() == "x*y/(1+y^2/a^2)";
    });
    return {*found, Vector::Constant(1, shape)};
  }

  std::vector<Term> terms(const std::vector<std::string>& names) const {
    std::vector<Term> result;
    for (const std::string& name : names)
      result.push_back(Term::parse(name, alone_.model.variables()));
    return result;
  }

  const Dataset data_ = add_relative_noise(
      record_of(truth(), Dopri87{}, Eigen::Vector2d(1.5, 0.3), 0.02, 600), 0.0, 1);
  const RecordStream records_{data_};
  const Pipeline plain_ = algorithm1();
  const FormOptions options_{};
  const RunContext context_{};
  const IdentificationResult alone_ = identify(records_, plain_, context_);
  const ExtendedPipeline pipeline_{records_, plain_, options_, alone_, context_};
  const Scope scope_ = make_scope(alone_.model, data_, alone_.noise);
  const std::vector<std::vector<Candidate>> candidates_{function_forms(scope_, {}, 0),
                                                        function_forms(scope_, {}, 1)};
};

TEST_F(ExtendedPipelines, EquationsAreOfferedTheFormsOfAllOthersOnce) {
  const IdentificationResult found =
      pipeline_.identified({{0, pipeline_.library().terms, {form(0, 0.5)}},
                            {1, pipeline_.library().terms, {form(1, 0.50001)}}});
  const std::vector<EquationForms> kept =
      kept_in(found, {{0, {}, {form(0, 0.5)}}, {1, {}, {form(1, 0.50001)}}});
  ASSERT_FALSE(kept.empty());
  for (const EquationForms& equation : kept) {
    ASSERT_EQ(equation.forms.size(), 1u) << equation.equation;
    EXPECT_EQ(equation.forms[0].shapes[0], 0.5);
    EXPECT_EQ(equation.terms.size(), 1u);
  }
}

TEST_F(ExtendedPipelines, WhereTermsWereMissingShapesAreFittedAgainBesideThem) {
  const Extension found = pipeline_.settled(
      {{0, terms({"1"}), {form(0, 0.52)}}, {1, {}, {form(1, 0.6)}}}, candidates_);
  ASSERT_EQ(found.equations[1].terms.size(), 1u);
  EXPECT_EQ(found.equations[1].terms[0].name(), "y");
  for (const EquationForms& equation : found.equations) {
    ASSERT_EQ(equation.forms.size(), 1u);
    EXPECT_NEAR(equation.forms[0].shapes[0], 0.5, 1e-6);
  }
}

/// x = sin t, y = cos t; y with noise of so many.
Dataset orbit(double noise) {
  Trajectory record;
  record.time = Vector::LinSpaced(600, 0.0, 12.0);
  record.states.resize(600, 2);
  record.states << record.time.array().sin(), record.time.array().cos();
  Random random(1);
  for (Index i = 0; i < 600; ++i) record.states(i, 1) += noise * random.normal();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
}

ModelComparison comparison(double noise) { return {orbit(noise), analyse_noise(orbit(noise))}; }

EquationFit fit_of(double residual, double misfit, bool fits) {
  EquationFit fit;
  fit.residual_rms = residual;
  fit.misfit = misfit;
  fit.fits_to_noise = fits;
  return fit;
}

IdentificationResult result_of(const EquationFit& x, const EquationFit& y) {
  return {OdeModel({{"x", ""}, {"y", ""}}, {}, {{}, {}}), Vector::Zero(2), {x, y}, {}, {}, {}};
}

TEST(ModelComparison, MisfitsCountWhereTheNoiseIsSeenElseWhatIsLeftOfTheRates) {
  const auto one = result_of(fit_of(3e-6, 0.8, true), fit_of(0.1, 1.0, true));
  const auto other = result_of(fit_of(1e-6, 4.0, false), fit_of(0.1, 2.0, false));
  const ModelComparison models = comparison(0.05);
  EXPECT_NEAR(models.excess(one, other), std::log(3.0) + std::log(0.5), 1e-12);
  EXPECT_NEAR(models.excess(other, one), -models.excess(one, other), 1e-12);
}

TEST(ModelComparison, NoiseOfAPartOfEachStepIsNotSeen) {
  // A ten-thousandth of a step of y, which is 0.02 / sqrt(2), is 1.4e-6.
  const auto one = result_of(fit_of(1.0, 1.0, true), fit_of(0.3, 1.0, true));
  const auto other = result_of(fit_of(1.0, 1.0, true), fit_of(0.1, 2.0, true));
  ASSERT_NE(analyse_noise(orbit(5e-7))[1].kind, NoiseKind::None);
  EXPECT_NEAR(comparison(5e-7).excess(one, other), std::log(3.0), 1e-12);
  EXPECT_NEAR(comparison(5e-6).excess(one, other), std::log(0.5), 1e-12);
}

TEST(ModelComparison, AFitThatTakesWhatItLeavesForNoiseIsNotAhead) {
  // The cubic that leaves three times as much of x "fits" by a noise of its own.
  const auto cubic = result_of(fit_of(3e-6, 0.8, true), fit_of(1e-6, 0.9, true));
  const auto form = result_of(fit_of(1e-6, 4.0, false), fit_of(1e-6, 0.9, true));
  const ModelComparison models = comparison(0.0);
  EXPECT_FALSE(models.is_ahead(cubic, form, 0.1));
  const auto worse = result_of(fit_of(9e-6, 4.0, false), fit_of(1e-6, 0.9, true));
  EXPECT_TRUE(models.is_ahead(cubic, worse, 0.1));
  EXPECT_FALSE(models.is_ahead(cubic, worse, 1.2)) << "ln 3 is less";
}

}  // namespace
}  // namespace lacuna
