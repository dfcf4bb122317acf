// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The measured circuits as identified by Karimov et al. 2023, Table 3: all 20 monomials up to
/// degree 3 in each equation, in V per tau.
OdeModel tl072_model();
OdeModel opa2134_model();

}  // namespace lacuna
