// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hidden/support/hidden_case.hpp"

namespace lacuna::hidden {

/// What an engineer would bring: a record to find the effect in and one to check the answer on.
struct Records {
  Dataset find, check;
};

/// A record without noise: the states and inputs of the nominal model on the plant's grid.
/// The seed decides start and drives. Hidden states and unmeasured inputs are left out.
/// @throws ArgumentError when the system diverges.
Dataset clean_record(const HiddenCase& hidden, std::uint64_t seed);

/// Two records of one case, with other starts, drives and noise, at a noise level relative to
/// the standard deviation of each state.
Records make_records(const HiddenCase& hidden, double level, std::uint64_t seed);

/// What a model leaves over of the derivatives of a clean record, n - 6 x m: dx/dt by central
/// differences of order 6 minus f(t, x, u). The model must not have delays or other states.
Matrix leftover(const OdeModel& model, const Dataset& clean);

/// dx/dt of a clean record by central differences of order 6, n - 6 x m.
Matrix central_rates(const Dataset& clean);

}  // namespace lacuna::hidden
