// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// How a measured quantity becomes several states: `--embed q=2`.
struct EmbeddingOrder {
  std::string state;  ///< name of a state of the dataset
  int order = 2;      ///< N: q obeys an equation of order N; -N: add N integrals
};

/// Gives a system of first order the states that were not measured.
///
/// - order N > 0: the states are q, q_d1, ..., q_d<N-1>, with dq/dt = q_d1 and so on as
///   identities (Dataset::rate_of), and the derivative of the last is the N-th of q;
/// - order -N < 0: the states are q, q_i1, ..., q_i<N>, with d(q_i1)/dt = q, d(q_i2)/dt = q_i1
/// as
///   identities; integrals start from 0 at the first sample of each record.
///
/// Every state of the result has derivatives; those that were added are marked as
/// reconstructed. All of them are from the same differentiator, computed from q itself; q and,
/// in records without derivatives, the other states and the inputs become its order 0 (see
/// with_derivatives), so keep the original dataset for simulations. Given derivatives of the
/// other states are kept. Units follow: "m" and "s" give "m/s", "m/s^2", and "m s" for the
/// integral.
/// @throws ConfigError for an unknown state, a state named twice, order 0, a name that is
/// taken;
///   DataError when a record is too short for the differentiator or unusable (check_dataset).
/// @throws ArgumentError for an order beyond 100.
Dataset embed(const Dataset& data, const std::vector<EmbeddingOrder>& orders,
              const Differentiator& differentiator);

}  // namespace lacuna
