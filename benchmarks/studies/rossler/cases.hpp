// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna::benchmarks {

/// One composition of stages; labels as in the registry.
struct Composition {
  std::string filter, regressor, pruner;
  std::string derivative;  ///< a differentiator, or "exact" for the derivatives of the record
  Pipeline pipeline;
};

/// Every filter x regressor x pruner x derivative that the registry has, over monomials up to
/// degree 3.
std::vector<Composition> all_compositions(const Registry& registry);

/// How the data of a cell are made.
struct Condition {
  Index samples = 0;
  double noise = 0.0;  ///< standard deviation of white noise relative to each column's own
  int draws = 1;       ///< repetitions with noise of different seeds
};

/// The conditions of the study: noise 0, 0.1 and 1 %, 1000 and 4000 samples.
std::vector<Condition> all_conditions();

/// A Rossler record (a = b = 0.2, c = 5.7, h = 0.05) on the attractor with exact derivatives,
/// both with white noise of the condition.
Dataset noisy_record(const Condition& condition, std::uint64_t seed);

/// The same record without its derivatives, for the differentiators.
Dataset without_derivatives(Dataset record);

}  // namespace lacuna::benchmarks
