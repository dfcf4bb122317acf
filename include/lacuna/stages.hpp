// SPDX-License-Identifier: MIT
// Every plug point and every stage that lacuna has: what pipelines and diagnoses are composed
// of.
#pragma once

#include "lacuna/bases/bases.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/regression/filters.hpp"
#include "lacuna/regression/formulations.hpp"
#include "lacuna/regression/pruners.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/formulation.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "lacuna/solvers/least_squares.hpp"
#include "lacuna/solvers/selection.hpp"
#include "lacuna/trajectories/refiners.hpp"
