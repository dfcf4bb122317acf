// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <utility>

#include "lacuna/model/equations/ode_model.hpp"
#include "report/plot/markup.hpp"

namespace lacuna {

/// A formula as presentation MathML, in the notation of textbooks: fractions, roots, powers,
/// |x|, sgn.
Markup to_mathml(const Expression& expression);

/// Terms by equation and canonical name.
using TermNames = std::set<std::pair<Index, std::string>>;

/// The equations of a model, one under the other; coefficients to the digits of their
/// intervals, 6 without one.
/// @param fresh terms that are marked as new.
Markup equations_mathml(const OdeModel& model, const TermNames& fresh = {});

}  // namespace lacuna
