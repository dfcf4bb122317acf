// SPDX-License-Identifier: MIT
// What terms do to the innovations: the error of the filter when the record has a term and the
// filter does not know it. Several terms go through the record together.
#include <vector>

#include "lacuna/core/error.hpp"
#include "lacuna/estimation/innovation_filter.hpp"
#include "lacuna/flow/fixed_size.hpp"

namespace lacuna {
namespace {

/// Terms that go together: what fits into the registers, and what a few need.
constexpr int kMany = 8, kFew = 2;

template <int Together>
using Lanes = Eigen::Array<double, Together, 1>;

/// The filter's errors, one lane for each term: taken in by the measurements, carried on by the
/// model. Size: states and states of coloured noise, or Eigen::Dynamic.
template <int Size, int Together>
class ErrorRecursion {
 public:
  using Errors = Eigen::Array<double, Together, Size>;
  using Lane = Lanes<Together>;

  ErrorRecursion(const LinearisedRecord& record, const InnovationFilter& filter)
      : record_(record),
        filter_(filter),
        m_(record.states()),
        error_(Errors::Zero(Together, filter.size)),
        next_(Errors::Zero(Together, filter.size)) {}

  /// Measurements of sample i; `extra` is added to what is measured of `state`.
  template <class Write>
  void measure(Index i, Index state, const Lane& extra, Write write) {
    const double* gain = filter_.gain.col(i).data();
    for (Index c = 0; c < filter_.channels; ++c, gain += filter_.size) {
      const Index own = filter_.state_of_channel[static_cast<std::size_t>(c)];
      const Index colour = filter_.colour_of_channel[static_cast<std::size_t>(c)];
      const double scale = filter_.inverse_deviation(c, i);
      Lane seen = error_.col(own);
      if (own == state) seen += extra;
      if (colour < filter_.size) seen += error_.col(colour);
      write(c, Lane(scale * seen));
      if (scale == 0.0) continue;
      for (Index j = 0; j < error_.cols(); ++j) error_.col(j) -= gain[j] * seen;
    }
  }

  /// Step i of the model.
  void carry(Index i) {
    const double* phi = record_.transition.col(i).data();
    for (Index j = 0; j < m_; ++j) {
      next_.col(j) = phi[j] * error_.col(0);
      for (Index k = 1; k < m_; ++k) next_.col(j) += phi[j + m_ * k] * error_.col(k);
    }
    for (Index j = m_; j < filter_.size; ++j)
      next_.col(j) = filter_.colour_decay[static_cast<std::size_t>(j - m_)] * error_.col(j);
    error_ = next_;
  }

  /// Rates in an equation over step i, with values at its begin, middle and end.
  void push(Index i, Index equation, const Lane& begin, const Lane& middle, const Lane& end) {
    const double* w = record_.response.col(i).data() + 3 * m_ * equation;
    for (Index j = 0; j < m_; ++j)
      error_.col(j) += w[j] * begin + w[m_ + j] * middle + w[2 * m_ + j] * end;
  }

 private:
  const LinearisedRecord& record_;
  const InnovationFilter& filter_;
  Index m_;
  Errors error_, next_;
};

void check(const InnovationFilter& filter, const LinearisedRecord& record,
           const Eigen::Ref<const Matrix>& values, Index expected,
           const Eigen::Ref<Matrix>& out) {
  if (values.rows() != expected || out.rows() != filter.channels * record.samples() ||
      out.cols() != values.cols())
    throw ArgumentError("column response", "the values do not fit the record",
                        "give one for each sample, and one for each step's middle");
}

/// Some columns of a matrix as lanes, row by row.
template <int Together>
class LaneColumns {
 public:
  LaneColumns(const Eigen::Ref<const Matrix>& values, Index first)
      : values_(values),
        first_(first),
        count_(std::min<Index>(Together, values.cols() - first)) {}

  Lanes<Together> row(Index i) const {
    Lanes<Together> lanes = Lanes<Together>::Zero();
    for (Index c = 0; c < count_; ++c) lanes[c] = values_(i, first_ + c);
    return lanes;
  }

  void write(Eigen::Ref<Matrix>& out, Index row, const Lanes<Together>& lanes) const {
    for (Index c = 0; c < count_; ++c) out(row, first_ + c) = lanes[c];
  }

 private:
  const Eigen::Ref<const Matrix>& values_;
  Index first_, count_;
};

template <int Size, int Together>
void rate_lanes(const LinearisedRecord& record, const InnovationFilter& filter, Index equation,
                const LaneColumns<Together>& columns, Eigen::Ref<Matrix>& out) {
  ErrorRecursion<Size, Together> error(record, filter);
  const Lanes<Together> none = Lanes<Together>::Zero();
  Lanes<Together> begin = columns.row(0);
  for (Index i = 0; i < record.samples(); ++i) {
    error.measure(i, -1, none, [&](Index c, const auto& lanes) {
      columns.write(out, i * filter.channels + c, lanes);
    });
    if (i + 1 == record.samples()) break;
    error.carry(i);
    const Lanes<Together> end = columns.row(record.grid.end(i));
    error.push(i, equation, begin, columns.row(record.grid.middle(i)), end);
    begin = record.grid.stride == 2 ? end : columns.row(record.grid.begin(i + 1));
  }
}

template <int Size, int Together>
void channel_lanes(const LinearisedRecord& record, const InnovationFilter& filter, Index state,
                   const LaneColumns<Together>& columns, Eigen::Ref<Matrix>& out) {
  ErrorRecursion<Size, Together> error(record, filter);
  for (Index i = 0; i < record.samples(); ++i) {
    error.measure(i, state, columns.row(i), [&](Index c, const auto& lanes) {
      columns.write(out, i * filter.channels + c, lanes);
    });
    if (i + 1 < record.samples()) error.carry(i);
  }
}

/// Calls `work(size, columns)` with all columns of `values`, as many together as is good.
template <class Work>
void for_lanes(Index size, const Eigen::Ref<const Matrix>& values, Work work) {
  with_size(size, [&](auto fixed) {
    for (Index first = 0; first < values.cols(); first += kMany)
      if (values.cols() - first > kFew)
        work(fixed, LaneColumns<kMany>(values, first));
      else
        work(fixed, LaneColumns<kFew>(values, first));
  });
}

}  // namespace

void column_response(const LinearisedRecord& record, const InnovationFilter& filter,
                     Index equation, const Eigen::Ref<const Matrix>& values,
                     Eigen::Ref<Matrix> out) {
  check(filter, record, values, record.grid.rows(record.samples()), out);
  for_lanes(filter.size, values, [&](auto size, const auto& columns) {
    rate_lanes<size()>(record, filter, equation, columns, out);
  });
}

void channel_response(const LinearisedRecord& record, const InnovationFilter& filter,
                      Index state, const Eigen::Ref<const Matrix>& values,
                      Eigen::Ref<Matrix> out) {
  check(filter, record, values, record.samples(), out);
  for_lanes(filter.size, values, [&](auto size, const auto& columns) {
    channel_lanes<size()>(record, filter, state, columns, out);
  });
}

}  // namespace lacuna
