// SPDX-License-Identifier: MIT
// What a term does to the innovations: the error of the filter when the record has the term and
// the filter does not know it.
#include <vector>

#include "lacuna/core/error.hpp"
#include "lacuna/innovation/innovation_filter.hpp"

namespace lacuna {
namespace {

/// The filter's error e: taken in by the measurements, carried on by the model.
class ErrorRecursion {
 public:
  ErrorRecursion(const LinearisedRecord& record, const InnovationFilter& filter)
      : record_(record),
        filter_(filter),
        m_(record.states()),
        error_(static_cast<std::size_t>(filter.size), 0.0),
        next_(static_cast<std::size_t>(filter.size), 0.0) {}

  /// Measurements of sample i; `extra` is added to what is measured of `state`.
  void measure(Index i, Index state, double extra, double* out) {
    const double* gain = filter_.gain.col(i).data();
    for (Index c = 0; c < filter_.channels; ++c, gain += filter_.size) {
      const Index own = filter_.state_of_channel[static_cast<std::size_t>(c)];
      const Index colour = filter_.colour_of_channel[static_cast<std::size_t>(c)];
      const double scale = filter_.inverse_deviation(c, i);
      double seen = error_[static_cast<std::size_t>(own)] + (own == state ? extra : 0.0);
      if (colour < filter_.size) seen += error_[static_cast<std::size_t>(colour)];
      out[c] = scale * seen;
      if (scale == 0.0) continue;
      for (Index j = 0; j < filter_.size; ++j)
        error_[static_cast<std::size_t>(j)] -= gain[j] * seen;
    }
  }

  /// Step i of the model.
  void carry(Index i) {
    const double* phi = record_.transition.col(i).data();
    for (Index j = 0; j < m_; ++j) {
      double sum = 0.0;
      for (Index k = 0; k < m_; ++k)
        sum += phi[j + m_ * k] * error_[static_cast<std::size_t>(k)];
      next_[static_cast<std::size_t>(j)] = sum;
    }
    for (Index j = m_; j < filter_.size; ++j)
      next_[static_cast<std::size_t>(j)] =
          filter_.colour_decay[static_cast<std::size_t>(j - m_)] *
          error_[static_cast<std::size_t>(j)];
    error_.swap(next_);
  }

  /// A rate in an equation over step i, with values at its begin, middle and end.
  void push(Index i, Index equation, double begin, double middle, double end) {
    const double* w = record_.response.col(i).data() + 3 * m_ * equation;
    for (Index j = 0; j < m_; ++j)
      error_[static_cast<std::size_t>(j)] +=
          w[j] * begin + w[m_ + j] * middle + w[2 * m_ + j] * end;
  }

 private:
  const LinearisedRecord& record_;
  const InnovationFilter& filter_;
  Index m_;
  std::vector<double> error_, next_;
};

void check(const InnovationFilter& filter, const LinearisedRecord& record, Index values,
           Index expected, const Eigen::Ref<Matrix>& out) {
  if (values != expected || out.rows() != filter.channels || out.cols() != record.samples())
    throw ArgumentError("column response", "the values do not fit the record",
                        "give one for each sample, and one for each step's middle");
}

}  // namespace

void column_response(const LinearisedRecord& record, const InnovationFilter& filter,
                     Index equation, const Eigen::Ref<const Vector>& values,
                     Eigen::Ref<Matrix> out) {
  check(filter, record, values.size(), 2 * record.samples() - 1, out);
  ErrorRecursion error(record, filter);
  for (Index i = 0; i < record.samples(); ++i) {
    error.measure(i, -1, 0.0, out.col(i).data());
    if (i + 1 == record.samples()) break;
    error.carry(i);
    error.push(i, equation, values[2 * i], values[2 * i + 1], values[2 * i + 2]);
  }
}

void channel_response(const LinearisedRecord& record, const InnovationFilter& filter,
                      Index state, const Eigen::Ref<const Vector>& values,
                      Eigen::Ref<Matrix> out) {
  check(filter, record, values.size(), record.samples(), out);
  ErrorRecursion error(record, filter);
  for (Index i = 0; i < record.samples(); ++i) {
    error.measure(i, state, values[i], out.col(i).data());
    if (i + 1 < record.samples()) error.carry(i);
  }
}

}  // namespace lacuna
