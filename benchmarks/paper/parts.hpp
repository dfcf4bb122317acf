// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "output.hpp"
#include "sources.hpp"

namespace lacuna::benchmarks {

/// A record and the two models that are identified from it.
struct Identified {
  const Source* source;
  OdeModel paper_mode;  ///< preset algorithm1 with the tolerances of the paper
  OdeModel with_irls;   ///< preset paper: the same with IRLS while minor terms are deleted
  OdeModel standard;    ///< preset algorithm1 as it is
};

std::vector<Identified> identify_all(const std::vector<Source>& sources);

/// Fig. 1: two models by the same method; the error against the step, orders 2 to 8.
void write_figure_1(Output& output);

/// Table 1 and equation (12).
void write_table_1(Output& output);

/// Table 2: extents, box volume; what the rounding of Table 1 leaves open; offset voltages.
void write_table_2(Output& output, const std::vector<Source>& sources);

/// Figs. 3 and 4: the attractors.
void write_figures_3_4(Output& output, const std::vector<Source>& sources);

/// Table 3: the 60 coefficients of each circuit, found again from its own record.
void write_table_3(Output& output, const std::vector<Identified>& identified);

/// Table 4: synchronisation with the original and with the adjusted system.
void write_table_4(Output& output, const std::vector<Source>& sources);

/// Table 5: synchronisation with the identified models, beside that of the true equations.
void write_table_5(Output& output, const std::vector<Identified>& identified);

/// Fig. 5: synchronisation errors over time.
void write_figure_5(Output& output, const std::vector<Identified>& identified);

/// Fig. 6: the record, the model running free, the model synchronised.
void write_figure_6(Output& output, const std::vector<Identified>& identified);

/// Beyond the paper: Lyapunov exponents, dimension, distances, prediction times.
void write_measures(Output& output, const std::vector<Identified>& identified);

}  // namespace lacuna::benchmarks
