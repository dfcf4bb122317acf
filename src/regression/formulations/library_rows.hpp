// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/term.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/formulations/input_jumps.hpp"

namespace lacuna {

/// Where a number of the linear problem is not finite.
struct NonFiniteEntry {
  std::string term;    ///< its name; empty when it is a target
  std::string source;  ///< of the record
  Index sample = 0;    ///< number in the record, from 0
  double time = 0.0;
  std::string values;  ///< what the variables of the term are there: "x = 0, y = 2"
};

/// Which rows are made of which samples.
struct RecordRows {
  std::size_t record = 0;  ///< number of the record
  Index first_sample = 0;  ///< of the record, the first that has a row
  Index first_row = 0;
  Index count = 0;
};

/// Rows of Theta and dx/dt at the samples of all records, one after the other. Keeps the
/// variables of each record (n x slots) and its targets (n x m); term values are made on
/// demand.
///
/// A delayed variable is the record interpolated by cubics at t - T; the samples before the
/// first t_0 + T are left out.
class LibraryRows final : public RowSource {
 public:
  /// @param records with derivatives, in the variables of the library.
  /// @param margin samples without a row at either end of a record, where the derivative is of
  ///   less worth; a record of which fewer than half would remain keeps them.
  /// @param held inputs that hold their samples, by number: where one jumps, terms are the
  ///   mean of both limits (InputJumps).
  /// @throws DataError when no record is longer than the longest delay.
  LibraryRows(const TermLibrary& library, const std::vector<Trajectory>& records,
              Index margin = 0, std::vector<Index> held = {});

  Index rows() const override { return rows_; }
  Index terms() const override { return library_.size(); }
  Index targets() const override {
    return static_cast<Index>(library_.variables.states.size());
  }
  std::unique_ptr<RowReader> open() const override;

  /// Records that have rows, in order.
  std::vector<RecordRows> record_rows() const;

  /// The first entry of Theta or of the targets that is not finite, if there is one. One pass.
  std::optional<NonFiniteEntry> find_non_finite() const;

 private:
  class Reader;

  struct Block {
    std::string source;
    std::size_t record = 0;
    Index first_sample = 0;  ///< samples left out before the first row
    Index first_row = 0;
    Matrix slots;    ///< rows x slots
    Matrix targets;  ///< rows x m
    InputJumps jumps = {};
  };

  Block make_block(const Trajectory& record, std::size_t number, Index margin) const;
  void fill_delays(const Trajectory& record, Block& block) const;
  NonFiniteEntry describe(const Block& block, Index row, std::optional<Index> term) const;

  TermLibrary library_;
  Program program_;
  std::vector<Index> held_;
  double longest_delay_ = 0.0;
  std::vector<Block> blocks_;
  Index rows_ = 0;
};

}  // namespace lacuna
