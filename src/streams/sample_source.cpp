// SPDX-License-Identifier: MIT
#include "lacuna/streams/sample_source.hpp"

#include <algorithm>
#include <utility>

namespace lacuna {
namespace {

class RecordInMemory final : public SampleSource {
 public:
  explicit RecordInMemory(const Trajectory& record) : record_(record) {}

  Index samples() const override { return record_.samples(); }
  Trajectory read(Index first, Index count) const override {
    return rows_of(record_, first, count);
  }

 private:
  const Trajectory& record_;
};

Matrix every(const Matrix& values, Index step) {
  if (values.rows() == 0) return values;
  return values(Eigen::seq(0, values.rows() - 1, step), Eigen::all);
}

/// Puts every `step`-th of more samples in place from `at` on.
void append_every(const Trajectory& more, Index step, Index at, Trajectory& all) {
  const Vector time = every(more.time, step);
  const auto put = [&](const Matrix& values, Matrix& into) {
    if (into.rows() > 0 && values.rows() > 0)
      into.middleRows(at, time.size()) = every(values, step);
  };
  all.time.segment(at, time.size()) = time;
  put(more.states, all.states);
  put(more.inputs, all.inputs);
  put(more.derivatives, all.derivatives);
  put(more.marks, all.marks);
}

class ThinnedRecord final : public SampleSource {
 public:
  ThinnedRecord(std::shared_ptr<const SampleSource> record, Index step)
      : record_(std::move(record)), step_(step) {}

  Index samples() const override { return (record_->samples() + step_ - 1) / step_; }

  Trajectory read(Index first, Index count) const override {
    const Index together = step_ > kFarApart ? 1 : std::max<Index>(kSamplesAtOnce / step_, 1);
    Trajectory all = room_for(record_->read(first * step_, 1), count);
    for (Index done = 0; done < count; done += together) {
      const Index begin = (first + done) * step_;
      const Index rows = (std::min(together, count - done) - 1) * step_ + 1;
      append_every(record_->read(begin, rows), step_, done, all);
    }
    return all;
  }

 private:
  // Facts of the machines: what is read in one go, and from where on each sample is by itself.
  static constexpr Index kSamplesAtOnce = Index{1} << 16, kFarApart = 256;

  static Trajectory room_for(const Trajectory& one, Index count) {
    const auto room = [&](const Matrix& values) -> Matrix {
      return Matrix(values.rows() > 0 ? count : 0, values.cols());
    };
    return {one.source,       Vector(count),         room(one.states),
            room(one.inputs), room(one.derivatives), room(one.marks)};
  }

  std::shared_ptr<const SampleSource> record_;
  Index step_;
};

}  // namespace

std::shared_ptr<const SampleSource> thinned(std::shared_ptr<const SampleSource> record,
                                            Index step) {
  if (step <= 1) return record;
  return std::make_shared<const ThinnedRecord>(std::move(record), step);
}

std::shared_ptr<const SampleSource> source_of(const Trajectory& record) {
  return std::make_shared<const RecordInMemory>(record);
}

}  // namespace lacuna
