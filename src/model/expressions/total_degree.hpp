// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// Degree of a formula in all its variables together: of a polynomial its total degree, with
/// negative powers counted as positive ones (x/y: 2); any other function of variables counts as
/// one variable (x*sin(x*y): 2), a constant as 0.
int total_degree(const Expression& expression);

}  // namespace lacuna
