// SPDX-License-Identifier: MIT
// Also of a library that is built without SUNDIALS: the integrator says so when it is run.
#include "dynamics/integration/cvode.hpp"

namespace lacuna {

Stage<Integrator> cvode(const CvodeOptions& options) { return Cvode(options); }

}  // namespace lacuna
