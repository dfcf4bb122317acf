// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// A record to be simulated.
struct RecordProblem {
  std::string name;
  OdeModel model;
  double step = 0.01;
  Index rows = 20000;
  double noise = 0.0;  ///< fraction of the rms of each state, as it is at the begin
  bool derivatives = false;
};

/// The record, simulated behind a transient.
Dataset record_of(const RecordProblem& problem);

/// The same as a NumPy array: time, states and, where they are given, derivatives. Never all of
/// it is in memory.
void write_record(const RecordProblem& problem, const std::filesystem::path& path);

/// What its columns are.
ColumnRoles file_roles(const RecordProblem& problem);

}  // namespace lacuna::benchmarks
