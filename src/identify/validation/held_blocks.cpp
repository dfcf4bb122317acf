// SPDX-License-Identifier: MIT
#include "held_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Blocks of nearly the same length, one behind the other.
std::vector<Block> blocks_of(const Dataset& data, Index length) {
  std::vector<Block> blocks;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Index n = data.trajectories[r].samples();
    const Index count = std::max<Index>(1, n / length);
    for (Index b = 0; b < count; ++b) {
      const Index first = b * n / count;
      blocks.push_back({r, first, (b + 1) * n / count - first});
    }
  }
  return blocks;
}

}  // namespace

std::vector<Block> held_blocks(const Dataset& data, Index window,
                               const ValidationOptions& options) {
  const Index samples = data.samples();
  const Index length = std::max<Index>(
      1, std::min(std::max(window, samples / options.blocks), samples / options.fewest_blocks));
  const std::vector<Block> all = blocks_of(data, length);
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
  Index total = 0;
  for (const Block& block : blocks) total += block.count;
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

Dataset thinned(const Dataset& data, Index samples) {
  if (data.samples() <= samples) return data;
  Dataset some = data;
  some.trajectories.clear();
  for (const Block& block : limited(all_blocks(data), samples))
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
