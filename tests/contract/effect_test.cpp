// SPDX-License-Identifier: MIT

#include "lacuna/forms/candidate/effect.hpp"

#include <algorithm>
#include <set>

#include "contract/contract.hpp"
#include "contract/effect_systems.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/candidates/screening.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna::contract {
namespace {

class EveryEffect : public testing::TestWithParam<StageVariant> {
 protected:
  Stage<Effect> effect() const { return stage_of<Effect>(GetParam()); }

  /// Calls `visit(scope, candidate)` for all that the effect proposes in effect_systems().
  template <class Visit>
  void for_all(Visit visit) const {
    for (const EffectSystem& system : effect_systems()) {
      const Scope scope = system.scope();
      for (Index k = 0; k < scope.model.dimension(); ++k)
        for (const Candidate& candidate : effect()->candidates(scope, k))
          visit(scope, candidate);
    }
  }
};

TEST_P(EveryEffect, SaysWhereItComesFrom) { EXPECT_GT(effect()->typical_cause().size(), 5u); }

TEST_P(EveryEffect, ProposesSomethingSomewhere) {
  int count = 0;
  for_all([&](const Scope&, const Candidate& candidate) {
    ++count;
    EXPECT_EQ(candidate.families, std::vector<std::string>{std::string(effect()->info().name)});
  });
  EXPECT_GT(count, 0);
}

TEST_P(EveryEffect, FormsReadBackAsTheyArePrinted) {
  for_all([](const Scope&, const Candidate& candidate) {
    EXPECT_EQ(parse_expression(candidate.form.to_string()), candidate.form);
    EXPECT_EQ(parse_expression(candidate.argument.to_string()), candidate.argument);
    for (const MemoryState& memory : candidate.memory) {
      EXPECT_EQ(parse_expression(memory.rate.to_string()), memory.rate);
      EXPECT_EQ(parse_expression(memory.start.to_string()), memory.start);
    }
  });
}

TEST_P(EveryEffect, FormsAreDistinct) {
  for (const EffectSystem& system : effect_systems()) {
    const Scope scope = system.scope();
    for (Index k = 0; k < scope.model.dimension(); ++k) {
      const std::vector<Candidate> all = effect()->candidates(scope, k);
      EXPECT_EQ(merged(all).size(), all.size()) << scope.state(k).name;
    }
  }
}

TEST_P(EveryEffect, StartsLieInTheirRanges) {
  for_all([](const Scope&, const Candidate& candidate) {
    ASSERT_FALSE(candidate.starts.empty());
    EXPECT_LE(candidate.least, candidate.most);
    for (const Vector& start : candidate.starts)
      for (Index i = 0; i < start.size(); ++i) {
        EXPECT_GE(start[i], candidate.shapes[static_cast<std::size_t>(i)].low);
        EXPECT_LE(start[i], candidate.shapes[static_cast<std::size_t>(i)].high);
      }
  });
}

TEST_P(EveryEffect, NamesWhatItProposes) {
  bool named = false;
  for_all([&](const Scope& scope, const Candidate& candidate) {
    for (const double sign : {-1.0, 1.0})
      for (const Vector& start : candidate.starts) {
        const auto reading =
            reading_at(*effect(), scope, candidate, start, sign * size_of(scope, candidate));
        if (!reading) continue;
        named = true;
        EXPECT_GT(reading->sentence.size(), 5u);
        EXPECT_TRUE(reading->parameters.empty() ||
                    reading->parameters.size() == candidate.shapes.size());
      }
  });
  EXPECT_TRUE(named);
}

TEST_P(EveryEffect, NamesFormsWhoeverProposedThem) {
  for_all([&](const Scope& scope, Candidate candidate) {
    const Vector start = candidate.starts.front();
    const double size = size_of(scope, candidate);
    const bool own = reading_at(*effect(), scope, candidate, start, size).has_value();
    candidate.families = {"somebody"};
    EXPECT_EQ(reading_at(*effect(), scope, candidate, start, size).has_value(), own)
        << candidate.form.to_string();
  });
}

TEST_P(EveryEffect, HasNoNameForAFormThatNobodyKnows) {
  Candidate odd;
  odd.form = parse_expression("atan(q-exp(sin(v)))");
  odd.argument = Expression::variable("q");
  odd.equation = 1;
  const Scope scope = effect_systems().front().scope();
  for (const double sign : {-1.0, 1.0})
    EXPECT_FALSE(reading_at(*effect(), scope, odd, Vector(0), sign));
}

TEST_P(EveryEffect, SearchKeepsTheBounds) {
  const Dataset data = support::hidden_record(support::dry_friction, 0.01);
  const Assimilation fit = support::assimilated(data);
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  const Screening screening(fit);
  for (const Candidate& candidate : effect()->candidates(scope, 1)) {
    if (candidate.is_driven()) continue;
    ScreenedCandidate found = screening.at_starts(candidate);
    screening.polish(found);
    EXPECT_GE(found.coefficient, candidate.least);
    EXPECT_LE(found.coefficient, candidate.most);
    for (std::size_t i = 0; i < candidate.shapes.size(); ++i) {
      EXPECT_GE(found.shapes[static_cast<Index>(i)], candidate.shapes[i].low);
      EXPECT_LE(found.shapes[static_cast<Index>(i)], candidate.shapes[i].high);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffect, testing::ValuesIn(available(Effect::kKind)),
                         test_name);

// What effects say of records: nothing where nothing is missing, themselves where they act, and
// the same when every variable changes its sign.
constexpr double kNoise = 0.002;

Scope scope_on(const Dataset& data) {
  return make_scope(support::oscillator(), data, Vector::Constant(2, kNoise), {{1, 0.4, 5.0}});
}

double rms(const Vector& values) {
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

/// The driven oscillator with the effect in dv/dt, as large as a third of the rate; nothing
/// where it runs away.
std::optional<std::pair<Dataset, double>> planted(const Candidate& candidate,
                                                  const Vector& shapes) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories.front();
  const OdeModel nominal = support::oscillator();
  const std::span<const double> values(shapes.data(), static_cast<std::size_t>(shapes.size()));
  const LinearisedRecord grid = grid_of(nominal.inputs(), record, record.states);
  const Vector form = form_along(candidate, values, nominal.variables(), grid);
  const Vector rate = evaluate_on(grid, nominal.variables(), parse_expression("-4*q-0.2*v+F"));
  const double size = 0.3 * rms(rate) / rms(form);
  const double sign = candidate.least < 0.0 ? -1.0 : 1.0;
  const double coefficient = std::clamp(sign * size, candidate.least, candidate.most);
  const AugmentedProblem problem =
      augment(nominal, data, {}, {{candidate, shapes, coefficient}}, {record.states});
  RecordInput force(record);
  const Solution motion =
      simulate(DrivenModel{problem.model, force}, Rk4{{.substeps = 4}},
               problem.data.trajectories.front().states.row(0).transpose(), record.time);
  if (motion.status != IntegrationStatus::Completed) return std::nullopt;
  if (motion.states.cwiseAbs().maxCoeff() > 50.0) return std::nullopt;
  Random random(7);
  for (Index i = 0; i < record.samples(); ++i)
    for (Index k = 0; k < 2; ++k)
      record.states(i, k) = motion.states(i, k) + kNoise * random.normal();
  return std::pair(std::move(data), coefficient);
}

class EveryEffectOnRecords : public testing::TestWithParam<StageVariant> {
 protected:
  Stage<Effect> effect() const { return stage_of<Effect>(GetParam()); }
};

TEST_P(EveryEffectOnRecords, IsSilentWhereNothingIsMissing) {
  const Dataset data = support::hidden_record(support::nothing, kNoise, 17);
  const Assimilation fit = support::assimilated(data);
  const Screening screening(fit);
  double best = 0.0, tried = 1.0;
  for (const Candidate& candidate : effect()->candidates(scope_on(data), 1)) {
    if (candidate.is_driven()) continue;
    ScreenedCandidate found = screening.at_starts(candidate);
    screening.polish(found);
    const auto freedom = 1.0 + static_cast<double>(candidate.shapes.size());
    best = std::max(best, sigma_of_gain(found.gain, freedom, 1.0));
    tried += static_cast<double>(found.tried);
  }
  // 4 standard deviations of one try are less than 3 of so many.
  EXPECT_LT(best, 4.0) << tried << " tried";
}

TEST_P(EveryEffectOnRecords, IsFoundWhereItActs) {
  const Dataset bare = support::hidden_record(support::nothing, kNoise);
  for (const Candidate& candidate : effect()->candidates(scope_on(bare), 1)) {
    if (candidate.is_driven() || candidate.place == Place::Channel) continue;
    // The first and the last ones are at the ends of what records can show.
    const Vector& shapes = candidate.starts[candidate.starts.size() / 2];
    const auto made = planted(candidate, shapes);
    if (!made) continue;
    const Assimilation fit = support::assimilated(made->first);
    const std::span<const double> values(shapes.data(),
                                         static_cast<std::size_t>(shapes.size()));
    const Score score = Screening(fit).score(candidate, values);
    EXPECT_GT(sigma_of_gain(score.gain, 1.0, 1.0), 5.0) << candidate.form.to_string();
    EXPECT_GT(score.coefficient * made->second, 0.0) << candidate.form.to_string();
  }
}

/// A system in which every variable x is measured as -x.
Scope mirrored(const EffectSystem& system) {
  Scope scope = system.scope();
  for (VariableRange& range : scope.variables) {
    std::swap(range.low, range.high);
    for (double* value : {&range.low, &range.high, &range.mean}) *value = -*value;
    range.quantiles = (-range.quantiles.reverse()).eval();
  }
  scope.samples.leftCols(scope.samples.cols() - 1) *= -1.0;
  std::vector<Equation> equations = scope.model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation) {
      int degree = 0;
      const std::vector<int> powers = *summand.term.exponents();
      for (const int power : powers) degree += power;
      if (degree % 2 == 0) summand.coefficient = -summand.coefficient;
    }
  scope.model = {scope.model.states(), scope.model.inputs(), equations,
                 scope.model.time_unit()};
  return scope;
}

/// Arguments of what is proposed, and whether it gets a name with one of the signs.
std::multiset<std::string> proposals(const Effect& effect, const Scope& scope, Index equation) {
  std::multiset<std::string> all;
  for (const Candidate& candidate : effect.candidates(scope, equation))
    for (const Vector& start : candidate.starts) {
      const double size = size_of(scope, candidate);
      const bool named = reading_at(effect, scope, candidate, start, size).has_value() ||
                         reading_at(effect, scope, candidate, start, -size).has_value();
      all.insert(candidate.argument.to_string() + (named ? " named" : ""));
    }
  return all;
}

TEST_P(EveryEffectOnRecords, SignsOfVariablesPlayNoRole) {
  const EffectSystem system = effect_systems().front();
  const Scope one = system.scope(), other = mirrored(system);
  for (Index k = 0; k < one.model.dimension(); ++k)
    EXPECT_EQ(proposals(*effect(), one, k), proposals(*effect(), other, k)) << k;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffectOnRecords,
                         testing::ValuesIn(available(Effect::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
