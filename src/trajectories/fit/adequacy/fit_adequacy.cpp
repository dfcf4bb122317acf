// SPDX-License-Identifier: MIT
#include "fit_adequacy.hpp"

#include <utility>

namespace lacuna {
namespace {

/// A power that is customary where a test is planned: Cohen, Statistical Power Analysis for the
/// Behavioral Sciences (1988), Sect. 2.4.
constexpr double kEnoughPower = 0.8;

/// Whether the column of an unknown is one that the fit was free to move along.
std::vector<bool> movable(const FitEngine& engine, const FitUnknowns& unknowns,
                          const FitPoint& point) {
  std::vector<bool> free(static_cast<std::size_t>(engine.states() + engine.parameters()), true);
  for (Index k = 0; k < engine.states(); ++k) {
    const auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
    free[static_cast<std::size_t>(k)] = !(initial && initial->fixed);
  }
  for (const Index p : unknowns.global) {
    const double value = point.parameters(0, p);
    free[static_cast<std::size_t>(engine.states() + p)] =
        value > unknowns.lower[p] && value < unknowns.upper[p];
  }
  return free;
}

/// Takes out the initial values that one record shows less exactly than they were known.
void drop_known(const FitUnknowns& unknowns, Eigen::Ref<Matrix> rows) {
  for (std::size_t k = 0; k < unknowns.initial.size(); ++k) {
    const auto& initial = unknowns.initial[k];
    auto column = rows.col(static_cast<Index>(k));
    if (initial && initial->deviation && column.norm() * *initial->deviation < 1.0)
      column.setZero();
  }
}

/// Takes out the own parameters of a record that are known better than it shows them.
void drop_known_own(const FitUnknowns& unknowns, const FitPoint& point, Index record,
                    Index first, Eigen::Ref<Matrix> rows) {
  for (std::size_t i = 0; i < unknowns.local.size(); ++i) {
    const auto& prior = unknowns.priors[static_cast<std::size_t>(unknowns.local[i])];
    if (!prior) continue;
    auto column = rows.col(first + static_cast<Index>(i));
    const double scale =
        prior->logarithmic ? point.parameters(record, unknowns.local[i]) : 1.0;
    if (column.norm() * prior->tolerance * scale < 1.0) column.setZero();
  }
}

/// Takes out the parameters of which more was known before than all records show.
void drop_known_parameters(const FitUnknowns& unknowns, const FitPoint& point, Matrix& rows) {
  const auto first = rows.cols() - static_cast<Index>(unknowns.global.size());
  for (Index i = 0; first + i < rows.cols(); ++i) {
    const Index p = unknowns.global[static_cast<std::size_t>(i)];
    const auto& prior = unknowns.priors[static_cast<std::size_t>(p)];
    if (!prior) continue;
    auto column = rows.col(first + i);
    const double scale = prior->logarithmic ? point.parameters(0, p) : 1.0;
    if (column.norm() * prior->tolerance * scale < 1.0) column.setZero();
  }
}

/// Rows of [initial, local, global] of all values, and what they belong to.
struct LinearRows {
  Matrix rows;
  std::vector<Index> begins = {0};
  FittedResiduals residuals;
};

/// Rows of one record, behind those of the records before.
void add_record(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
                Index record, const std::vector<Index>& order, LinearRows& all) {
  const std::vector<bool> free = movable(engine, unknowns, minimum.point);
  std::vector<ResidualSequence> sequences;
  for (Index c = 0; c < engine.count(); ++c) sequences.push_back({c, {}});
  Index row = all.begins.back();
  const auto visit = [&](Index n, const Matrix& rows, const Vector& residual) {
    for (Index c = 0; c < engine.count(); ++c) {
      if (!is_value(engine, n, c)) continue;
      for (std::size_t j = 0; j < order.size(); ++j)
        all.rows(row, static_cast<Index>(j)) =
            free[static_cast<std::size_t>(order[j])] ? rows(c, order[j]) : 0.0;
      all.residuals.residual[row] = residual[c];
      all.residuals.model[row] = engine.records.values(n, c) - minimum.path.residuals(n, c);
      sequences[static_cast<std::size_t>(c)].rows.push_back(row++);
    }
  };
  sensitivities(engine, minimum.point, minimum.path, {}, record, visit, Whitening::Pearson);
  const auto own = all.rows.middleRows(all.begins.back(), row - all.begins.back());
  drop_known(unknowns, own);
  drop_known_own(unknowns, minimum.point, record, engine.states(), own);
  all.begins.push_back(row);
  for (ResidualSequence& sequence : sequences)
    all.residuals.sequences.push_back(std::move(sequence));
}

Adequate judged(const FitQuality& quality, double level) {
  const bool exact = quality.fit_percent >= kExactFit && !(quality.noise > 0.0);
  if (quality.samples == 0 || exact) return Adequate::Undetermined;
  if (quality.chance < level) return Adequate::No;
  return quality.power < kEnoughPower ? Adequate::Undetermined : Adequate::Yes;
}

}  // namespace

MinimumResiduals residuals_of(FitEngine& engine, const FitUnknowns& unknowns,
                              const FitMinimum& minimum) {
  const std::vector<Index> order = column_order(engine, unknowns);
  Index count = 0;
  for (Index n = 0; n < engine.records.samples(); ++n)
    for (Index c = 0; c < engine.count(); ++c) count += is_value(engine, n, c) ? 1 : 0;
  LinearRows all{Matrix(count, static_cast<Index>(order.size())), {0}, {}};
  all.residuals.residual.resize(count);
  all.residuals.model.resize(count);
  all.residuals.channels = engine.count();
  for (Index r = 0; r < engine.records.records(); ++r)
    add_record(engine, unknowns, minimum, r, order, all);
  drop_known_parameters(unknowns, minimum.point, all.rows);
  const Index own = engine.states() + static_cast<Index>(unknowns.local.size());
  FittedDirections directions(all.rows, std::move(all.begins), own);
  return {std::move(all.residuals), std::move(directions)};
}

Adequacy adequacy_of_run(FitEngine& engine, const FitUnknowns& unknowns,
                         const FitMinimum& minimum, std::uint64_t seed,
                         std::vector<FitQuality>& quality) {
  const StructureTestOptions options{.seed = seed};
  const MinimumResiduals fitted = residuals_of(engine, unknowns, minimum);
  const std::vector<ChannelStructure> found =
      test_structure(fitted.residuals, fitted.directions, options);
  std::vector<AdequacyPart> parts;
  for (std::size_t c = 0; c < quality.size(); ++c) {
    quality[c].chance = found[c].chance;
    quality[c].power = found[c].power;
    quality[c].sign = found[c].chance < options.level ? found[c].sign : "";
    const Adequate fits = judged(quality[c], options.level);
    const bool rounding = fits == Adequate::Undetermined && quality[c].fit_percent >= kExactFit;
    quality[c].white = rounding ? quality[c].white : fits == Adequate::Yes;
    quality[c].residuals = fits;
    parts.push_back({quality[c].channel, fits, quality[c].samples, quality[c].noise > 0.0});
  }
  return adequacy_of(std::move(parts));
}

}  // namespace lacuna
