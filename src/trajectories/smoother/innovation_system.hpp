// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// Values of some terms along each record: one column for each term at the nodes of its steps;
/// no entry where there is no term.
using TermValues = std::vector<Matrix>;

/// The innovations of all records as one linear least-squares problem in the coefficients of
/// terms: innovations = columns x change of the coefficients + white noise of unit variance.
///
/// Rows: for each record its n x channels innovations, sample by sample.
class InnovationSystem {
 public:
  /// Runs the filters of an assimilation, which must outlive the system.
  explicit InnovationSystem(const Assimilation& assimilation);

  Index rows() const noexcept { return innovations_.size(); }
  Index used() const noexcept { return used_; }
  double deviance() const noexcept { return deviance_; }
  const Vector& innovations() const noexcept { return innovations_; }
  const std::vector<InnovationFilter>& filters() const noexcept { return filters_; }

  /// First row of each record, and the number of rows at the end.
  const std::vector<Index>& offsets() const noexcept { return offsets_; }

  /// Columns of rates in an equation. @param values per record 2n-1 x count.
  Matrix rate_columns(Index equation, const std::vector<Matrix>& values) const;

  /// Columns of values added to what is measured of a state.
  /// @param values per record n x count.
  Matrix channel_columns(Index state, const std::vector<Matrix>& values) const;

  /// Columns of everything that is fitted: the free coefficients, then the channel terms.
  Matrix fitted_columns() const { return fitted_columns(free_terms()); }

  /// The same where the values of the terms are known.
  Matrix fitted_columns(const std::vector<TermValues>& terms) const;

  /// Values of the free terms of each equation along the records.
  std::vector<TermValues> free_terms() const;

 private:
  Vector channel_term_column(const ChannelTerm& term) const;

  const Assimilation* assimilation_;
  std::vector<InnovationFilter> filters_;
  std::vector<Index> offsets_;
  Vector innovations_;
  double deviance_ = 0.0;
  Index used_ = 0;
};

}  // namespace lacuna
