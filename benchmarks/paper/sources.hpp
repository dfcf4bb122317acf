// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "output.hpp"
#include "printed.hpp"

namespace lacuna::benchmarks {

/// The paper's sampling: 0.1 s of circuit time at 1e-5 s, in units of tau.
inline constexpr double kStep = 0.1;
inline constexpr Index kSamples = 10000;

/// A system of the paper with its record.
struct Source {
  std::string name;
  std::string stem;                        ///< for file names
  std::string origin;                      ///< what stands for it here
  Dataset record;                          ///< in units of `unit`, time in tau
  double unit = 1.0;                       ///< V
  std::optional<OdeModel> truth = {};      ///< the equations behind the record, same units
  const PrintedSystem* printed = nullptr;  ///< null for a record the paper does not have
  std::optional<Matrix> clean = {};        ///< the states without noise, where it was added
};

/// The six systems of Tables 2, 4 and 5 in their order, then the TL072 circuit as a converter
/// of 16 bits sees it with 1 mV noise. What ngspice would make is left out, with a note in the
/// output, where it is not installed.
std::vector<Source> make_sources(Output& output);

/// The model for states in other units: x_new = factor x. Right for monomials.
OdeModel rescaled(const OdeModel& model, double factor);

/// Synchronised as in the paper: K couples x only with k = 1, one step per sample.
SyncResult paper_sync(const OdeModel& model, const Dataset& record,
                      const Integrator& integrator);

/// With the classical method of order 4.
SyncResult paper_sync(const OdeModel& model, const Dataset& record);

}  // namespace lacuna::benchmarks
