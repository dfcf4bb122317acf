// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stage.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/removal.hpp"

namespace lacuna {

/// What a filter leaves.
struct FilterResult {
  TermSet kept;
  std::vector<Removal> removed;
};

/// Plug point: removes candidate terms that vanish on the data or that the others express,
/// without looking at any target.
class TermFilter : public StageInterface {
 public:
  static constexpr std::string_view kKind = "filter";

  /// @return kept and removed terms; together they are all terms. Columns of zeros are always
  ///   removed.
  FilterResult filter(const LeastSquaresSystem& system, const RunContext& context = {}) const;

 private:
  virtual FilterResult do_filter(const LeastSquaresSystem& system,
                                 const RunContext& context) const = 0;
};

}  // namespace lacuna
