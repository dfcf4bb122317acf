// SPDX-License-Identifier: MIT
// Which samples are held out.
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/options.hpp"

namespace lacuna {

/// Samples [first, first + count) of a record.
struct Block {
  std::size_t record = 0;
  Index first = 0;
  Index count = 0;
};

/// Every so manyth of blocks, counted through all records (ValidationOptions::held_every):
/// about ValidationOptions::blocks in all where each has room for a window then, and no fewer
/// than ValidationOptions::fewest_blocks. A record that is shorter than a block is one. What rests
/// before a record moves and behind it is in no block: there a model shows nothing.
/// @param window samples.
std::vector<Block> held_blocks(const Dataset& data, Index window,
                               const ValidationOptions& options = {});

/// Whole records.
std::vector<Block> all_blocks(const Dataset& data);

/// No more than so many samples of blocks that are evenly spread; a block that is longer than
/// that on its own is cut.
std::vector<Block> limited(const std::vector<Block>& blocks, Index samples);

/// The rest of the records; stretches of fewer than `shortest` samples are dropped.
/// @param blocks in the order of records and time.
Dataset without_blocks(const Dataset& data, const std::vector<Block>& blocks, Index shortest);

/// No more than so many samples of records, in stretches as limited() takes them, long records
/// cut into pieces first.
/// @param pieces of so many samples as are taken; 1: records as they are.
Dataset thinned(const Dataset& data, Index samples, Index pieces = 1);

}  // namespace lacuna
