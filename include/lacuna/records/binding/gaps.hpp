// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Which pieces of a record are joined where samples are missing, and which are too short.
struct GapOptions {
  double longest_gap = 10.0;
  int shortest_record = 20;

  void describe(OptionVisitor& visitor) {
    visitor.field({"longest_gap", "steps",
                   "Longest time from one sample to the next in which a model is carried on; "
                   "beyond it a record begins anew.",
                   1.0},
                  longest_gap);
    visitor.field({"shortest_record", "samples",
                   "Records of fewer samples are left out of a diagnosis.", 4.0},
                  shortest_record);
  }
};

/// The records with those pieces joined that follow one another in one record after a gap of at
/// most GapOptions::longest_gap usual steps (the median of all): a model goes on from one sample
/// to the next however far they are apart. Records with numbers of their own ("run.csv,
/// record 2") stay apart, as do those that are cut at seams.
/// @param data at least one record.
/// @throws ArgumentError when a record has not the columns of the dataset.
Dataset join_across_gaps(const Dataset& data, const GapOptions& options = {});

/// What there is to be said of jumps in time inside records: where nine tenths of the steps of a
/// record are alike and the longest is more than GapOptions::longest_gap of them, another record
/// may begin behind it, with initial states of its own. The note counts them. Samples at uneven
/// times have no jumps.
/// @throws ArgumentError when a record has not the columns of the dataset.
std::vector<std::string> notes_on_jumps(const Dataset& data, const GapOptions& options = {});

/// Records that can be worked with, and what was done to get them.
struct UsableRecords {
  Dataset data;
  std::vector<std::string> notes;
};

/// The records joined across their gaps, without those that are shorter than
/// GapOptions::shortest_record even so. Both are noted.
/// @throws DataError when nothing is left, and as check_dataset().
UsableRecords usable_records(const Dataset& data, const GapOptions& options = {});

/// A part of the records to find something in and a part to check it on.
struct SplitRecords {
  Dataset find;   ///< the first three quarters of each record
  Dataset check;  ///< the last quarter of each
};

/// Splits every record in time.
/// @throws ArgumentError when a record has not the columns of the dataset.
SplitRecords split_in_time(const Dataset& data);

}  // namespace lacuna
