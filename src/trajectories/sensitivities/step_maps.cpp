// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/step_maps.hpp"

namespace lacuna {

StepMaps::StepMaps(Rates& rates, const StepScheme& scheme)
    : tableau_(*scheme.tableau),
      dimension_(rates.dimension()),
      columns_(rates.columns()),
      influence_(tableau_.nodes.size(), Matrix(kBlock, dimension_ * dimension_)),
      moved_(influence_),
      transitions_(kBlock, dimension_ * dimension_),
      responses_(kBlock, dimension_ * columns_) {
  const Index rows = kBlock * tableau_.stages();
  slots_.resize(rows, rates.slots());
  jacobian_.resize(rows, static_cast<Index>(rates.jacobian_places().size()));
  partials_.resize(rows, static_cast<Index>(rates.column_places().size()));
}

void StepMaps::evaluate(Rates& rates, const StageSignals& signals,
                        const std::vector<Matrix>& states, Index first, Index count) {
  evaluate_rates(rates, signals, states, first, count);
  transitions_.topRows(count).setZero();
  for (Index k = 0; k < dimension_; ++k)
    transitions_.col(k * dimension_ + k).head(count).setOnes();
  responses_.topRows(count).setZero();
  for (Index a = tableau_.stages() - 1; a >= 0; --a) {
    adjoint(a, signals.lengths.segment(first, count), rates.jacobian_places());
    transitions_.topRows(count) += moved_[static_cast<std::size_t>(a)].topRows(count);
    respond(a, count, rates.column_places());
  }
}

void StepMaps::evaluate_rates(Rates& rates, const StageSignals& signals,
                              const std::vector<Matrix>& states, Index first, Index count) {
  const auto stages = static_cast<Index>(tableau_.nodes.size());
  for (Index a = 0; a < stages; ++a) {
    auto block = slots_.middleRows(a * count, count);
    const auto stage = static_cast<std::size_t>(a);
    block.leftCols(dimension_) = states[stage].middleRows(first, count);
    rates.fill_signals(signals.stages[stage].middleRows(first, count), block);
  }
  const Index rows = stages * count;
  rates.derivatives(slots_.topRows(rows), jacobian_.topRows(rows), partials_.topRows(rows));
}

/// Lambda_a and Lambda_a J_a.
void StepMaps::adjoint(Index stage, const Eigen::Ref<const Vector>& lengths,
                       const std::vector<MatrixPlace>& places) {
  const Index count = lengths.size();
  auto influence = influence_[static_cast<std::size_t>(stage)].topRows(count);
  influence.setZero();
  for (Index k = 0; k < dimension_; ++k)
    influence.col(k * dimension_ + k)
        .setConstant(tableau_.weights[static_cast<std::size_t>(stage)]);
  for (std::size_t d = static_cast<std::size_t>(stage) + 1; d < moved_.size(); ++d) {
    const double weight = tableau_.a[d][static_cast<std::size_t>(stage)];
    if (weight != 0.0) influence += weight * moved_[d].topRows(count);
  }
  influence.array().colwise() *= lengths.array();
  auto moved = moved_[static_cast<std::size_t>(stage)].topRows(count);
  moved.setZero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto entry =
        jacobian_.col(static_cast<Index>(i)).segment(stage * count, count).array();
    for (Index row = 0; row < dimension_; ++row)
      moved.col(places[i].column * dimension_ + row).array() +=
          influence.col(places[i].row * dimension_ + row).array() * entry;
  }
}

/// Adds Lambda_a df_a/dp to the responses.
void StepMaps::respond(Index stage, Index count, const std::vector<MatrixPlace>& places) {
  const auto influence = influence_[static_cast<std::size_t>(stage)].topRows(count);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto entry =
        partials_.col(static_cast<Index>(i)).segment(stage * count, count).array();
    for (Index row = 0; row < dimension_; ++row)
      responses_.col(places[i].column * dimension_ + row).head(count).array() +=
          influence.col(places[i].row * dimension_ + row).array() * entry;
  }
}

}  // namespace lacuna
