// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {
namespace {

class MatrixRows final : public RowSource {
 public:
  MatrixRows(Matrix theta, Matrix targets)
      : theta_(std::move(theta)), targets_(std::move(targets)) {}

  Index rows() const override { return theta_.rows(); }
  Index terms() const override { return theta_.cols(); }
  Index targets() const override { return targets_.cols(); }
  std::unique_ptr<RowReader> open() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader final : public RowReader {
   public:
    explicit Reader(const MatrixRows& rows) : rows_(rows) {}

    void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
      theta = rows_.theta_.middleRows(first, theta.rows());
      targets = rows_.targets_.middleRows(first, targets.rows());
    }

   private:
    const MatrixRows& rows_;
  };

  Matrix theta_;
  Matrix targets_;
};

}  // namespace

std::shared_ptr<const RowSource> make_row_source(Matrix theta, Matrix targets) {
  if (theta.rows() != targets.rows()) {
    throw ArgumentError("make_row_source",
                        "terms have " + std::to_string(theta.rows()) + " rows, targets " +
                            std::to_string(targets.rows()),
                        "give both for the same samples");
  }
  return std::make_shared<MatrixRows>(std::move(theta), std::move(targets));
}

std::shared_ptr<const RowSource> kept_in_memory(std::shared_ptr<const RowSource> source,
                                                Index most_bytes) {
  check_argument(source != nullptr, "kept_in_memory", "no rows are given");
  const Index row_bytes = (source->terms() + source->targets()) * Index{sizeof(double)};
  if (source->rows() * row_bytes > most_bytes) return source;
  Matrix theta(source->rows(), source->terms()), targets(source->rows(), source->targets());
  source->open()->read(0, theta, targets);
  return make_row_source(std::move(theta), std::move(targets));
}

}  // namespace lacuna
