// SPDX-License-Identifier: MIT
#include "regression/linear/weighted_rows.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

class WeightedRows final : public RowSource {
 public:
  WeightedRows(const RowSource& rows, FittedEquation equation, WeightFunction weights)
      : rows_(rows), equation_(std::move(equation)), weights_(std::move(weights)) {}

  Index rows() const override { return rows_.rows(); }
  Index terms() const override { return static_cast<Index>(equation_.active.size()); }
  Index targets() const override { return 1; }
  std::unique_ptr<RowReader> open() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader final : public RowReader {
   public:
    explicit Reader(const WeightedRows& source)
        : source_(source), reader_(source.rows_.open()) {}

    void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
      const Index count = theta.rows();
      make_room(count);
      reader_->read(first, theta_.topRows(count), targets_.topRows(count));
      const auto roots = square_roots_of_weights(first, count);
      const auto& active = source_.equation_.active;
      for (Index j = 0; j < theta.cols(); ++j) {
        const Index term = active[static_cast<std::size_t>(j)];
        theta.col(j) = theta_.col(term).head(count).cwiseProduct(roots);
      }
      targets.col(0) = targets_.col(source_.equation_.target).head(count).cwiseProduct(roots);
    }

   private:
    void make_room(Index count) {
      if (theta_.rows() >= count) return;
      theta_.resize(count, source_.rows_.terms());
      targets_.resize(count, source_.rows_.targets());
      residuals_.resize(count);
      weights_.resize(count);
    }

    Eigen::Ref<const Vector> square_roots_of_weights(Index first, Index count) {
      auto residuals = residuals_.head(count);
      auto weights = weights_.head(count);
      equation_residuals(source_.equation_, theta_.topRows(count), targets_.topRows(count),
                         residuals);
      source_.weights_(residuals, weights);
      if (!(weights.array() >= 0.0).all() || !weights.allFinite()) reject(first, weights);
      weights = weights.cwiseSqrt();
      return weights;
    }

    [[noreturn]] static void reject(Index first, const Eigen::Ref<const Vector>& weights) {
      Index i = 0;
      while (weights[i] >= 0.0 && std::isfinite(weights[i])) ++i;
      throw ArgumentError(
          "row " + std::to_string(first + i + 1),
          "the weight " + std::to_string(weights[i]) + " is negative or not finite",
          "give a weight function that is finite for every residual");
    }

    const WeightedRows& source_;
    std::unique_ptr<RowReader> reader_;
    Matrix theta_;
    Matrix targets_;
    Vector residuals_;
    Vector weights_;
  };

  const RowSource& rows_;
  FittedEquation equation_;
  WeightFunction weights_;
};

}  // namespace

void equation_residuals(const FittedEquation& equation, const Eigen::Ref<const Matrix>& theta,
                        const Eigen::Ref<const Matrix>& targets, Eigen::Ref<Vector> residuals) {
  residuals = targets.col(equation.target);
  for (std::size_t j = 0; j < equation.active.size(); ++j) {
    residuals -= equation.coefficients[static_cast<Index>(j)] * theta.col(equation.active[j]);
  }
}

std::unique_ptr<RowSource> make_weighted_rows(const RowSource& rows, FittedEquation equation,
                                              WeightFunction weights) {
  return std::make_unique<WeightedRows>(rows, std::move(equation), std::move(weights));
}

}  // namespace lacuna
