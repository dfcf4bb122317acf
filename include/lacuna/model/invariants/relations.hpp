// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {

/// One summand of a relation.
struct RelationTerm {
  std::string term;  ///< a monomial of the states
  double coefficient = 1.0;
  double error = 0.0;  ///< standard error; 0 for the first, to which the others are relative
};

/// A polynomial of the states that is constant on the data: sum_j c_j phi_j = value.
struct Relation {
  std::vector<RelationTerm> terms;  ///< in degree-lexicographic order; the first has c = 1
  double value = 0.0;
  double scatter = 0.0;  ///< rms of sum_j c_j phi_j - value over the samples
  double noise = 0.0;    ///< what the measurement noise makes of it
};

/// Which relations are reported. What half and double of each changes is in docs/decisions.md.
struct RelationOptions {
  static constexpr StageInfo kInfo{"relations",
                                   "Which relations that hold on the data are reported", ""};

  int most_terms = 4;
  double strength = 10.0;
  double noise_slack = 0.1;
  double scatter = 4.0;
  double resolution = 1e-4;
  int fewest_samples = 40;
  int most_states = 8;
  double most_sets = 30000;

  void describe(OptionVisitor& v);
};

/// Polynomials of degree 1 and 2 (of more than RelationOptions::most_states
/// states 1; no products with states far from 0, far_variables()) of the measured states that
/// vanish, up to a constant, at the noise level of the record (the approximately vanishing
/// ideal: Heldt, Kreuzer, Pokutta & Poulisse, J. Symbolic Computation 44 (2009) 1566), shortest
/// first. On such data the monomials of a relation and a constant cannot be distinguished.
///
/// For a set of monomials phi with the covariance C over the samples and N that of the noise in
/// them, N = mean(J S J'), J = dphi/dx, S = diag(sigma^2), c is the eigenvector of C c = lambda
/// N c with the least lambda (total least squares in columns that the noise makes white). It is
/// a relation where
///   c'C c <= (1 + noise_slack)^2 (1 + chance) c'N c    no more is left than noise,
///   the same for means of twenty blocks of the record, where noise is averaged out,
///   c_j sd(phi_j) >= strength * scatter   every summand counts,
///   c'(N - M) c >= c'M c, M_ij = tr(H_i S H_j S), H the Hessians   noise acts by the gradient.
/// What contains a multiple of the leading monomial of a relation follows from it and is not
/// reported (Buchberger and Moeller's order).
/// @param noise of the states, where it is known already (analyse_noise()).
/// @throws DataError as check_dataset(); ArgumentError when known noise is not one per state.
std::vector<Relation> find_relations(const Dataset& data, const RelationOptions& options = {},
                                     const RunContext& context = {},
                                     const KnownNoise& noise = {});

}  // namespace lacuna
