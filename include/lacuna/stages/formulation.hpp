// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/run_context.hpp"
#include "lacuna/core/stage.hpp"
#include "lacuna/data/dataset.hpp"
#include "lacuna/linear/least_squares_system.hpp"
#include "lacuna/model/term.hpp"

namespace lacuna {

/// Plug point: turns records and candidate terms into a linear problem. In the strong form a row
/// is a sample and the target its derivative; other forms have other rows. All that comes after
/// sees rows only.
class Formulation : public StageInterface {
 public:
  static constexpr std::string_view kKind = "formulation";

  /// The system Theta h_k ~ y_k with one target per state.
  /// @throws DataError when the dataset is not usable (check_dataset), when there are fewer rows
  ///   than terms, when a state is constant, when a derivative is zero throughout, or when a term
  ///   is not finite on the data: names the place and the remedy.
  LeastSquaresSystem assemble(const Dataset& data, const TermLibrary& library,
                              const RunContext& context = {}) const;

 private:
  virtual LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                         const RunContext& context) const = 0;
};

}  // namespace lacuna
