// SPDX-License-Identifier: MIT
// Libraries of variables that stay far from 0.
#pragma once

#include <string>
#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// A pipeline whose library has x - centre in the place of each far variable x
/// (far_variables()): the polynomials up to a degree in x are those in x - centre, whose terms
/// are no longer one and the same column. Only variables count of which the library has all
/// that a shift makes of its terms: with x^p*q, q without x, it has x^(p-1)*q, ..., q, and some
/// p above 1. A library that the user named by equations or constrained stays as it is.
/// @param warnings gets a sentence for each variable.
Pipeline with_centred_library(Pipeline pipeline, const Dataset& data,
                              std::vector<std::string>& warnings);

}  // namespace lacuna
