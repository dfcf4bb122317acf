// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// A model with a state that nobody measured.
struct HiddenIdentification {
  IdentificationResult result;  ///< the hidden state is the last one
  Dataset data;                 ///< the records with the hidden state along them, reconstructed
  std::string derivative_of;    ///< the measured state whose rate showed it
};

/// Identifies a polynomial model with one state more than were measured.
///
/// The rate of a measured state x_k has to contain the hidden state h linearly. Then x_k and
/// its derivative w = dx_k/dt, with the other measured states, have a model of their own (w is
/// a state that is not measured, dx_k/dt = w an identity), which the pipeline finds for each k;
/// the simplest of those that fit is taken. h = w - sum_j g_j phi_j(x) is then chosen so that
/// the model is simplest (in_sparse_coordinates()), and its coefficients are fitted to the
/// measured states by multiple shooting. What measurements cannot say is fixed so: h has the
/// coefficient 1 in dx_k/dt. Where the simpler model fits worse, h = w is the answer. Past the
/// deadline so is that of the first state, fitted in short windows; `stages` and warnings have it.
/// @param differentiator for the derivatives of measured states. @param name of the hidden
/// state.
/// @throws ConfigError when the name is taken or the library is not polynomial; as identify().
HiddenIdentification identify_hidden(const Dataset& data, const Pipeline& pipeline,
                                     const Differentiator& differentiator,
                                     const std::string& name, const RunContext& context = {});

}  // namespace lacuna
