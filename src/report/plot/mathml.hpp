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
/// intervals, 6 without one. Each term is an element of its own, `term`, which begins a new line
/// where it does not fit into the last one; a term that is longer than a line breaks at its
/// operations.
/// @param fresh terms that are marked as new and have lines of their own.
Markup equations_mathml(const OdeModel& model, const TermNames& fresh = {});

}  // namespace lacuna
