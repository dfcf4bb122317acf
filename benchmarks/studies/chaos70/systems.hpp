// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::chaos70 {

/// One of the flows: its equations and where its records lie.
struct System {
  std::string name;
  OdeModel model;
  std::string records;  ///< path of the training trajectories
};

/// All systems of a folder with systems.json and train/. @throws FileError.
std::vector<System> read_systems(const std::string& folder);

/// The training trajectories with white noise of `percent` per cent of the rms over all samples
/// and components of each trajectory.
Dataset noisy_records(const System& system, double percent, std::uint64_t seed);

/// |Xi - Xi_hat| / |Xi|, spectral norms of the matrices states x monomials to degree 4.
double coefficient_error(const OdeModel& truth, const OdeModel& found);

/// Terms of the truth that are missing in the model, terms it has too many.
struct Structure {
  int missing = 0;
  int extra = 0;
};
Structure compare(const OdeModel& truth, const OdeModel& found);

}  // namespace lacuna::chaos70
