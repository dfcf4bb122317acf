// SPDX-License-Identifier: MIT
#include "term_set.hpp"

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

void check_term_set(const std::string& where, const TermSet& set, Index count) {
  Index previous = -1;
  for (const Index term : set) {
    if (term <= previous || term >= count)
      throw ArgumentError(where, "term number " + std::to_string(term) + " is out of place",
                          "give increasing numbers from 0 to " + std::to_string(count - 1));
    previous = term;
  }
}

void check_partition(const std::string& where, const TermSet& all, const TermSet& kept,
                     const std::vector<Removal>& removed) {
  TermSet together = kept;
  for (const Removal& removal : removed) together.push_back(removal.term);
  std::sort(together.begin(), together.end());
  if (together == all && std::is_sorted(kept.begin(), kept.end())) return;
  throw ArgumentError(where, "kept and removed terms are not the terms it was given",
                      "a stage must keep each term or say why it is removed");
}

}  // namespace lacuna
