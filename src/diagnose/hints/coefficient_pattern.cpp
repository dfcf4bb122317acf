// SPDX-License-Identifier: MIT
#include "coefficient_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <set>
#include <utility>

#include "core/numerics/least_squares.hpp"

namespace lacuna {
namespace {

constexpr double kSharedBy = 2.0;  // by which overlapping windows make errors look smaller

/// What a slip makes of the coefficients; nothing for terms that are no powers of a channel
/// that it scales.
std::optional<double> made_by(const OdeModel& model, const Slip& slip, Index equation,
                              Index summand) {
  const Term& term =
      model.equations()[static_cast<std::size_t>(equation)][static_cast<std::size_t>(summand)]
          .term;
  const std::set<std::string> used = term.expression().variables();
  double factor = slip.kind == HintKind::TimeUnit ? slip.correction : 1.0;
  if (slip.kind == HintKind::TimeUnit && used.contains("t")) return std::nullopt;
  for (const Index channel : slip.channels) {
    if (channel == equation) factor /= slip.correction;
    if (!used.contains(channel_name(model, channel))) continue;
    const auto exponents = term.exponents();
    if (!exponents) return std::nullopt;
    factor *= std::pow(slip.correction, (*exponents)[static_cast<std::size_t>(channel)]);
  }
  return factor;
}

/// |log r|, where the other sign counts as much as a factor of exp(pi).
double distance(double ratio) { return std::abs(std::log(std::complex<double>(ratio))); }

/// Fraction of the distances that a slip leaves; infinite where it has no say.
double fraction_left(const OdeModel& model, const std::vector<CoefficientRatio>& ratios,
                     const Slip& slip, double slip_factor) {
  double before = 0.0, after = 0.0;
  int changed = 0;
  for (const CoefficientRatio& one : ratios) {
    const auto made = made_by(model, slip, one.equation, one.summand);
    if (!made) return std::numeric_limits<double>::infinity();
    if (std::abs(std::log(*made)) >= std::log(slip_factor)) ++changed;
    before += distance(one.ratio);
    after += distance(one.ratio / *made);
  }
  return changed >= 2 ? after / before : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<CoefficientRatio> coefficient_ratios(const OdeModel& model, const Dataset& data,
                                                 const RateWindows& windows,
                                                 double significance) {
  const Matrix measured = window_rates(data, windows);
  std::vector<CoefficientRatio> ratios;
  for (Index k = 0; k < model.dimension(); ++k) {
    Matrix terms = term_means(model, k, data, windows);
    if (terms.cols() == 0 || terms.cols() >= terms.rows() || !terms.allFinite()) continue;
    const Vector scales = terms.colwise().norm();
    if (!(scales.minCoeff() > 0.0)) continue;
    terms = terms * scales.cwiseInverse().asDiagonal();
    const Vector said = least_squares(terms, measured.col(k));
    const double rest = (measured.col(k) - terms * said).squaredNorm() /
                        static_cast<double>(terms.rows() - terms.cols());
    const Matrix inverse = solve_symmetric(terms.transpose() * terms,
                                           Matrix::Identity(terms.cols(), terms.cols()));
    const Vector variances = rest * inverse.diagonal();
    for (Index j = 0; j < terms.cols(); ++j) {
      const double nominal =
          model.equations()[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)]
              .coefficient;
      const double error = kSharedBy * std::sqrt(variances[j]);
      if (nominal != 0.0 && std::abs(said[j]) > significance * error)
        ratios.push_back({k, j, said[j] / scales[j] / nominal});
    }
  }
  return ratios;
}

std::optional<FoundSlip> slip_of_coefficients(const OdeModel& model, const Dataset& data,
                                              const RateWindows& windows,
                                              const HintOptions& options) {
  const std::vector<CoefficientRatio> ratios =
      coefficient_ratios(model, data, windows, options.significance);
  std::vector<std::pair<double, Slip>> candidates;
  for (const Slip& slip : possible_slips(model, data)) {
    if (slip.kind != HintKind::TimeUnit && slip.kind != HintKind::ChannelUnit) continue;
    const double left = fraction_left(model, ratios, slip, options.slip_factor);
    if (left <= options.slip_remainder) candidates.emplace_back(left, slip);
  }
  if (candidates.empty()) return std::nullopt;
  const double least =
      std::min_element(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return a.first < b.first;
      })->first;
  std::erase_if(candidates,
                [&](const auto& one) { return one.first > options.slip_alike * least; });
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.channels.size(), a.first) <
           std::pair(b.second.channels.size(), b.first);
  });
  FoundSlip found{candidates.front().second, Vector(), Vector()};
  for (const auto& [left, slip] : candidates)
    if (slip.channels.size() <= 1 && slip.channels != found.slip.channels)
      found.others.push_back(slip);
  return found;
}

}  // namespace lacuna
