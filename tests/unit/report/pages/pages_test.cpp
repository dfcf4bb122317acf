// SPDX-License-Identifier: MIT
#include "report/pages/pages.hpp"

#include <cmath>
#include <map>

#include "support/diagnosis_scope.hpp"
#include "support/well_formed.hpp"
#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::sample_report;

/// x and y of dx/dt = y, dy/dt = -2 x.
Dataset oscillation() {
  const Vector t = Vector::LinSpaced(400, 0.0, 20.0);
  const double w = std::sqrt(2.0);
  Matrix states(400, 2);
  states << (w * t.array()).cos(), -w * (w * t.array()).sin();
  return {"ms",
          {{"x", "V"}, {"y", ""}},
          {},
          {{"run.csv", t, states, Matrix(400, 0), Matrix()}},
          {}};
}

std::map<std::string, int> pictures(const Page& page) {
  std::map<std::string, int> names;
  for (const Picture& picture : pictures_of(page)) ++names[picture.name];
  return names;
}

TEST(Pages, IdentificationShowsWhatItShould) {
  const Page page = identification_page(sample_report(), oscillation());
  EXPECT_EQ(page.headline, "1 term in 1 equation describes the record to its noise.");
  EXPECT_EQ(page.tone, Tone::Good);
  EXPECT_EQ(pictures(page), (std::map<std::string, int>{{"comparison_x", 1},
                                                        {"comparison_y", 1},
                                                        {"deviation_x", 1},
                                                        {"deviation_y", 1},
                                                        {"orbit", 1},
                                                        {"spectrum_x", 1},
                                                        {"spectrum_y", 1}}));
  const std::string html = format_html(page);
  EXPECT_EQ(support::first_fault(html), "");
  EXPECT_THAT(html, HasSubstr("be careful"));
  EXPECT_THAT(html, HasSubstr("removed by pruner minor-terms"));
  EXPECT_THAT(html, HasSubstr("-2.02 to -1.98"));
}

TEST(Pages, IdentificationSaysWhatIsNotDetermined) {
  IdentificationReport report = sample_report();
  const Variables variables{{"x", "y"}, {}};
  report.result.model = report.result.model.with_equations(
      {{{Term::parse("y", variables), 1.0}},
       {{Term::parse("x", variables), 7.5e-12, 2e71, std::array{-4e71, 4e71}}}});
  const std::string html = format_html(identification_page(report, oscillation()));
  EXPECT_THAT(html, HasSubstr("not determined"));
  EXPECT_THAT(html, ::testing::Not(HasSubstr("e+71 to")));
}

TEST(Pages, IdentificationThatDoesNotFitSaysSoFirst) {
  IdentificationReport report = sample_report();
  report.result.fit[1].fits_to_noise = false;
  const Page page = identification_page(report, oscillation());
  EXPECT_THAT(page.headline, HasSubstr("dy/dt does not"));
  EXPECT_EQ(page.tone, Tone::Doubtful);
}

TEST(Pages, IdentificationBeginsWithItsVerdict) {
  IdentificationReport report = sample_report();
  report.result.validation = testing::sample_validation();
  report.result.relations = {testing::sample_relation()};
  const Page page = identification_page(report, oscillation());
  EXPECT_EQ(page.headline,
            "1 term in 1 equation describes the record roughly, not to its noise.");
  ASSERT_FALSE(page.findings.empty());
  EXPECT_THAT(page.findings[0], HasSubstr("An approximation"));
  EXPECT_EQ(page.tone, Tone::Doubtful);
  const std::string html = format_html(page);
  EXPECT_EQ(support::first_fault(html), "");
  EXPECT_THAT(html, HasSubstr("Predictions of samples held out"));
  EXPECT_THAT(html, HasSubstr("try sin(x)"));
  EXPECT_THAT(html, HasSubstr("cannot be distinguished"));
  report.result.validation->verdict = ValidationVerdict::WrongLibrary;
  EXPECT_EQ(identification_page(report, oscillation()).tone, Tone::Bad);
  report.result.validation->verdict = ValidationVerdict::FitsToNoise;
  EXPECT_EQ(identification_page(report, oscillation()).tone, Tone::Good);
}

TEST(Pages, IdentificationOfAShortRecordHasNoRuns) {
  Dataset data = oscillation();
  data.trajectories[0] = rows_of(data.trajectories[0], 0, 10);
  EXPECT_EQ(support::first_fault(format_html(identification_page(sample_report(), data))), "");
}

Diagnosis diagnosis_with_runs() {
  const OdeModel model = support::oscillator();
  Diagnosis diagnosis{
      Verdict::PartlyExplained, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  diagnosis.disagreement.push_back(
      {1, 0.21, 0.03, 57.0, 1.0, 0.1, {{"v", -0.1, 0.1, {}, 31.0}, {"", 0, 0, 0.291, 12.0}}});
  diagnosis.coefficient_changes.push_back({1, "q", -4.0, -3.9, 0.01, 10.0});
  diagnosis.rivals = {{"named-effects", "dv/dt: sign(v)", -100.0, true, "extended-bic", -100.0},
                      {"named-effects", "dv/dt: tanh(v)", -80.0, false, "extended-bic", -80.0},
                      {"broken-identity", "q", {}, false, "inflation", 1.0, 1.3}};
  const Index n = 200;
  const Vector t = Vector::LinSpaced(n, 0.0, 10.0);
  const Matrix measured = Matrix::Random(n, 2);
  diagnosis.gap = Gap{"rms", 0.5, 0.1, 0.01, 0.5, 1.0, {"r2.csv"}};
  diagnosis.gap->runs.push_back({"r2.csv", t, measured, 0.5 * measured, measured, 0, 20});
  diagnosis.noise.measurement = {0.01, std::nullopt};
  diagnosis.notes = {"a note"};
  return diagnosis;
}

TEST(Pages, DiagnosisShowsWhatItShould) {
  const Page page = diagnosis_page(diagnosis_with_runs());
  EXPECT_EQ(page.tone, Tone::Doubtful);
  EXPECT_EQ(page.facts[0].value, "50 %");
  EXPECT_EQ(pictures(page), (std::map<std::string, int>{{"coefficients", 1},
                                                        {"comparison_q", 1},
                                                        {"comparison_v", 1},
                                                        {"deviation_q", 1},
                                                        {"deviation_v", 1},
                                                        {"rivals", 1},
                                                        {"spectrum_q", 1},
                                                        {"spectrum_v", 1},
                                                        {"where_v", 1}}));
  const std::string html = format_html(page);
  EXPECT_EQ(support::first_fault(html), "");
  EXPECT_THAT(html, HasSubstr("run freely in windows of 1.01 s,")) << "as in the pictures";
  EXPECT_THAT(html, HasSubstr("+ 20")) << "how much worse the second composite model is";
  EXPECT_THAT(html, HasSubstr("frequency 0.291 1/s"));
  EXPECT_THAT(html, HasSubstr("a note."));
  EXPECT_THAT(html, HasSubstr("inflation 1 against 1.3"));
}

/// What withholds an answer is said under its headline, other hints with what is to be known.
TEST(Pages, HintsThatWithholdAnAnswerComeFirst) {
  Diagnosis diagnosis = diagnosis_with_runs();
  diagnosis.hints = {{HintKind::TimeUnit, "time is in ms", "--time-unit ms"}};
  EXPECT_TRUE(diagnosis_page(diagnosis).first.empty());
  const std::string html = format_html(diagnosis_page(diagnosis));
  EXPECT_LT(html.find("What to know"), html.find("--time-unit ms"));
  diagnosis.hints[0].withheld = Withheld::Answer;
  EXPECT_THAT(diagnosis_page(diagnosis).first, ::testing::ElementsAre(HasSubstr("--time-unit ms")));
  EXPECT_THAT(format_html(diagnosis_page(diagnosis)),
              HasSubstr("</h1><p class=\"finding\">Hint (time-unit): time is in ms"));
}

TEST(Pages, TheFirstPictureIsOfTheEquationThatIsOff) {
  const Page page = diagnosis_page(diagnosis_with_runs());
  ASSERT_TRUE(page.picture);
  EXPECT_EQ(page.picture->name, "deviation_v");
}

TEST(Pages, NumbersOfNominalTermsAreShort) {
  Diagnosis diagnosis = diagnosis_with_runs();
  diagnosis.coefficient_changes[0].term = "sin(1.234567890123456*q)";
  const std::string html = format_html(diagnosis_page(diagnosis));
  EXPECT_THAT(html, HasSubstr("sin(1.235*q)"));
  EXPECT_THAT(html, ::testing::Not(HasSubstr("1.23456")));
}

TEST(Pages, DiagnosisWithoutAnythingHasNoEmptyHeadings) {
  Diagnosis diagnosis = diagnosis_with_runs();
  diagnosis.gap.reset();
  diagnosis.disagreement.clear();
  diagnosis.notes.clear();
  const std::string html = format_html(diagnosis_page(diagnosis));
  EXPECT_EQ(html.find("Where they disagree"), std::string::npos);
  EXPECT_EQ(html.find("Measured and modelled"), std::string::npos);
}

TEST(Pages, SyncShowsTheSlave) {
  const Dataset data = oscillation();
  SyncReport report = testing::sample_sync();
  report.result.states = {data.trajectories[0].states * 1.01};
  report.result.errors = {Vector::Constant(400, 0.01)};
  report.result.noise = Eigen::Vector2d(0.01, 0.0);
  report.verdict = {.holds = false, .sentence = "Does not hold: equation y."};
  const Page page = sync_page(report, data);
  EXPECT_EQ(page.headline, "Does not hold: equation y.");
  EXPECT_EQ(page.tone, Tone::Bad);
  EXPECT_EQ(pictures(page).count("error"), 1u);
  EXPECT_EQ(pictures(page).size(), 6u);
  EXPECT_EQ(support::first_fault(format_html(page)), "");
}

}  // namespace
}  // namespace lacuna
