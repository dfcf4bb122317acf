// SPDX-License-Identifier: MIT
#include "unused_columns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/text.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/statistics/significance.hpp"

namespace lacuna {
namespace {

Matrix input_means(const Dataset& data, const RateWindows& windows) {
  return window_means(data, windows, data.input_count(),
                      [](const Trajectory& record, Index i, double* out) {
                        for (Index k = 0; k < record.inputs.cols(); ++k)
                          out[k] = record.inputs(i, k);
                      });
}

/// States, inputs, 1 and t in each window.
Matrix plain_means(const Dataset& data, const RateWindows& windows) {
  const Index states = data.state_count(), inputs = data.input_count();
  return window_means(data, windows, states + inputs + 2,
                      [&](const Trajectory& record, Index i, double* out) {
                        for (Index k = 0; k < states; ++k) *out++ = record.states(i, k);
                        for (Index k = 0; k < inputs; ++k) *out++ = record.inputs(i, k);
                        *out++ = 1.0;
                        *out = record.time[i];
                      });
}

/// What columns leave of others: an orthogonal projection, columns scaled to unit norm.
Matrix without(Matrix columns, const Matrix& others) {
  for (Index k = 0; k < columns.cols(); ++k)
    if (columns.col(k).norm() > 0.0) columns.col(k).normalize();
  return others - columns * least_squares(columns, others);
}

/// Correlations of a series with itself, for distances up to a quarter of its length.
Vector autocorrelation(const Vector& values) {
  const Index n = values.size(), lags = n / 4 + 1;
  Vector result(lags);
  for (Index lag = 0; lag < lags; ++lag)
    result[lag] = values.head(n - lag).dot(values.tail(n - lag)) / values.squaredNorm();
  return result;
}

/// Number of independent values in two series, for their correlation (Bartlett).
double independent_values(const Vector& a, const Vector& b) {
  const double sum = autocorrelation(a).dot(autocorrelation(b));
  return static_cast<double>(a.size()) / std::max(1.0, 2.0 * sum - 1.0);
}

/// What one column says of one equation.
struct Finding {
  Index column = 0;
  double fraction = 0.0;     ///< of the disagreement
  double sigma = 0.0;        ///< significance
  double coefficient = 0.0;  ///< in the equation
};

/// @param lacking what an equation lacks; @param columns candidates; @param noise variance of
/// the noise in `lacking`.
Finding best_column(const Vector& lacking, const Matrix& columns, double noise, double tried) {
  Finding best;
  for (Index j = 0; j < columns.cols(); ++j) {
    const Vector column = columns.col(j);
    if (column.squaredNorm() == 0.0) continue;
    const double along = column.dot(lacking), total = lacking.squaredNorm();
    const double gain = along * along / column.squaredNorm();
    const double signal = std::max(total - noise * static_cast<double>(lacking.size()), gain);
    if (gain / signal <= best.fraction) continue;
    const double rest = std::max(1.0 - gain / total, 1e-12);
    const double coefficient = along / column.squaredNorm();
    const Vector unexplained = lacking - coefficient * column;
    const double deviance = -independent_values(unexplained, column) * std::log(rest);
    best = {j, gain / signal, sigma_of_gain(deviance, 1.0, tried), coefficient};
  }
  return best;
}

/// Norm of the deviations from the mean.
double deviation(const Vector& values) {
  return (values.array() - values.mean()).matrix().norm();
}

/// Whether a column is the measured rate, as an acceleration recorded beside the speed is.
bool is_rate_itself(const Vector& column, const Vector& rate, double apart) {
  const double size = column.squaredNorm() + rate.squaredNorm();
  return (column - rate).squaredNorm() < apart * apart * size;
}

}  // namespace

std::vector<Hint> unused_column_hints(const OdeModel& model, const BoundRecords& records,
                                      const Dataset& unused, const RateWindows& windows,
                                      const HintOptions& options) {
  const Dataset& data = records.data;
  const Matrix columns = input_means(unused, windows);
  const Matrix measured = window_rates(data, windows);
  const Matrix lacking = measured - model_rates(model, data, windows);
  const Matrix plain = plain_means(data, windows);
  const Vector noise = rate_noise(records, windows);
  std::vector<Hint> hints;
  for (Index k = 0; k < model.dimension(); ++k) {
    if (identity_of(model, k) || !lacking.col(k).allFinite()) continue;
    const Matrix terms = term_means(model, k, data, windows);
    if (!terms.allFinite()) continue;
    Matrix known(terms.rows(), terms.cols() + plain.cols());
    known << terms, plain;
    Matrix left = without(known, columns);
    for (Index j = 0; j < left.cols(); ++j)
      // A reference that the states follow, or the rate itself, is no input of its own.
      if (left.col(j).norm() <= options.column_own * deviation(columns.col(j)) ||
          is_rate_itself(columns.col(j), measured.col(k), options.column_rate))
        left.col(j).setZero();
    const Finding best = best_column(without(known, lacking.col(k)), left, noise[k],
                                     static_cast<double>(columns.cols() * model.dimension()));
    if (best.fraction < options.column_fraction || best.sigma < options.significance) continue;
    const std::string& name = unused.inputs[static_cast<std::size_t>(best.column)].name;
    const std::string& state = model.states()[static_cast<std::size_t>(k)].name;
    hints.push_back({HintKind::UnusedColumn,
                     "column " + name + ", which is not in the model, explains " +
                         format_number(100.0 * best.fraction, 3) +
                         " % of the disagreement in d" + state + "/dt",
                     "add " + name + " to the model as an input, with a term " + name + " of " +
                         "about " + format_number(best.coefficient, 2) + " in d" + state +
                         "/dt",
                     Withheld::Names});
  }
  return hints;
}

}  // namespace lacuna
