// SPDX-License-Identifier: MIT
#include "map_predictions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna {
namespace {

constexpr Index kMostStarts = 4000;  // neighbours are sought among all pairs

/// Where predictions begin and how they end, row by row.
struct Predictions {
  Matrix starts;     ///< n x coordinates: states and the inputs on the way, in deviations
  Matrix ends;       ///< n x m: the samples predicted
  Matrix residuals;  ///< n x m: sample minus prediction
  Matrix gains;      ///< n x m: squared length of each row of the prediction's Jacobian
  std::vector<bool> held;
};

/// A sample that has another one so many steps later.
struct Start {
  std::size_t record;
  Index sample;
  bool held;
};

bool is_held(const std::vector<Block>& blocks, std::size_t record, Index first, Index last) {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    return block.record == record && block.first <= first && last < block.first + block.count;
  });
}

std::vector<Start> starts_of(const Dataset& data, const std::vector<Block>& blocks,
                             Index steps) {
  std::vector<Start> starts;
  const Index stride = data.samples() / kMostStarts + 1;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r)
    for (Index i = 0; i + steps < data.trajectories[r].samples(); i += stride)
      starts.push_back({r, i, is_held(blocks, r, i, i + steps)});
  return starts;
}

/// What the map makes of a sample, with its Jacobian.
struct Image {
  Vector state;
  Matrix slopes;
};

Image image_of(CompiledModel& map, const Trajectory& record, Index first, Index steps) {
  const Index m = map.dimension();
  Image image{record.states.row(first).transpose(), Matrix::Identity(m, m)};
  Vector next = image.state;
  Matrix slopes(m, m);
  for (Index i = first; i < first + steps; ++i) {
    const Vector u = record.inputs.row(i).transpose();
    map.jacobian(record.time[i], image.state.data(), u.data(), nullptr, slopes);
    map.evaluate(record.time[i], image.state.data(), u.data(), nullptr, next.data());
    image.slopes = slopes * image.slopes;
    image.state.swap(next);
  }
  return image;
}

/// Columns of deviation 1; constant ones stay as they are.
Matrix scaled(Matrix values) {
  for (Index c = 0; c < values.cols(); ++c) {
    values.col(c).array() -= values.col(c).mean();
    const double size = std::sqrt(values.col(c).squaredNorm() / double(values.rows()));
    if (size > 0.0) values.col(c) /= size;
  }
  return values;
}

Predictions predictions_of(const OdeModel& model, const Dataset& data,
                           const std::vector<Start>& starts, Index steps) {
  const auto n = static_cast<Index>(starts.size());
  const Index m = model.dimension(), p = data.input_count();
  Predictions all{Matrix(n, m + p * steps), Matrix(n, m), Matrix(n, m), Matrix(n, m), {}};
  CompiledModel map = model.compile();
  for (Index i = 0; i < n; ++i) {
    const auto& [number, sample, held] = starts[static_cast<std::size_t>(i)];
    const Trajectory& record = data.trajectories[number];
    all.starts.row(i).head(m) = record.states.row(sample);
    for (Index s = 0; s < steps; ++s)
      all.starts.row(i).segment(m + s * p, p) = record.inputs.row(sample + s);
    all.ends.row(i) = record.states.row(sample + steps);
    const Image image = image_of(map, record, sample, steps);
    all.residuals.row(i) = all.ends.row(i) - image.state.transpose();
    all.gains.row(i) = image.slopes.rowwise().squaredNorm().transpose();
    all.held.push_back(held);
  }
  all.starts = scaled(std::move(all.starts));
  return all;
}

/// The nearest other start with a finite residual; nothing where there is none.
std::optional<Index> neighbour(const Predictions& all, Index i) {
  std::optional<Index> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < all.starts.rows(); ++j) {
    if (j == i || !all.residuals.row(j).allFinite()) continue;
    const double distance = (all.starts.row(j) - all.starts.row(i)).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = j;
  }
  return nearest;
}

/// Means over the predictions of the blocks, one entry for each state.
struct Means {
  explicit Means(Index m)
      : squares(Vector::Zero(m)),
        apart(squares),
        ends_apart(squares),
        gain(squares),
        first(squares),
        second(squares) {}
  Vector squares;     ///< r^2
  Vector apart;       ///< (r - r of the neighbour)^2 / 2
  Vector ends_apart;  ///< the same of the samples
  Vector gain;        ///< |Df|^2
  Vector first, second;
  Index count = 0;

  Vector variance() const {
    return (second / double(count) - (first / double(count)).cwiseAbs2()).cwiseMax(0.0);
  }
};

void add(const Predictions& all, Index i, Index nearest, Means& means) {
  const auto half_square = [](const auto& a, const auto& b) {
    return (0.5 * (a - b).cwiseAbs2()).transpose();
  };
  means.squares += all.residuals.row(i).cwiseAbs2().transpose();
  means.apart += half_square(all.residuals.row(i), all.residuals.row(nearest));
  means.ends_apart += half_square(all.ends.row(i), all.ends.row(nearest));
  means.gain += all.gains.row(i).transpose();
  means.first += all.ends.row(i).transpose();
  means.second += all.ends.row(i).cwiseAbs2().transpose();
  ++means.count;
}

PredictionError error_of(const std::string& state, const Means& means, Index k, Index steps,
                         const ValidationOptions& options) {
  constexpr double kVarianceOfNeighbours = 0.25;  // of the variance: half of the deviation
  const double count = static_cast<double>(means.count);
  const double variance = means.variance()[k];
  PredictionError result{
      .state = state,
      .error = std::sqrt(means.squares[k] / count),
      .noise = std::sqrt(means.apart[k] / count),
      .noise_estimated = means.ends_apart[k] / count < kVarianceOfNeighbours * variance,
      .motion = std::sqrt(variance),
      .freedom = count / static_cast<double>(steps)};
  const double sure =
      1.0 + options.noise_slack + options.scatter / std::sqrt(2.0 * result.freedom);
  const double bound = result.noise * std::sqrt(1.0 + means.gain[k] / count);
  if (result.error > sure * result.noise && result.error <= sure * bound) {
    result.noise = bound;
    result.noise_estimated = false;
  }
  return result;
}

}  // namespace

PredictionTest predict_map(const OdeModel& model, const Dataset& data,
                           const std::vector<Block>& blocks, Index steps,
                           const ValidationOptions& options) {
  const Predictions all = predictions_of(model, data, starts_of(data, blocks, steps), steps);
  PredictionTest test{.horizon = static_cast<double>(steps)};
  Means means(model.dimension());
  for (Index i = 0; i < all.starts.rows(); ++i) {
    if (!all.held[static_cast<std::size_t>(i)]) continue;
    ++test.windows;
    const bool finite = all.residuals.row(i).allFinite();
    if (!finite) ++test.lost;
    const std::optional<Index> nearest = finite ? neighbour(all, i) : std::nullopt;
    if (nearest) add(all, i, *nearest, means);
  }
  if (means.count == 0) return test;
  for (Index k = 0; k < model.dimension(); ++k)
    test.states.push_back(
        error_of(model.states()[static_cast<std::size_t>(k)].name, means, k, steps, options));
  return test;
}

}  // namespace lacuna
