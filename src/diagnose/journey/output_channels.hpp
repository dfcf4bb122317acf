// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// An output that is a state in another unit, factor * state + offset, by which alone that state is
/// measured.
struct StateImage {
  std::string output, state;
  double factor = 1.0;  ///< not 0
  double offset = 0.0;
};

/// Those in the records; none where records bring derivatives, which are not those of states.
std::vector<StateImage> images_of_states(const OdeModel& model, const Dataset& view);

/// The model without the outputs that are images.
OdeModel without_images(const OdeModel& model, const std::vector<StateImage>& images);

/// A view of the model without images: the states themselves in place of their images, with the
/// marks of these, and what the model makes of them anew.
Dataset with_states_of(const std::vector<StateImage>& images, const OdeModel& model,
                       const Dataset& view);

/// The model with a state for each output that is a formula and has a column in the records:
/// is_formula_channel(), with the formula as its equation, in the order of the columns.
OdeModel with_output_channels(const OdeModel& model, const Dataset& view);

/// The opposite: a model with such states, perhaps with effects and their memory, with the
/// outputs and the start of the nominal model again.
OdeModel without_output_channels(const OdeModel& model, const OdeModel& nominal);

}  // namespace lacuna
