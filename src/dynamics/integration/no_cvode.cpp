// SPDX-License-Identifier: MIT
#include "dynamics/integration/cvode.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

std::string Cvode::unavailable() { return "built without SUNDIALS"; }

std::unique_ptr<Stepper> Cvode::make_stepper(Index) const {
  throw ConfigError("integrator cvode", unavailable(),
                    "install SUNDIALS and build again, or use dopri5");
}

}  // namespace lacuna
