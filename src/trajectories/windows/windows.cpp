// SPDX-License-Identifier: MIT
#include "trajectories/windows/windows.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// Follows errors from the begin of a window on.
class GrowthWalk {
 public:
  explicit GrowthWalk(const ErrorGrowth& growth) : growth_(growth) { restart(); }

  void restart() {
    product_ = Matrix::Identity(growth_.dimension, growth_.dimension);
    turn_ = 0.0;
  }

  /// Goes over one sampling interval.
  void pass(Index interval) {
    const Index m = growth_.dimension;
    const Vector row = growth_.transitions.row(interval);
    const Eigen::Map<const Matrix> phi(row.data(), m, m);
    product_ = (phi * product_).eval();
    turn_ += norm(phi - Matrix::Identity(m, m));
  }

  double size() const { return norm(product_); }
  double turn() const { return turn_; }

 private:
  double norm(const Matrix& matrix) const {
    return matrix.norm() / std::sqrt(static_cast<double>(growth_.dimension));
  }

  const ErrorGrowth& growth_;
  Matrix product_;
  double turn_ = 0.0;
};

/// First sample of the window behind one that begins at `first`.
Index window_end(Index first, Index end, const WindowLimits& limits, GrowthWalk& walk) {
  walk.restart();
  Index next = first + 1;
  for (; next < end && next - first < limits.longest; ++next) {
    walk.pass(next - 1);
    const bool within = walk.size() <= limits.growth && walk.turn() <= limits.turn;
    if (!within && next - first >= limits.shortest) break;
  }
  return next;
}

void append(WindowPlan& plan, Index first, Index next, Index end) {
  const Index samples = next - first;
  plan.push_back({first, samples, next < end ? samples : samples - 1});
}

/// A rest too short for a window of its own joins the one before it.
Index without_rest(Index next, Index end, Index shortest) {
  return end - next < shortest ? end : next;
}

void check_begins(const std::vector<Index>& begins, const char* where) {
  constexpr Index kMost = Index{1} << 40;  // a fact of memory: more samples have no room
  bool rise = begins.empty() || begins.front() >= 0;
  for (std::size_t r = 1; r < begins.size(); ++r) rise = rise && begins[r] >= begins[r - 1];
  check_argument(rise && (begins.empty() || begins.back() <= kMost), where,
                 "the begins of the records do not increase",
                 "give the first sample of each record, then the number of all samples");
}

}  // namespace

WindowPlan plan_windows(const std::vector<Index>& begins, const ErrorGrowth& growth,
                        const WindowLimits& limits) {
  check_begins(begins, "plan_windows");
  const Index intervals = begins.empty() ? 0 : begins.back() - 1;
  check_argument(growth.dimension >= 0 && growth.transitions.rows() >= intervals &&
                     growth.transitions.cols() >= growth.dimension * growth.dimension,
                 "plan_windows", "there are not the matrices of each interval");
  check_argument(limits.shortest >= 1 && limits.longest >= 1, "plan_windows",
                 "a window has no sample");
  WindowPlan plan;
  GrowthWalk walk(growth);
  for (std::size_t r = 0; r + 1 < begins.size(); ++r) {
    const Index end = begins[r + 1];
    for (Index first = begins[r]; first < end;) {
      const Index next =
          without_rest(window_end(first, end, limits, walk), end, limits.shortest);
      append(plan, first, next, end);
      first = next;
    }
  }
  return plan;
}

WindowPlan equal_windows(const std::vector<Index>& begins, Index samples) {
  check_begins(begins, "equal_windows");
  check_argument(samples > 0, "equal_windows", "a window has no sample");
  WindowPlan plan;
  for (std::size_t r = 0; r + 1 < begins.size(); ++r) {
    const Index count = begins[r + 1] - begins[r];
    const Index parts = std::max<Index>(1, (count + samples / 2) / samples);
    for (Index part = 0; part < parts; ++part)
      append(plan, begins[r] + part * count / parts, begins[r] + (part + 1) * count / parts,
             begins[r + 1]);
  }
  return plan;
}

double largest_growth(const WindowPlan& plan, const ErrorGrowth& growth) {
  double largest = 1.0;
  GrowthWalk walk(growth);
  for (const Window& window : plan) {
    walk.restart();
    for (Index i = 0; i + 1 < window.samples; ++i) {
      walk.pass(window.first + i);
      largest = std::max(largest, walk.size());
    }
  }
  return largest;
}

}  // namespace lacuna
