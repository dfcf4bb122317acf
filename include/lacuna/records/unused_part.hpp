// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"
#include "lacuna/model/ode_model.hpp"

namespace lacuna {

/// Records without the inputs that follow those of the model: columns that it does not know
/// (see Columns::All of read_records()).
Dataset used_part(const OdeModel& model, Dataset data);

/// The same records with only these columns as inputs; their units, n x 0 where there are none.
Dataset unused_part(const OdeModel& model, const Dataset& data);

}  // namespace lacuna
