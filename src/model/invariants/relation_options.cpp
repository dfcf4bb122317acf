// SPDX-License-Identifier: MIT
#include "lacuna/model/invariants/relations.hpp"

namespace lacuna {

void RelationOptions::describe(OptionVisitor& v) {
  v.field({"most_terms", "",
           "Monomials of a relation at most: longer ones hold by chance where a record is one "
           "curve.",
           1.0, 10.0},
          most_terms);
  v.field({"strength", "", "What each summand has to vary by, in units of the scatter.", 0.0},
          strength);
  v.field(
      {"noise_slack", "",
       "The scatter may be above the noise by this fraction, as the noise is known no better.",
       0.0},
      noise_slack);
  v.field(
      {"scatter", "standard deviations", "And by so many of a mean of as many squares.", 0.0},
      scatter);
  v.field({"resolution", "",
           "Errors of solvers and digits, as a fraction of what a state varies by.", 0.0, 1.0},
          resolution);
  v.field({"fewest_samples", "samples", "In fewer no relations are sought.", 4.0},
          fewest_samples);
  v.field({"most_states", "", "Of more measured states only linear relations are sought.", 1.0},
          most_states);
  v.field({"most_sets", "",
           "Sets of monomials that are tried at most for each number of terms; larger numbers "
           "are left out.",
           1.0},
          most_sets);
}

}  // namespace lacuna
