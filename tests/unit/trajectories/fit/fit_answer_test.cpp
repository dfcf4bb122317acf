// SPDX-License-Identifier: MIT
// What a fit claims, where it sends its user, and fits beside one another.
#include "trajectories/fit/fit_answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/expect_error.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using ::testing::HasSubstr;
using ::testing::Not;

Fit fit_of_one_number(Adequate fits, bool known) {
  Fit fit{.model = parse_ode_system("param k = 1\ndx/dt = -k*x\n", "m.ode")};
  fit.adequacy.fits = fits;
  fit.numbers = {{.name = "k"}};
  if (known) fit.numbers[0].ci95 = {{0.9, 1.1}};
  fit.stages = {{"fit"}, {"starts"}};
  return fit;
}

TEST(StandingOf, AFitThatALimitCutIsIncompleteWhereMoreCouldChangeIt) {
  for (const Adequate fits : {Adequate::No, Adequate::Undetermined, Adequate::Yes}) {
    Fit fit = fit_of_one_number(fits, true);
    fit.stages = {{"fit"}, {"starts", false, kTimeIsUp}};
    const FitStanding cut = standing_of(fit);
    const bool changes = fits != Adequate::Yes;  // other starts find nothing better than noise
    EXPECT_EQ(cut.admission.standing == Standing::Incomplete, changes);
    EXPECT_EQ(cut.is_sound(), !changes);
    if (changes) {
      EXPECT_THAT(sentence_of(cut), HasSubstr("Incomplete, left out: starts"));
    }
    fit.stages = {{"fit", false, kTimeIsUp}, {"starts", false, kTimeIsUp}};
    EXPECT_EQ(standing_of(fit).admission.standing, Standing::Incomplete);
    EXPECT_FALSE(standing_of(fit).is_sound());
  }
}

TEST(StandingOf, NothingIsClaimedOnNumbersThatTheRecordsDoNotDetermine) {
  for (const Adequate fits : {Adequate::No, Adequate::Yes}) {
    EXPECT_TRUE(standing_of(fit_of_one_number(fits, true)).admission.stands());
    const Admission open = standing_of(fit_of_one_number(fits, false)).admission;
    EXPECT_EQ(open.standing, Standing::Undetermined);
    EXPECT_THAT(open.why, HasSubstr("do not determine k"));
  }
}

/// Two decays beside one another, so many samples of noise 0.002 in each of three records.
Dataset two_decays(Index samples) {
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  Random random(5);
  for (const double size : {1.0, 2.0, 3.0}) {
    Vector time(samples);
    Matrix values(samples, 1);
    for (Index i = 0; i < samples; ++i) {
      time[i] = 10.0 * static_cast<double>(i) / static_cast<double>(samples);
      values(i, 0) = size * (std::exp(-time[i]) + 0.3 * std::exp(-0.1 * time[i])) +
                     0.002 * random.normal();
    }
    data.trajectories.push_back({"r", time, values, Matrix(samples, 0), Matrix()});
  }
  return data;
}

/// What a fit of one decay to them notes. @param event a statement of the model.
std::string notes_of_one_decay(Index samples, const std::string& event = "") {
  const SystemModel one =
      parse_ode_system("param k = 0.5 in 0.01..10\ndx/dt = -k*x\n" + event, "one.ode");
  const Fit found = fit(one, two_decays(samples), {});
  EXPECT_EQ(found.adequacy.fits, Adequate::No);
  std::string notes;
  for (const std::string& note : found.notes) notes += note + "\n";
  return notes;
}

TEST(FitNotes, SendNobodyToADiagnosisThatRefuses) {
  EXPECT_THAT(notes_of_one_decay(40), HasSubstr("see `lacuna diagnose`"));
  for (const std::string& notes :
       {notes_of_one_decay(15), notes_of_one_decay(40, "at 20: x += 1\n")}) {
    EXPECT_THAT(notes, HasSubstr("`lacuna fit ONE.ode TWO.ode DATA` compares structures"));
    EXPECT_THAT(notes, Not(HasSubstr("lacuna diagnose")));
  }
}

TEST(NotesOf, WhatSearchesCameToSaysWhatToDo) {
  const auto note = [](int agreeing) {
    Fit fit = fit_of_one_number(Adequate::Yes, true);
    fit.converged = true;
    fit.starts = 3;
    fit.agreeing = agreeing;
    return notes_of(fit).front();
  };
  EXPECT_THAT(note(3), HasSubstr("all 3 searches"));
  EXPECT_THAT(note(3), Not(HasSubstr("worse")));
  EXPECT_THAT(note(2), HasSubstr("2 of 3 searches"));
  EXPECT_THAT(note(2), HasSubstr("the other one to worse ones"));
  EXPECT_THAT(note(1), HasSubstr("the best, and the other 2 to worse ones"));
  EXPECT_THAT(note(1), HasSubstr("--starts"));
}

Fit fitted(const std::string& text, const Dataset& columns) {
  const SystemModel system = parse_ode_system(text, "m.ode");
  return fit(system, model_view(system.model(), columns, FiniteDifferences{}), {});
}

constexpr const char* kFirst = "param k = 0.5 in 0.01..50\ndx/dt = -k*x\ny = x\n";
constexpr const char* kSecond = "param k = 0.5 in 0.01..50\ndx/dt = -k*x^2\ny = x\n";
constexpr const char* kBoth =
    "param k = 0.5 in 0.01..50\nparam l = 0.01 in 0..50\ndx/dt = -k*x - l*x^2\n"
    "y = x\n";

Dataset record_of(const std::string& truth, std::uint64_t seed = 1) {
  return support::grey_box_columns(parse_ode(truth, "t.ode"),
                                   {.start = Vector::Constant(1, 3.0),
                                    .step = 0.1,
                                    .samples = 60,
                                    .noise = 0.03,
                                    .seed = seed});
}

TEST(CompareFits, CriteriaAreThoseOfTheFormulas) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  const RivalComparison found = compare_fits({{"one", fitted(kFirst, data)}});
  ASSERT_EQ(found.rivals.size(), 1u);
  const FitRival& one = found.rivals[0];
  EXPECT_EQ(found.values, 60.0);
  EXPECT_EQ(one.unknowns, 3.0) << "k, the start, the deviation of the noise";
  const double rmse = fitted(kFirst, data).quality[0].rmse;
  const double log_likelihood = -30.0 * (std::log(2.0 * std::numbers::pi * rmse * rmse) + 1.0);
  EXPECT_NEAR(one.log_likelihood, log_likelihood, 1e-6);
  EXPECT_NEAR(one.aicc, -2.0 * log_likelihood + 6.0 + 24.0 / 56.0, 1e-6);
  EXPECT_NEAR(one.bic, -2.0 * log_likelihood + 3.0 * std::log(60.0), 1e-6);
  EXPECT_TRUE(one.is_tied);
}

TEST(CompareFits, TheRightStructureIsAhead) {
  const Dataset data = record_of("dx/dt = -0.4*x^2\ny = x\n");
  const RivalComparison found =
      compare_fits({{"first", fitted(kFirst, data)}, {"second", fitted(kSecond, data)}});
  EXPECT_EQ(found.rivals[0].name, "second");
  EXPECT_FALSE(found.rivals[1].is_tied);
  EXPECT_GT(found.rivals[1].behind, 1.96);
}

TEST(CompareFits, ATermThatIsNotThereIsTied) {
  int ahead = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n", seed);
    const RivalComparison found =
        compare_fits({{"both", fitted(kBoth, data)}, {"first", fitted(kFirst, data)}});
    ahead += found.rivals[1].is_tied ? 0 : 1;
  }
  EXPECT_LE(ahead, 1);
}

TEST(CompareFits, WhatIsNotedAtEveryFitIsSaidOnce) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  Fit first = fitted(kFirst, data), both = fitted(kBoth, data);
  first.notes = {"of the first", "no gap on records held out"};
  both.notes = {"no gap on records held out", "of both"};
  EXPECT_EQ(compare_fits({{"first", first}, {"both", both}}).notes,
            std::vector<std::string>{"no gap on records held out"});
}

TEST(CompareFits, OtherColumnsAreAnError) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  Fit other = fitted(kFirst, data);
  other.quality[0].channel = "z";
  expect_error<DataError>(
      [&] {
        compare_fits({{"a", fitted(kFirst, data)}, {"b", other}});
      },
      "b", "not compared with the same columns as a", "outputs");
  EXPECT_THROW(compare_fits({}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
