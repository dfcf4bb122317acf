// SPDX-License-Identifier: MIT
#include "trajectories/fit/adequacy/fit_adequacy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grey_box.hpp"
#include "trajectories/fit/fit_quality.hpp"

namespace lacuna {
namespace {

constexpr const char* kDecay = "param k = 0.5 in 0.01..50\ndx/dt = -k*x\ny = x\n";

/// A model fitted to a record of another one.
struct Judged {
  Judged(const std::string& truth, const std::string& text, Index samples,
         double noise = 0.03) {
    const Dataset data = support::grey_box_columns(
        parse_ode(truth, "t.ode"),
        {.start = Vector::Constant(1, 4.0), .step = 0.1, .samples = samples, .noise = noise});
    const SystemModel system = parse_ode_system(text, "m.ode");
    const ParametrisedModel model = system.parametrised();
    engine.emplace(fit_engine(
        model, fit_records(model, model_view(system.model(), data, FiniteDifferences{}))));
    set_substeps(*engine, 4);
    unknowns = fit_unknowns(model, {});
    minimum = minimise(*engine, unknowns, {model.values().transpose(), engine->records.starts},
                       {}, 50, {});
    quality = quality_of(*engine, minimum.point, minimum.path, 5, 0);
    adequacy = adequacy_of_run(*engine, unknowns, minimum, 1, quality);
  }
  std::optional<FitEngine> engine;
  FitUnknowns unknowns;
  FitMinimum minimum;
  std::vector<FitQuality> quality;
  Adequacy adequacy;
};

TEST(AdequacyOfRun, NoiseIsAdequateAndStructureIsNot) {
  const Judged right(kDecay, kDecay, 60);
  EXPECT_EQ(right.adequacy.fits, Adequate::Yes);
  EXPECT_TRUE(right.quality[0].white);
  EXPECT_TRUE(right.quality[0].sign.empty());
  const Judged wrong("dx/dt = -0.3*x^2\ny = x\n", kDecay, 60);
  EXPECT_EQ(wrong.adequacy.fits, Adequate::No);
  EXPECT_FALSE(wrong.quality[0].white);
  EXPECT_LT(wrong.quality[0].chance, 0.05);
  EXPECT_FALSE(wrong.quality[0].sign.empty());
}

TEST(AdequacyOfRun, FewSamplesSayNothingInFavour) {
  const Judged few(kDecay, kDecay, 9);
  EXPECT_EQ(few.adequacy.fits, Adequate::Undetermined);
  EXPECT_FALSE(few.quality[0].white);
  EXPECT_LT(few.quality[0].power, 0.8);
  EXPECT_EQ(Judged("dx/dt = -0.8*x^2\ny = x\n", kDecay, 14, 0.005).adequacy.fits, Adequate::No)
      << "but they may say it against";
}

TEST(AdequacyOfRun, NoiseThatCannotBeSeenIsNotJudged) {
  Judged exact(kDecay, kDecay, 60, 0.0);
  for (const double noise : {0.0, 1e-9}) {
    exact.quality[0].noise = noise;
    const Adequacy judged =
        adequacy_of_run(*exact.engine, exact.unknowns, exact.minimum, 1, exact.quality);
    EXPECT_EQ(judged.fits == Adequate::Undetermined, noise == 0.0);
  }
}

TEST(ResidualsOf, LeaveWhatTheFitDidNotTake) {
  Judged right(kDecay, kDecay, 60);
  const MinimumResiduals found = residuals_of(*right.engine, right.unknowns, right.minimum);
  EXPECT_EQ(found.directions.rank(), 2) << "the start and the rate";
  Vector left = found.residuals.residual;
  found.directions.remove(left);
  EXPECT_LT((left - found.residuals.residual).norm(), 1e-2 * left.norm()) << "a minimum";
  ASSERT_EQ(found.residuals.sequences.size(), 1u);
  EXPECT_EQ(found.residuals.sequences[0].rows.size(), 60u);
  right.unknowns.initial[0] = InitialValue{4.0, true};
  EXPECT_EQ(residuals_of(*right.engine, right.unknowns, right.minimum).directions.rank(), 1);
  right.unknowns.initial[0] = InitialValue{4.0, false, 1e-6};
  EXPECT_EQ(residuals_of(*right.engine, right.unknowns, right.minimum).directions.rank(), 1)
      << "known much better beforehand";
  right.unknowns.upper[0] = right.minimum.point.parameters(0, 0);
  EXPECT_EQ(residuals_of(*right.engine, right.unknowns, right.minimum).directions.rank(), 0);
}

}  // namespace
}  // namespace lacuna
