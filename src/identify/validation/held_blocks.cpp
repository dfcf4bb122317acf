// SPDX-License-Identifier: MIT
#include "held_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

/// Samples from an end of a record on at which no state is farther from there than at rest.
/// @param moves m: NaN of a state that is not measured. @param step 1 from the first sample on,
///   -1 from the last.
Index samples_at_rest(const Trajectory& record, const Vector& moves, Index step) {
  const Index n = record.samples(), end = step > 0 ? 0 : n - 1;
  Index count = 0;
  while (count < n) {
    const auto off = record.states.row(end + step * count) - record.states.row(end);
    if ((off.transpose().array().abs() > moves.array()).any()) break;
    ++count;
  }
  return count;
}

/// A record without what rests before it moves and behind; whole where it never does, or always.
Block moving_part(const Dataset& data, std::size_t record, const Vector& moves) {
  const Trajectory& own = data.trajectories[record];
  const Index before = samples_at_rest(own, moves, 1), behind = samples_at_rest(own, moves, -1);
  const Index first = std::max<Index>(before - 1, 0);
  const Index count = own.samples() - first - std::max<Index>(behind - 1, 0);
  return count > 1 ? Block{record, first, count} : Block{record, 0, own.samples()};
}

/// @param fraction of a state's deviation by which it may move at rest.
std::vector<Block> moving_parts(const Dataset& data, double fraction) {
  std::vector<Matrix> states;
  for (const Trajectory& record : data.trajectories) states.push_back(record.states);
  const Vector moves = fraction * column_deviations(states);
  std::vector<Block> parts;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r)
    parts.push_back(moving_part(data, r, moves));
  return parts;
}

Index samples_in(const std::vector<Block>& blocks) {
  Index total = 0;
  for (const Block& block : blocks) total += block.count;
  return total;
}

/// Pieces of nearly the same length, one behind the other.
std::vector<Block> pieces_of(const std::vector<Block>& blocks, Index length) {
  std::vector<Block> pieces;
  for (const Block& block : blocks) {
    const Index count = std::max<Index>(1, block.count / length);
    for (Index b = 0; b < count; ++b) {
      const Index first = b * block.count / count;
      pieces.push_back(
          {block.record, block.first + first, (b + 1) * block.count / count - first});
    }
  }
  return pieces;
}

}  // namespace

std::vector<Block> held_blocks(const Dataset& data, Index window,
                               const ValidationOptions& options) {
  const std::vector<Block> moving = moving_parts(data, options.resolution);
  const Index samples = samples_in(moving);
  const Index length = std::max<Index>(
      1, std::min(std::max(window, samples / options.blocks), samples / options.fewest_blocks));
  const std::vector<Block> all = pieces_of(moving, length);
  std::vector<Block> held;
  const auto every = static_cast<std::size_t>(options.held_every);
  for (std::size_t b = every / 2; b < all.size(); b += every) held.push_back(all[b]);
  return held;
}

std::vector<Block> all_blocks(const Dataset& data) {
  std::vector<Block> blocks;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r)
    blocks.push_back({r, 0, data.trajectories[r].samples()});
  return blocks;
}

std::vector<Block> limited(const std::vector<Block>& blocks, Index samples) {
  const Index total = samples_in(blocks);
  if (total <= samples) return blocks;
  const auto stride = static_cast<std::size_t>((total + samples - 1) / samples);
  std::vector<Block> chosen;
  if (blocks.size() >= stride) {
    for (std::size_t b = 0; b < blocks.size(); b += stride) chosen.push_back(blocks[b]);
  } else {
    chosen = blocks;
  }
  for (Block& block : chosen)
    block.count = std::min(block.count, samples / static_cast<Index>(chosen.size()));
  return chosen;
}

Dataset thinned(const Dataset& data, Index samples, Index pieces) {
  if (data.samples() <= samples) return data;
  Dataset some = data;
  some.trajectories.clear();
  std::vector<Block> blocks = all_blocks(data);
  if (pieces > 1) blocks = pieces_of(blocks, std::max<Index>(samples / pieces, 1));
  for (const Block& block : limited(blocks, samples))
    some.trajectories.push_back(
        rows_of(data.trajectories[block.record], block.first, block.count));
  return some;
}

Dataset without_blocks(const Dataset& data, const std::vector<Block>& blocks, Index shortest) {
  Dataset rest = data;
  rest.trajectories.clear();
  auto block = blocks.begin();
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Trajectory& record = data.trajectories[r];
    Index begin = 0;
    const auto keep = [&](Index end) {
      if (end - begin >= std::max<Index>(shortest, 2))
        rest.trajectories.push_back(rows_of(record, begin, end - begin));
    };
    for (; block != blocks.end() && block->record == r; ++block) {
      keep(block->first);
      begin = block->first + block->count;
    }
    keep(record.samples());
  }
  return rest;
}

}  // namespace lacuna
