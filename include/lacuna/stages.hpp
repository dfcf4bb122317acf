// SPDX-License-Identifier: MIT
// Every plug point and every stage that lacuna has: what pipelines and diagnoses are composed
// of.
#pragma once

#include "lacuna/bases/bases.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/differentiators.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/dynamics/integrators.hpp"
#include "lacuna/effects/effect_family.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/regression/filters.hpp"
#include "lacuna/regression/formulations.hpp"
#include "lacuna/regression/pruners.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/formulation.hpp"
#include "lacuna/regression/stages/l1_solver.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/regressor.hpp"
#include "lacuna/regression/stages/term_filter.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"
#include "lacuna/solvers/least_squares.hpp"
#include "lacuna/solvers/selection.hpp"
#include "lacuna/trajectories/refiners.hpp"
