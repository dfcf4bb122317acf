// SPDX-License-Identifier: MIT
#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::sample_report;

TEST(IdentificationText, ShowsEquationsAndErrors) {
  const std::string text = format_text(sample_report());
  EXPECT_THAT(text, HasSubstr("  dx/dt = y\n"));
  EXPECT_THAT(text, HasSubstr("  dy/dt = -2*x\n"));
  EXPECT_THAT(text, HasSubstr("0.01"));
}

TEST(IdentificationText, SaysWhatIsNotDetermined) {
  const Variables variables{{"x", "y"}, {}};
  IdentificationReport report = sample_report();
  report.result.model = report.result.model.with_equations(
      {{{Term::parse("y", variables), 1.0}},
       {{Term::parse("x", variables), 7.5e-12, 2e71, std::array{-4e71, 4e71}}}});
  EXPECT_THAT(format_text(report), HasSubstr("2e+71 (not determined)"));
}

TEST(IdentificationText, SaysWhereTrajectoriesDoNotStayFinite) {
  IdentificationReport report = sample_report();
  report.result.fit[1].misfit = INFINITY;
  EXPECT_THAT(format_text(report), HasSubstr("trajectories leave the range of numbers"));
  EXPECT_THAT(format_text(report), ::testing::Not(HasSubstr("inf x")));
}

TEST(IdentificationText, ShowsHowWellItFits) {
  const std::string text = format_text(sample_report());
  EXPECT_THAT(text, HasSubstr("dx/dt: known without a fit"));
  EXPECT_THAT(text, HasSubstr("residual rms 0.1 of 2, 100 rows, measurement noise alone gives "
                              "0.09: fits to the noise"));
  EXPECT_THAT(text, HasSubstr("x 0.003 V"));
}

TEST(IdentificationText, ShowsWhichTermsWentWhenAndByWhatNumber) {
  const std::string text = format_text(sample_report());
  EXPECT_THAT(text, HasSubstr("dy/dt: 2 candidates, 1 kept"));
  EXPECT_THAT(text, HasSubstr("removed by pruner minor-terms, residual:\n"));
  EXPECT_THAT(text, HasSubstr("3. x^2              0.11       limit 0.12\n"));
}

TEST(IdentificationText, ShowsVerdictAndRelations) {
  EXPECT_THAT(format_text(sample_report()), ::testing::Not(HasSubstr("Verdict")));
  IdentificationReport report = sample_report();
  report.result.validation = testing::sample_validation();
  report.result.relations = {testing::sample_relation()};
  const std::string text = format_text(report);
  EXPECT_THAT(text, HasSubstr("Verdict\n  An approximation: it is 5.3 %"));
  EXPECT_THAT(text, HasSubstr("100 samples that were held out"));
  EXPECT_THAT(text, HasSubstr("  try sin(x)\n"));
  EXPECT_THAT(text, HasSubstr("Relations\n  x^2 + y^2 = 4 +- 0.01 on these data"));
}

TEST(IdentificationText, ShowsSynchronisationAndWarnings) {
  const std::string text = format_text(sample_report());
  EXPECT_THAT(text, HasSubstr("relative 0.05 %"));
  EXPECT_THAT(text, HasSubstr("be careful"));
}

}  // namespace
}  // namespace lacuna
