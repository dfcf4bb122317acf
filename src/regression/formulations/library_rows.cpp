// SPDX-License-Identifier: MIT
#include "regression/formulations/library_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "variable_slots.hpp"

namespace lacuna {
namespace {

/// First sample that is at least `delay` after the first; n when the record is too short.
Index first_with_delay(const Vector& time, double delay) {
  // A delay of whole steps must not lose a sample to rounding.
  const double from = time[0] + delay * (1.0 - 1e-12);
  return std::lower_bound(time.data(), time.data() + time.size(), from) - time.data();
}

Vector delayed_values(const Vector& time, const Vector& values, Index first, double delay) {
  const Vector queries = (time.tail(time.size() - first).array() - delay).max(time[0]);
  return interpolate_cubic(time, values, queries);
}

double longest(const std::vector<DelayedVariable>& delays) {
  double result = 0.0;
  for (const DelayedVariable& delayed : delays) result = std::max(result, delayed.delay);
  return result;
}

/// Row and column of the first entry that is not finite, column by column.
std::optional<std::pair<Index, Index>> non_finite(const Matrix& values) {
  if (all_finite(values)) return std::nullopt;
  for (Index column = 0; column < values.cols(); ++column)
    for (Index row = 0; row < values.rows(); ++row)
      if (!std::isfinite(values(row, column))) return std::pair{row, column};
  return std::nullopt;
}

}  // namespace

class LibraryRows::Reader final : public RowReader {
 public:
  explicit Reader(const LibraryRows& source) : source_(source) {}

  void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
    auto block = std::upper_bound(
        source_.blocks_.begin(), source_.blocks_.end(), first,
        [](Index row, const Block& candidate) { return row < candidate.first_row; });
    --block;
    for (Index done = 0; done < theta.rows(); ++block) {
      const Index skip = first + done - block->first_row;
      const Index count = std::min(theta.rows() - done, block->slots.rows() - skip);
      source_.program_.evaluate(block->slots.middleRows(skip, count),
                                theta.middleRows(done, count), workspace_);
      average_at(block->jumps, source_.program_, skip, theta.middleRows(done, count),
                 workspace_);
      targets.middleRows(done, count) = block->targets.middleRows(skip, count);
      done += count;
    }
  }

 private:
  const LibraryRows& source_;
  Program::Workspace workspace_;
};

LibraryRows::LibraryRows(const TermLibrary& library, const std::vector<Trajectory>& records,
                         Index margin, std::vector<Index> held)
    : library_(library),
      program_(library.compile()),
      held_(std::move(held)),
      longest_delay_(longest(program_.delays())) {
  for (std::size_t number = 0; number < records.size(); ++number) {
    Block block = make_block(records[number], number, margin);
    if (block.slots.rows() == 0) continue;
    block.first_row = rows_;
    rows_ += block.slots.rows();
    blocks_.push_back(std::move(block));
  }
  if (rows_ == 0)
    throw DataError("data",
                    "no record is longer than the delay " + format_number(longest_delay_),
                    "give longer records or terms with shorter delays");
}

LibraryRows::Block LibraryRows::make_block(const Trajectory& record, std::size_t number,
                                           Index margin) const {
  const Index ends = 4 * margin <= record.samples() ? margin : 0;
  const Index first = std::max(first_with_delay(record.time, longest_delay_), ends);
  const Index count = std::max<Index>(record.samples() - ends - first, 0);
  Block block{record.source,
              number,
              first,
              0,
              Matrix(count, program_.slots()),
              record.derivatives.middleRows(first, count)};
  fill_variables(record, first, block.slots);
  fill_delays(record, block);
  block.jumps = input_jumps(record, first, block.slots, held_);
  return block;
}

void LibraryRows::fill_delays(const Trajectory& record, Block& block) const {
  if (program_.delays().empty()) return;
  Index slot = record.states.cols() + record.inputs.cols() + 1;
  Matrix variables(record.samples(), slot);
  fill_variables(record, 0, variables);
  for (const DelayedVariable& delayed : program_.delays())
    block.slots.col(slot++) =
        delayed_values(record.time, variables.col(delayed.slot), block.first_sample,
                       delayed.delay)
            .head(block.slots.rows());
}

std::unique_ptr<RowReader> LibraryRows::open() const { return std::make_unique<Reader>(*this); }

std::vector<RecordRows> LibraryRows::record_rows() const {
  std::vector<RecordRows> parts;
  for (const Block& block : blocks_)
    parts.push_back({block.record, block.first_sample, block.first_row, block.slots.rows()});
  return parts;
}

std::optional<NonFiniteEntry> LibraryRows::find_non_finite() const {
  // A fact of caches.
  constexpr Index kTile = 256;
  Program::Workspace workspace;
  for (const Block& block : blocks_) {
    for (Index first = 0; first < block.slots.rows(); first += kTile) {
      const Index count = std::min(kTile, block.slots.rows() - first);
      Matrix theta(count, terms());
      program_.evaluate(block.slots.middleRows(first, count), theta, workspace);
      if (const auto place = non_finite(theta))
        return describe(block, first + place->first, place->second);
    }
    if (const auto place = non_finite(block.targets))
      return describe(block, place->first, std::nullopt);
  }
  return std::nullopt;
}

NonFiniteEntry LibraryRows::describe(const Block& block, Index row,
                                     std::optional<Index> term) const {
  const Index time_slot = library_.variables.count() - 1;
  NonFiniteEntry entry{"", block.source, block.first_sample + row, block.slots(row, time_slot),
                       ""};
  if (!term) return entry;
  const Term& culprit = library_.terms[static_cast<std::size_t>(*term)];
  const std::vector<std::string> names = library_.variables.names();
  std::vector<std::string> values;
  for (const std::string& name : culprit.expression().variables()) {
    const Index slot = std::find(names.begin(), names.end(), name) - names.begin();
    if (slot != time_slot)
      values.push_back(name + " = " + format_number(block.slots(row, slot), 6));
  }
  entry.term = culprit.name();
  entry.values = join(values, ", ");
  return entry;
}

}  // namespace lacuna
