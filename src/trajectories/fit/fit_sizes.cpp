// SPDX-License-Identifier: MIT
// How large the noise of each channel is, and what fits are compared by.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fit_search.hpp"

namespace lacuna {
namespace {

/// A fact of rounding: residuals of a channel that is met exactly are this part of its noise.
constexpr double kExact = 1e-9;

/// Whether sizes of a law are estimated and depend on where the model is.
bool size_moves(const std::optional<ChannelNoise>& noise) {
  if (!noise) return false;
  const NoiseLaw& law = noise->law();
  const bool is_open = (has_constant(law.form) && !law.constant) ||
                       (has_fraction(law.form) && !law.fraction);
  return is_open && (law.below || law.above);
}

/// -2 log-likelihood of the values of a channel, less a constant, with the size of its noise that
/// is the best for a path.
double channel_deviance(const FitEngine& engine, const FitPath& path, Index c) {
  std::vector<Index> rows;
  for (Index n = 0; n < path.residuals.rows(); ++n)
    if (engine.records.valid(n, c) > 0.0) rows.push_back(n);
  const Vector residuals = path.residuals(rows, c), measured = engine.records.values(rows, c);
  double deviance = 0.0;
  if (const auto& law = engine.laws[static_cast<std::size_t>(c)]) {
    ChannelNoise sized = *law;
    sized.estimate(measured, measured - residuals, 1.0);
    for (Index i = 0; i < residuals.size(); ++i)
      deviance -= 2.0 * sized.log_likelihood(measured[i], measured[i] - residuals[i]);
  } else if (const Matrix& known = engine.records.deviations;
             known.size() > 0 && known.col(c).maxCoeff() > 0.0) {
    deviance = residuals.cwiseQuotient(known(rows, c)).squaredNorm();
  } else if (!rows.empty()) {
    const double rms = residuals.norm() / std::sqrt(static_cast<double>(residuals.size()));
    deviance = 2.0 * static_cast<double>(residuals.size()) *
               std::log(std::max(rms, kExact * engine.sigma[c]));
  }
  return deviance;
}

}  // namespace

double deviance_of(const FitEngine& engine, const FitUnknowns& unknowns,
                   const FitMinimum& minimum) {
  if (!std::isfinite(minimum.path.cost)) return std::numeric_limits<double>::infinity();
  double deviance =
      total_cost(unknowns, minimum.point, minimum.path) - minimum.path.cost;  // of priors
  for (Index c = 0; c < engine.count(); ++c)
    deviance += channel_deviance(engine, minimum.path, c);
  return deviance;
}

bool sizes_move(const FitEngine& engine) {
  return std::any_of(engine.laws.begin(), engine.laws.end(), size_moves);
}

double take_sizes(FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path) {
  const Vector sigma =
      residual_rms(engine, unknowns, path).cwiseMax(kExact * engine.sigma);
  const double change =
      std::max((sigma.array() / engine.sigma.array()).log().abs().maxCoeff(),
               estimate_laws(engine, unknowns, path));
  engine.sigma = sigma;
  return change;
}

double estimate_laws(FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path) {
  const double all = degrees_of_freedom(engine, unknowns) /
                     std::max(1.0, engine.records.valid.sum());
  double change = 0.0;
  for (Index c = 0; c < engine.count(); ++c) {
    auto& law = engine.laws[static_cast<std::size_t>(c)];
    if (!law) continue;
    std::vector<Index> rows;
    for (Index n = 0; n < path.residuals.rows(); ++n)
      if (engine.records.valid(n, c) > 0.0) rows.push_back(n);
    const Vector measured = engine.records.values(rows, c);
    const double usual = engine.records.channels[static_cast<std::size_t>(c)].spread;
    const double before = law->deviation(usual);
    law->estimate(measured, measured - path.residuals(rows, c), size_moves(law) ? 1.0 : all);
    change = std::max(change, std::abs(std::log(law->deviation(usual) / before)));
  }
  return change;
}

Vector residual_rms(const FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path) {
  const double all = engine.records.valid.sum();
  const double fraction = degrees_of_freedom(engine, unknowns) / std::max(1.0, all);
  Vector rms(path.residuals.cols());
  for (Index c = 0; c < rms.size(); ++c)
    rms[c] = path.residuals.col(c).norm() /
             std::sqrt(std::max(1.0, fraction * engine.records.valid.col(c).sum()));
  return rms;
}

}  // namespace lacuna
