// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "core/base/check.hpp"
#include "lacuna/data/long_records.hpp"

namespace lacuna {
namespace {

void check_stretch(const SampleSource& record, Index first, Index step, Index count) {
  const Index room = step > 0 ? (record.samples() - first + step - 1) / step : 0;
  if (first < 0 || first > record.samples())
    check_part(first, count, record.samples(), "read_every");
  check_part(0, count, room, "read_every");
}

Matrix every(const Matrix& values, Index first, Index step, Index count) {
  if (values.rows() == 0) return values;
  return values(Eigen::seqN(first, count, step), Eigen::all);
}

/// `count` samples of a record in memory, `step` apart.
Trajectory thinned_rows(const Trajectory& record, Index first, Index step, Index count) {
  const auto part = [&](const Matrix& values) { return every(values, first, step, count); };
  return {record.source,
          Vector(record.time(Eigen::seqN(first, count, step))),
          part(record.states),
          part(record.inputs),
          part(record.derivatives),
          part(record.marks)};
}

/// Puts samples in place from `at` on.
void put_rows(const Trajectory& more, Index at, Trajectory& all) {
  const auto put = [&](const Matrix& values, Matrix& into) {
    if (into.rows() > 0 && values.rows() > 0) into.middleRows(at, values.rows()) = values;
  };
  all.time.segment(at, more.samples()) = more.time;
  put(more.states, all.states);
  put(more.inputs, all.inputs);
  put(more.derivatives, all.derivatives);
  put(more.marks, all.marks);
}

/// A record of `count` samples with the columns of another.
Trajectory room_for(const Trajectory& one, Index count) {
  const auto room = [&](const Matrix& values) -> Matrix {
    return Matrix(values.rows() > 0 ? count : 0, values.cols());
  };
  return {one.source,       Vector(count),         room(one.states),
          room(one.inputs), room(one.derivatives), room(one.marks)};
}

class RecordInMemory final : public SampleSource {
 public:
  explicit RecordInMemory(const Trajectory& record) : record_(record) {}

  Index samples() const override { return record_.samples(); }
  Trajectory read(Index first, Index count) const override {
    return rows_of(record_, first, count);
  }
  Trajectory read_every(Index first, Index step, Index count) const override {
    check_stretch(*this, first, step, count);
    return thinned_rows(record_, first, step, count);
  }
  const Trajectory* in_memory() const override { return &record_; }

 private:
  const Trajectory& record_;
};

class ThinnedRecord final : public SampleSource {
 public:
  ThinnedRecord(std::shared_ptr<const SampleSource> record, Index step)
      : record_(std::move(record)), step_(step) {}

  Index samples() const override { return (record_->samples() + step_ - 1) / step_; }

  Trajectory read(Index first, Index count) const override {
    return record_->read_every(first * step_, step_, count);
  }

 private:
  std::shared_ptr<const SampleSource> record_;
  Index step_;
};

}  // namespace

Trajectory SampleSource::read_every(Index first, Index step, Index count) const {
  // Facts of the machines: what is read in one go, and from where on each sample is by itself.
  check_stretch(*this, first, step, count);
  constexpr Index kSamplesAtOnce = Index{1} << 16, kFarApart = 256;
  const Index together = step > kFarApart ? 1 : std::max<Index>(kSamplesAtOnce / step, 1);
  Trajectory all = room_for(read(first, 1), count);
  for (Index done = 0; done < count; done += together) {
    const Index some = std::min(together, count - done);
    const Trajectory between = read(first + done * step, (some - 1) * step + 1);
    put_rows(thinned_rows(between, 0, step, some), done, all);
  }
  return all;
}

std::shared_ptr<const SampleSource> thinned(std::shared_ptr<const SampleSource> record,
                                            Index step) {
  check_argument(record != nullptr, "thinned", "no record is given");
  if (step <= 1) return record;
  return std::make_shared<const ThinnedRecord>(std::move(record), step);
}

std::shared_ptr<const SampleSource> source_of(const Trajectory& record) {
  return std::make_shared<const RecordInMemory>(record);
}

}  // namespace lacuna
