// SPDX-License-Identifier: MIT
// From the account that was chosen to the answer.
#pragma once

#include <optional>
#include <string>

#include "journey.hpp"
#include "lacuna/diagnose/journey/diagnosis.hpp"

namespace lacuna {

/// What other records have to say of the names of an account.
struct Hearing {
  bool withdraw = false;  ///< the names are refuted, or what stands without names
  bool lower = false;     ///< the names hold for the records that were used at best
  std::string note = {};  ///< empty: nothing
};

/// Hears records that were not used. They never choose between accounts. Effects that need not
/// come again (an input that was not measured, what depends on t) are not asked for it.
Hearing hear_other_records(const Problem& problem, const Account& account,
                           const std::optional<Gap>& gap);

/// The answer. @param judged the account and the trail; @param gap on other records.
Diagnosis make_answer(const Problem& problem, Judged judged, std::optional<Gap> gap,
                      const Hearing& hearing);

}  // namespace lacuna
