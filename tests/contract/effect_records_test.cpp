// SPDX-License-Identifier: MIT
// What effects say of records: nothing where nothing is missing, themselves where they act, and
// the same when every variable changes its sign.
#include <algorithm>
#include <set>

#include "contract/contract.hpp"
#include "contract/effect_systems.hpp"
#include "core/numerics/significance.hpp"
#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/candidates/screening.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/dynamics/integration/record_input.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna::contract {
namespace {

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
