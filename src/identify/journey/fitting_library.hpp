// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// How many values an input takes in all records; nothing where there are more than so many.
std::optional<int> value_count(const Dataset& data, Index input, int most);

/// The pipeline without candidates that the records cannot distinguish from others: an input
/// that takes L values in all records, L > 1, has u^L as a polynomial of lower powers at every
/// sample (a step from 0 to 1: u^2 = u), so that its powers from L on are left out. Only of
/// libraries of monomials, and where no equation and no constraint names terms.
/// @param warnings gets a sentence for each such input.
Pipeline with_distinct_powers(Pipeline pipeline, const Dataset& data,
                              std::vector<std::string>& warnings);

/// The pipeline without monomials of the highest degrees, where samples are few: down to
/// degree 1 as long as there are fewer than so many for each candidate.
/// As above only where nobody named terms.
/// @param warnings gets a sentence where terms were left out.
Pipeline with_determined_terms(Pipeline pipeline, const Dataset& data, double samples_per_term,
                               std::vector<std::string>& warnings);

}  // namespace lacuna
