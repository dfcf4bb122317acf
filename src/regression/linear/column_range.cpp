// SPDX-License-Identifier: MIT
#include "regression/linear/column_range.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/parts.hpp"
#include "lacuna/core/base/error.hpp"
#include "regression/linear/row_pass.hpp"

namespace lacuna {
namespace {

// Bounds between which squares of up to 1e18 rows, and of their rounding errors, are normal.
constexpr double kSmallest = 1e-120;
constexpr double kLargest = 1e120;

struct Entry {
  Index row;
  Index column;
};

// Largest sizes of the columns, behind them row and column of the first entry that is not
// finite, or -1: numbers that a team can share.
class SlotScan {
 public:
  explicit SlotScan(Index columns) : numbers_(Vector::Zero(columns + 2)) {
    numbers_.tail(2).setConstant(-1.0);
  }

  auto largest() { return numbers_.head(numbers_.size() - 2); }
  std::optional<Entry> bad() const {
    const auto place = numbers_.tail(2);
    if (place[0] < 0.0) return std::nullopt;
    return Entry{static_cast<Index>(place[0]), static_cast<Index>(place[1])};
  }
  void set_bad(const Entry& entry) {
    numbers_.tail(2) << static_cast<double>(entry.row), static_cast<double>(entry.column);
  }
  std::span<double> numbers() { return numbers_of(numbers_); }

 private:
  Vector numbers_;
};

std::optional<Entry> first_not_finite(const MatrixMap& block, Index first_row) {
  for (Index row = 0; row < block.rows(); ++row) {
    for (Index column = 0; column < block.cols(); ++column) {
      if (!std::isfinite(block(row, column))) return Entry{first_row + row, column};
    }
  }
  return std::nullopt;
}

void scan_tile(Tile& tile, SlotScan& scan) {
  if (scan.bad()) return;
  const MatrixMap block = tile.all();
  const Vector largest = block.cwiseAbs().colwise().maxCoeff().transpose();
  scan.largest() = scan.largest().cwiseMax(largest).eval();
  if (!block.allFinite()) scan.set_bad(*first_not_finite(block, tile.first()));
}

int exponent_of(double magnitude) {
  if (magnitude == 0.0 || (magnitude > kSmallest && magnitude < kLargest)) return 0;
  return std::ilogb(magnitude);
}

class ScaledRows final : public RowSource {
 public:
  ScaledRows(const RowSource& rows, std::vector<int> exponents)
      : rows_(rows), exponents_(std::move(exponents)) {}

  Index rows() const override { return rows_.rows(); }
  Index terms() const override { return rows_.terms(); }
  Index targets() const override { return rows_.targets(); }
  std::unique_ptr<RowReader> open() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader final : public RowReader {
   public:
    explicit Reader(const ScaledRows& rows)
        : exponents_(rows.exponents_), reader_(rows.rows_.open()) {}

    void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
      reader_->read(first, theta, targets);
      scale(theta, 0);
      scale(targets, theta.cols());
    }

   private:
    void scale(Eigen::Ref<Matrix> columns, Index offset) const {
      for (Index j = 0; j < columns.cols(); ++j) {
        const int exponent = exponents_[static_cast<std::size_t>(offset + j)];
        if (exponent == 0) continue;
        columns.col(j) =
            columns.col(j).unaryExpr([=](double v) { return std::ldexp(v, -exponent); });
      }
    }

    const std::vector<int>& exponents_;
    std::unique_ptr<RowReader> reader_;
  };

  const RowSource& rows_;
  std::vector<int> exponents_;
};

}  // namespace

std::vector<int> scan_columns(const RowSource& rows, FunctionRef<std::string(Index)> name,
                              const RunContext& context) {
  const Index columns = rows.terms() + rows.targets();
  std::vector<SlotScan> slots(row_slots(rows.rows()).size(), SlotScan(columns));
  for_each_tile(rows, context, "looking for the range of terms", [&](Index slot, Tile& tile) {
    scan_tile(tile, slots[static_cast<std::size_t>(slot)]);
  });
  exchange_parts(slots.size(), context,
                 [&](std::size_t slot) { return slots[slot].numbers(); });
  Vector largest = Vector::Zero(columns);
  for (SlotScan& slot : slots) {
    if (const auto bad = slot.bad()) {
      throw DataError(name(bad->column) + ", row " + std::to_string(bad->row + 1),
                      "the value is not finite", "mend or leave out the row or the term");
    }
    largest = largest.cwiseMax(slot.largest());
  }
  std::vector<int> exponents(static_cast<std::size_t>(columns));
  std::transform(largest.begin(), largest.end(), exponents.begin(), exponent_of);
  return exponents;
}

bool squares_in_range(const Eigen::Ref<const Vector>& squares) {
  return (squares.array() > kSmallest * kSmallest && squares.array() < kLargest * kLargest)
      .all();
}

std::unique_ptr<RowSource> scale_columns(const RowSource& rows, std::vector<int> exponents) {
  return std::make_unique<ScaledRows>(rows, std::move(exponents));
}

}  // namespace lacuna
