// SPDX-License-Identifier: MIT
#include "dense_solution.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/integration/butcher_tableau.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr Index kStages = 7;
using Weights = Eigen::Matrix<double, kStages, 4>;

/// Weights of the stages for the powers 1..4 of the fraction of the step: Shampine, Math. Comp.
/// 46 (1986) 135.
Weights quartic_weights() {
  Weights weights;
  weights << 1.0, -8048581381.0 / 2820520608.0, 8663915743.0 / 2820520608.0,
      -12715105075.0 / 11282082432.0,  //
      0.0, 0.0, 0.0, 0.0,              //
      0.0, 131558114200.0 / 32700410799.0, -68118460800.0 / 10900136933.0,
      87487479700.0 / 32700410799.0,  //
      0.0, -1754552775.0 / 470086768.0, 14199869525.0 / 1410260304.0,
      -10690763975.0 / 1880347072.0,  //
      0.0, 127303824393.0 / 49829197408.0, -318862633887.0 / 49829197408.0,
      701980252875.0 / 199316789632.0,  //
      0.0, -282668133.0 / 205662961.0, 2019193451.0 / 616988883.0, -1453857185.0 / 822651844.0,
      0.0, 40617522.0 / 29380423.0, -110615467.0 / 29380423.0, 69997945.0 / 29380423.0;
  return weights;
}

/// Hermite's cubic through both states and rates, in the same form.
/// @param solution weights of the step itself.
Weights cubic_weights(const Vector& solution) {
  Weights weights = Weights::Zero();
  weights.col(1) = 3.0 * solution;
  weights.col(2) = -2.0 * solution;
  weights.row(0) += Eigen::RowVector4d(1.0, -2.0, 1.0, 0.0);
  weights.row(kStages - 1) += Eigen::RowVector4d(0.0, -1.0, 1.0, 0.0);
  return weights;
}

Vector as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

/// Rates of a driven model.
class Rates {
 public:
  explicit Rates(const DrivenModel& driven)
      : compiled_(driven.model.compile()),
        signal_(driven.inputs),
        inputs_(static_cast<Index>(driven.model.inputs().size())) {}

  void operator()(double time, const Vector& state, double* rate) {
    if (inputs_.size() > 0) signal_(time, inputs_.data());
    compiled_.evaluate(time, state.data(), inputs_.data(), nullptr, rate);
  }

 private:
  CompiledModel compiled_;
  InputSignal signal_;
  Vector inputs_;
};

/// The rates at the stages of one step; the last is at its end.
Matrix stages_of(Rates& rates, double time, const Vector& state, double step) {
  const ButcherTableau& method = dormand_prince_54();
  Matrix stages(state.size(), kStages);
  for (Index s = 0; s < kStages; ++s) {
    const auto row = static_cast<std::size_t>(s);
    const Vector at = state + step * stages.leftCols(s) * as_vector(method.a[row]);
    rates(time + method.nodes[row] * step, at, stages.col(s).data());
  }
  return stages;
}

}  // namespace

Matrix dense_solution(const DrivenModel& driven, const Vector& x0, const Vector& times,
                      double relative_tolerance, Between between) {
  const ButcherTableau& method = dormand_prince_54();
  const Vector solution = as_vector(method.weights);
  const Vector error_weights = solution - as_vector(method.embedded);
  const Weights weights =
      between == Between::Quartic ? quartic_weights() : cubic_weights(solution);
  const double absolute_tolerance = std::max(1e-3 * relative_tolerance, 1e-14);
  Rates rates(driven);
  Matrix states(times.size(), x0.size());
  states.row(0) = x0.transpose();
  Vector state = x0;
  double time = times[0], step = 1e-3 * (times[1] - times[0]);
  for (Index next = 1; next < times.size();) {
    const Matrix stages = stages_of(rates, time, state, step);
    const Vector end = state + step * stages * solution;
    const Vector scale =
        relative_tolerance * state.cwiseAbs().cwiseMax(end.cwiseAbs()).array() +
        absolute_tolerance;
    const Vector error = (step * stages * error_weights).cwiseQuotient(scale);
    const double size = std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
    const double factor = std::clamp(0.9 * std::pow(std::max(size, 1e-10), -0.2), 0.2, 10.0);
    if (size < 1.0) {
      for (; next < times.size() && times[next] <= time + step; ++next) {
        const double fraction = (times[next] - time) / step;
        const Eigen::Vector4d powers(fraction, fraction * fraction, std::pow(fraction, 3),
                                     std::pow(fraction, 4));
        states.row(next) = (state + step * stages * (weights * powers)).transpose();
      }
      time += step;
      state = end;
    }
    step *= factor;
  }
  return states;
}

}  // namespace lacuna::benchmarks
