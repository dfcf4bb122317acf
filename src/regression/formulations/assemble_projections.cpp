// SPDX-License-Identifier: MIT
#include "assemble_projections.hpp"

#include "lacuna/model/equations/ode_model.hpp"
#include "non_finite_error.hpp"
#include "records/channels/shown_holds.hpp"
#include "regression/formulations/projected_rows.hpp"

namespace lacuna {

LeastSquaresSystem assemble_projections(const Dataset& data, const TermLibrary& library,
                                        const std::vector<Projection>& projections,
                                        const RunContext& context) {
  const auto rows =
      std::make_shared<const ProjectedRows>(library, data.trajectories, projections,
                                            held_inputs(data));
  try {
    return LeastSquaresSystem(kept_in_memory(rows), library.names(),
                              left_hand_sides(names_of(data.states), Evolution::Flow), context);
  } catch (const DataError&) {
    if (const auto entry = rows->samples().find_non_finite()) throw_non_finite(*entry);
    throw;
  }
}

}  // namespace lacuna
