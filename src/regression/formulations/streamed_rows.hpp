// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/long_records.hpp"
#include "regression/formulations/library_rows.hpp"

namespace lacuna {

/// How derivatives are made of samples.
struct SampleRates {
  Stage<Differentiator> method;
  bool smooth_states = false;
};

/// Rows of Theta and dx/dt at the samples of long records, as LibraryRows has them without
/// delays, made piece by piece of 2^13 rows: no thread keeps more than one, and none where a
/// record in memory has all that is needed.
class StreamedRows final : public RowSource {
 public:
  /// @param records in the variables of the library. One from which no derivative can be taken
  ///   has no rows.
  /// @param held inputs that hold their samples, as for LibraryRows.
  /// @throws ConfigError when a term has a delay.
  StreamedRows(const TermLibrary& library,
               std::vector<std::shared_ptr<const SampleSource>> records, SampleRates rates,
               bool has_derivatives, std::vector<Index> held = {});

  Index rows() const override { return rows_; }
  Index terms() const override { return library_.size(); }
  Index targets() const override {
    return static_cast<Index>(library_.variables.states.size());
  }
  std::unique_ptr<RowReader> open() const override;

  /// The first entry of Theta or of the targets that is not finite, if there is one. One pass.
  std::optional<NonFiniteEntry> find_non_finite() const;

 private:
  class Reader;

  /// Consecutive samples of one record that have rows.
  struct Piece {
    std::size_t record = 0;
    Index first_sample = 0;
    Index first_row = 0;
    Index count = 0;
  };

  /// With derivatives. @param more samples in front, where there are so many.
  Trajectory samples_of_piece(const Piece& piece, Index more) const;

  TermLibrary library_;
  std::vector<std::shared_ptr<const SampleSource>> records_;
  SampleRates rates_;
  bool has_derivatives_;
  std::vector<Index> held_;
  Index margin_;
  std::vector<Piece> pieces_;
  Index rows_ = 0;
};

}  // namespace lacuna
