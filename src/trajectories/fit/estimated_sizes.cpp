// SPDX-License-Identifier: MIT
#include "estimated_sizes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "regression/linear/row_fold.hpp"
#include "trajectories/shooting/block_minimum.hpp"

namespace lacuna {
namespace {

/// Degrees of freedom beyond which Student's quantile is the normal one to 1e-6.
constexpr double kKnown = 1e6;

/// R^-1 of an upper triangle, a column that is 0 (its row is, too) left out.
Matrix inverse_of(const Eigen::Ref<const Matrix>& triangle) {
  std::vector<Index> seen;
  for (Index j = 0; j < triangle.cols(); ++j)
    if (triangle.col(j).norm() > 0.0) seen.push_back(j);
  const Matrix kept = triangle(seen, seen);
  Matrix inverse = Matrix::Zero(triangle.rows(), triangle.cols());
  for (std::size_t j = 0; j < seen.size(); ++j)
    inverse(seen, seen[j]) = solve_determined(
        kept, Vector::Unit(kept.rows(), static_cast<Index>(j)));
  return inverse;
}

/// Products of the rows of one channel in coordinates in which those of all channels together are
/// orthonormal.
struct ChannelProducts {
  Matrix global;            ///< G x G, V'V
  std::vector<Matrix> own;  ///< of each record: U'U, U by its initial states and parameters
  std::vector<Matrix> both; ///< of each record: V'U

  double trace() const {
    double sum = global.trace();
    for (const Matrix& one : own) sum += one.trace();
    return sum;
  }
};

/// tr(H_cd H_dc).
double product_trace(const ChannelProducts& c, const ChannelProducts& d) {
  double sum = c.global.cwiseProduct(d.global).sum();
  for (std::size_t r = 0; r < c.own.size(); ++r)
    sum += c.own[r].cwiseProduct(d.own[r]).sum() + 2.0 * c.both[r].cwiseProduct(d.both[r]).sum();
  return sum;
}

/// V_c' H_cd V_d.
Matrix product(const ChannelProducts& c, const ChannelProducts& d) {
  Matrix sum = c.global * d.global;
  for (std::size_t r = 0; r < c.both.size(); ++r)
    sum.noalias() += c.both[r] * d.both[r].transpose();
  return sum;
}

/// The rows of the kept numbers, the others held, as a triangle.
Matrix kept_triangle(const FitLinear& linear, const std::vector<Index>& kept) {
  RowFold fold(static_cast<Index>(kept.size()));
  const Index g = linear.reduced.cols() - 1;
  fold.add(linear.reduced.topLeftCorner(g, g)(Eigen::all, kept).transpose());
  return *fold.finish();
}

/// @param inverse R^-1 of the kept numbers.
std::vector<ChannelProducts> products_of(FitEngine& engine, const FitUnknowns& unknowns,
                                         const FitMinimum& minimum, const FitLinear& linear,
                                         const std::vector<Index>& kept,
                                         const Matrix& inverse) {
  const std::vector<Index> order = column_order(engine, unknowns);
  const auto g = static_cast<Index>(unknowns.global.size());
  const Index locals = static_cast<Index>(order.size()) - g, k = inverse.cols();
  const auto records = static_cast<std::size_t>(engine.records.records());
  std::vector<ChannelProducts> all(
      static_cast<std::size_t>(engine.count()),
      {Matrix::Zero(k, k), std::vector<Matrix>(records, Matrix::Zero(locals, locals)),
       std::vector<Matrix>(records, Matrix::Zero(k, locals))});
  for (std::size_t r = 0; r < records; ++r) {
    const Matrix& triangle = linear.records[r];
    const Matrix own_inverse = inverse_of(triangle.topLeftCorner(locals, locals));
    const Matrix between = triangle.block(0, locals, locals, g)(Eigen::all, kept);
    const auto visit = [&](Index, const Matrix& rows, const Vector&) {
      const Matrix sorted = rows(Eigen::all, order);
      const Matrix u = sorted.leftCols(locals) * own_inverse;
      const Matrix v = (sorted.rightCols(g)(Eigen::all, kept) - u * between) * inverse;
      for (Index c = 0; c < rows.rows(); ++c) {
        ChannelProducts& one = all[static_cast<std::size_t>(c)];
        one.global.noalias() += v.row(c).transpose() * v.row(c);
        one.own[r].noalias() += u.row(c).transpose() * u.row(c);
        one.both[r].noalias() += v.row(c).transpose() * u.row(c);
      }
    };
    sensitivities(engine, minimum.point, minimum.path, {}, static_cast<Index>(r), visit);
  }
  return all;
}

/// Channels whose size is estimated and that have values.
std::vector<Index> estimated_channels(const FitEngine& engine) {
  std::vector<Index> channels;
  for (Index c = 0; c < engine.count(); ++c) {
    const auto& law = engine.laws[static_cast<std::size_t>(c)];
    const Matrix& known = engine.records.deviations;
    const bool is_given = law ? (!has_constant(law->law().form) || law->law().constant) &&
                                    (!has_fraction(law->law().form) || law->law().fraction)
                              : known.size() > 0 && known.col(c).maxCoeff() > 0.0;
    if (!is_given && engine.records.valid.col(c).sum() > 0.0) channels.push_back(c);
  }
  return channels;
}

/// Covariance of the logarithms of the squared sizes; empty where it is not positive.
Matrix size_covariance(const FitEngine& engine, const std::vector<Index>& channels,
                       const std::vector<ChannelProducts>& products) {
  const auto count = static_cast<Index>(channels.size());
  Matrix information(count, count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j) {
      const auto c = channels[static_cast<std::size_t>(i)],
                 d = channels[static_cast<std::size_t>(j)];
      const ChannelProducts& one = products[static_cast<std::size_t>(c)];
      information(i, j) = 0.5 * product_trace(one, products[static_cast<std::size_t>(d)]);
      if (c == d)
        information(i, j) += 0.5 * engine.records.valid.col(c).sum() - one.trace();
    }
  const Eigen::LLT<Matrix> factor(information);
  if (factor.info() != Eigen::Success) return {};
  return factor.solve(Matrix::Identity(count, count));
}

/// Channels with a size that is estimated: their products, the variance of each over that of the
/// fit, and the covariance of the logarithms of the variances.
struct SizedChannels {
  std::vector<const ChannelProducts*> products;
  Vector ratio;
  Matrix covariance;
};

/// What the covariance of the kept numbers grows by, in coordinates in which it is 1.
Matrix growth_of(const SizedChannels& sized) {
  const std::vector<const ChannelProducts*>& products = sized.products;
  Matrix growth = Matrix::Zero(products[0]->global.rows(), products[0]->global.cols());
  for (std::size_t i = 0; i < products.size(); ++i) {
    const auto row = static_cast<Index>(i);
    growth += (sized.ratio[row] - 1.0 + 2.0 * sized.covariance(row, row)) * products[i]->global;
    for (std::size_t j = 0; j < products.size(); ++j)
      growth -= 2.0 * sized.covariance(row, static_cast<Index>(j)) *
                product(*products[i], *products[j]);
  }
  return growth;
}

/// Degrees of freedom of the variance of each kept number: 2 over the variance of its logarithm.
/// @param otherwise those of a number whose variance is beyond doubles.
Vector satterthwaite(const SizedChannels& sized, const Matrix& inverse, double otherwise) {
  Matrix parts(inverse.rows(), sized.ratio.size());
  Vector whole = inverse.rowwise().squaredNorm();
  for (std::size_t i = 0; i < sized.products.size(); ++i) {
    const auto column = static_cast<Index>(i);
    const Vector part =
        (inverse * sized.products[i]->global).cwiseProduct(inverse).rowwise().sum();
    whole += (sized.ratio[column] - 1.0) * part;
    parts.col(column) = sized.ratio[column] * part;
  }
  const Vector variance = (parts * sized.covariance).cwiseProduct(parts).rowwise().sum();
  Vector freedom(inverse.rows());
  for (Index k = 0; k < freedom.size(); ++k) {
    const double own = 2.0 * whole[k] * whole[k] / variance[k];
    freedom[k] = std::isnan(own) ? otherwise : std::clamp(own, 1.0, kKnown);
  }
  return freedom;
}

}  // namespace

EstimatedSizes estimated_sizes(FitEngine& engine, const FitUnknowns& unknowns,
                               const FitMinimum& minimum, const FitLinear& linear,
                               const std::vector<Index>& kept) {
  const auto g = static_cast<Index>(unknowns.global.size());
  const double freedom = degrees_of_freedom(engine, unknowns);
  EstimatedSizes found{Vector::Constant(g, freedom), Matrix::Zero(g, g)};
  const std::vector<Index> channels = estimated_channels(engine);
  if (channels.empty() || kept.empty()) return found;
  const Matrix inverse = inverse_of(kept_triangle(linear, kept));
  const std::vector<ChannelProducts> all =
      products_of(engine, unknowns, minimum, linear, kept, inverse);
  SizedChannels sized{{}, Vector(static_cast<Index>(channels.size())),
                      size_covariance(engine, channels, all)};
  if (sized.covariance.size() == 0) return found;
  const double part = freedom / engine.records.valid.sum();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const ChannelProducts& one = all[static_cast<std::size_t>(channels[i])];
    const double values = engine.records.valid.col(channels[i]).sum();
    sized.products.push_back(&one);
    sized.ratio[static_cast<Index>(i)] = part * values / std::max(1.0, values - one.trace());
  }
  found.freedom(kept) = satterthwaite(sized, inverse, freedom);
  const Matrix added = inverse * growth_of(sized) * inverse.transpose();
  if (added.allFinite()) found.added(kept, kept) = added;
  return found;
}

}  // namespace lacuna
