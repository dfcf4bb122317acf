// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/stiff_steps.hpp"

#include <cmath>

#include "parabolas.hpp"
#include "trajectories/sensitivities/implicit/radau.hpp"

namespace lacuna {
namespace {

Eigen::Map<const Matrix> slope_at(const Matrix& slopes, Index node, Index m) {
  return {slopes.col(node).data(), m, m};
}

/// The parabola through the slopes of a step at a fraction of it.
Matrix slope_inside(const Matrix& slopes, const StepGrid& grid, Index step, double fraction,
                    Index m) {
  const std::array<double, 3> weight = parabolas(fraction);
  return weight[0] * slope_at(slopes, grid.begin(step), m) +
         weight[1] * slope_at(slopes, grid.middle(step), m) +
         weight[2] * slope_at(slopes, grid.end(step), m);
}

/// Columns [d, response to parabola 0 in each equation, to 1, to 2] over a step, m x 4 m.
Matrix carried_over(const Matrix& slopes, const StepGrid& grid, Index step, double length,
                    Index m) {
  constexpr int kParts = 8;  // a fact of the method: its error falls with the fifth power
  const double h = length / kParts;
  Matrix columns = Matrix::Zero(m, 4 * m);
  columns.leftCols(m).setIdentity();
  RadauSlopes rates;
  for (int part = 0; part < kParts; ++part) {
    for (std::size_t stage = 0; stage < 3; ++stage) {
      const double fraction = (part + Radau::nodes()[stage]) / kParts;
      const std::array<double, 3> weight = parabolas(fraction);
      rates.jacobian[stage] = slope_inside(slopes, grid, step, fraction, m);
      rates.forcing[stage] = Matrix::Zero(m, 4 * m);
      for (std::size_t q = 0; q < 3; ++q)
        rates.forcing[stage]
            .middleCols((static_cast<Index>(q) + 1) * m, m)
            .diagonal()
            .setConstant(weight[q]);
    }
    columns = radau_variation(h, rates, columns);
  }
  return columns;
}

}  // namespace

bool has_stiff_steps(const Matrix& slopes, const StepGrid& grid, const Vector& length) {
  const auto m = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(slopes.rows()))));
  for (Index i = 0; i < length.size(); ++i)
    if (is_beyond_explicit_steps(slope_at(slopes, grid.begin(i), m), length[i] / kMostParts))
      return true;
  return false;
}

std::optional<Matrix> implicit_ends(Rates& rates, const StepSlots& slots,
                                    const Vector& accuracy) {
  constexpr double kSmall = 0.1;  // as of parts_for()
  // Facts of cost: Robertson's and van der Pol's (mu = 1000) models need 2 and 6 solutions a step,
  // 600 in a jump; where a search has led paths far away they are thousands.
  constexpr long kSolutions = 50, kSolutionsOfAJump = 2000;
  Matrix ends(slots.steps(), slots.states);
  RadauFlow flow(kSmall * accuracy);
  flow.allow(kSolutionsOfAJump);
  for (Index i = 0; i < slots.steps(); ++i) {
    flow.allow(flow.allowed() + kSolutions);
    const double length = slots.length(i);
    const auto drive = [&](double t, double* slot) {
      const double fraction = t / length;
      const std::array<double, 3> weight = parabolas(fraction);
      const double cubic = fraction * (fraction - 0.5) * (fraction - 1.0);
      for (Index column = slots.states; column < slots.nodes.cols(); ++column)
        slot[column] = slots.driven(i, column, weight, cubic);
    };
    Vector x = slots.nodes.row(slots.grid.begin(i)).head(slots.states).transpose();
    if (!flow.advance(rates, drive, 0.0, length, x)) return std::nullopt;
    ends.row(i) = x.transpose();
  }
  return ends;
}

StepResponses implicit_responses(const Matrix& slopes, const StepGrid& grid,
                                 const Vector& length, Index states) {
  const Index m = states;
  StepResponses out{Matrix(m * m, length.size()), Matrix(3 * m * m, length.size())};
  for (Index i = 0; i < length.size(); ++i) {
    const Matrix columns = carried_over(slopes, grid, i, length[i], m);
    out.transition.col(i) = columns.leftCols(m).reshaped();
    for (Index j = 0; j < m; ++j)
      for (Index q = 0; q < 3; ++q)
        out.response.col(i).segment(3 * m * j + m * q, m) = columns.col((q + 1) * m + j);
  }
  return out;
}

}  // namespace lacuna
