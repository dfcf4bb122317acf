// SPDX-License-Identifier: MIT
#include "lacuna/discrepancy/screening.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "nelder_mead.hpp"

namespace lacuna {
namespace {

/// Shapes from the unit cube, and back.
class ShapeScale {
 public:
  explicit ShapeScale(const std::vector<ShapeParameter>& shapes) : shapes_(shapes) {}

  Vector shapes(const Vector& unit) const {
    Vector result(unit.size());
    for (Index i = 0; i < unit.size(); ++i) {
      const ShapeParameter& shape = shapes_[static_cast<std::size_t>(i)];
      const double value = shape.logarithmic
                               ? shape.low * std::pow(shape.high / shape.low, unit[i])
                               : shape.low + (shape.high - shape.low) * unit[i];
      result[i] = std::clamp(value, shape.low, shape.high);
    }
    return result;
  }

  Vector unit(const Vector& shapes) const {
    Vector result(shapes.size());
    for (Index i = 0; i < shapes.size(); ++i) {
      const ShapeParameter& shape = shapes_[static_cast<std::size_t>(i)];
      const double span =
          shape.logarithmic ? std::log(shape.high / shape.low) : shape.high - shape.low;
      const double above =
          shape.logarithmic ? std::log(shapes[i] / shape.low) : shapes[i] - shape.low;
      result[i] = span > 0.0 ? std::clamp(above / span, 0.0, 1.0) : 0.0;
    }
    return result;
  }

 private:
  const std::vector<ShapeParameter>& shapes_;
};

std::span<const double> as_span(const Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// Gain less the price of the shape parameters (log n each, as BIC has it).
double net_gain(const ScreenedCandidate& screened, double log_samples) {
  return screened.gain - log_samples * static_cast<double>(screened.shapes.size());
}

}  // namespace

Screening::Screening(const Assimilation& assimilation)
    : assimilation_(assimilation), system_(assimilation) {
  const Matrix columns = system_.fitted_columns();
  if (columns.cols() > 0) {
    const Vector scale = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
    const Eigen::ColPivHouseholderQR<Matrix> factor(columns * scale.asDiagonal());
    nominal_ = factor.householderQ() * Matrix::Identity(columns.rows(), factor.rank());
  } else {
    nominal_.resize(columns.rows(), 0);
  }
  innovations_ = project(system_.innovations());
}

Vector Screening::project(const Vector& column) const {
  return column - nominal_ * (nominal_.transpose() * column);
}

Screening::Score Screening::score(const Candidate& candidate,
                                  std::span<const double> shapes) const {
  // Below this share of its length a column is one of the nominal terms, up to rounding.
  constexpr double kDistinct = 1e-10;
  const auto column = candidate_column(candidate, shapes, assimilation_, system_);
  if (!column) return {};
  const double length = column->squaredNorm();
  const double inner = column->dot(innovations_);
  const double own = length - (nominal_.transpose() * *column).squaredNorm();
  if (!(own > kDistinct * length) || length == 0.0) return {};
  const double coefficient = std::clamp(inner / own, candidate.least, candidate.most);
  return {std::max(0.0, coefficient * (2.0 * inner - coefficient * own)), coefficient};
}

ScreenedCandidate Screening::at_starts(const Candidate& candidate) const {
  ScreenedCandidate best{candidate, candidate.starts.front(), 0.0, 0.0, 0};
  for (const Vector& start : candidate.starts) {
    const Score found = score(candidate, as_span(start));
    ++best.tried;
    if (found.gain <= best.gain) continue;
    best.gain = found.gain;
    best.coefficient = found.coefficient;
    best.shapes = start;
  }
  return best;
}

void Screening::polish(ScreenedCandidate& screened) const {
  if (screened.shapes.size() == 0) return;
  constexpr int kEvaluations = 40;
  const ShapeScale scale(screened.candidate.shapes);
  int evaluations = 0;
  const auto loss = [&](const Vector& unit) {
    ++evaluations;
    return -score(screened.candidate, as_span(scale.shapes(unit))).gain;
  };
  const int budget = kEvaluations * static_cast<int>(screened.shapes.size());
  const Vector best =
      scale.shapes(nelder_mead(loss, scale.unit(screened.shapes), 0.05, budget));
  const Score found = score(screened.candidate, as_span(best));
  screened.tried += evaluations;
  if (found.gain < screened.gain) return;
  screened.gain = found.gain;
  screened.coefficient = found.coefficient;
  screened.shapes = best;
}

std::vector<ScreenedCandidate> screen(const std::vector<Candidate>& candidates,
                                      const Screening& screening, const RunContext& context) {
  constexpr std::size_t kPolished = 40;
  const double log_samples = std::log(static_cast<double>(screening.system().used()));
  const auto better = [&](const ScreenedCandidate& a, const ScreenedCandidate& b) {
    return net_gain(a, log_samples) > net_gain(b, log_samples);
  };
  std::vector<ScreenedCandidate> all;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    context.report("screening candidates",
                   static_cast<double>(i) / static_cast<double>(candidates.size()));
    all.push_back(screening.at_starts(candidates[i]));
  }
  std::stable_sort(all.begin(), all.end(), better);
  for (std::size_t i = 0; i < std::min(kPolished, all.size()); ++i) {
    context.report("searching shapes", static_cast<double>(i) / static_cast<double>(kPolished));
    screening.polish(all[i]);
  }
  std::stable_sort(all.begin(), all.end(), better);
  return all;
}

}  // namespace lacuna
