// SPDX-License-Identifier: MIT
// What terms do to the innovations: the error of the filter when the record has a term and the
// filter does not know it. Several terms go through the record together.
#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "core/numerics/lanes.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"
#include "trajectories/sensitivities/fixed_size.hpp"

namespace lacuna {
namespace {

/// Terms that go together: what fits into the registers, and what a few need.
constexpr int kMany = 8, kFew = kLane;

/// One number for each of the terms that go together.
template <int Together>
struct TermLanes {
  static constexpr int kPacks = Together / static_cast<int>(kLane);
  InMemory<kLane> packs[kPacks];

  LACUNA_INLINE void add(double factor, const TermLanes& other) {
    for (int p = 0; p < kPacks; ++p) packs[p].values += factor * other.packs[p].values;
  }
};

/// Where the values of terms are, and where their responses go.
struct ResponseTask {
  const LinearisedRecord& record;
  const InnovationFilter& filter;
  Index place;  ///< equation or state
  const Eigen::Ref<const Matrix>& values;
  Eigen::Ref<Matrix>& out;
};

/// The filter's errors, one lane for each term: taken in by the measurements, carried on by the
/// model.
/// @tparam Size states and states of coloured noise, or Eigen::Dynamic.
/// @tparam Exact whether there is no coloured noise.
template <int Size, bool Exact, int Together>
class ErrorRecursion {
 public:
  using Terms = TermLanes<Together>;
  using Errors = std::conditional_t<Size == Eigen::Dynamic, std::vector<Terms>,
                                    std::array<Terms, static_cast<std::size_t>(Size)>>;

  LACUNA_INLINE ErrorRecursion(const ResponseTask& task, Index first)
      : record_(task.record),
        filter_(task.filter),
        count_(std::min<Index>(Together, task.values.cols() - first)),
        error_(zeros(task.filter.size)),
        next_(error_) {
    for (Index lane = 0; lane < Together; ++lane) {
      const Index column = first + std::min(lane, count_ - 1);
      values_[static_cast<std::size_t>(lane)] = task.values.col(column).data();
      out_[static_cast<std::size_t>(lane)] = task.out.col(column).data();
    }
  }

  /// The values of a row.
  LACUNA_INLINE void read(Index row, Terms& terms) const {
    for (int p = 0; p < Terms::kPacks; ++p) {
      const double* const* v = values_.data() + p * kLane;
      terms.packs[p].values = Pack{v[0][row], v[1][row], v[2][row], v[3][row]};
    }
  }

  /// Measurements of sample i; `extra` is added to what is measured of `state`.
  LACUNA_INLINE void measure(Index i, Index state, const Terms& extra) {
    const double* gain = filter_.gain.data() + i * filter_.channels * size();
    for (Index c = 0; c < filter_.channels; ++c, gain += size()) {
      const Index own = filter_.state_of_channel[static_cast<std::size_t>(c)];
      const double scale = filter_.inverse_deviation(c, i);
      Terms seen = error(own);
      if (own == state) seen.add(1.0, extra);
      if constexpr (!Exact) {
        const Index colour = filter_.colour_of_channel[static_cast<std::size_t>(c)];
        if (colour < size()) seen.add(1.0, error(colour));
      }
      write(i * filter_.channels + c, scale, seen);
      if (scale == 0.0) continue;
      for (Index j = 0; j < size(); ++j) error(j).add(-gain[j], seen);
    }
  }

  /// Step i of the model.
  LACUNA_INLINE void carry(Index i) {
    const double* phi = record_.transition.data() + i * states() * states();
    for (Index j = 0; j < states(); ++j) {
      Terms total = {};
      for (Index k = 0; k < states(); ++k) total.add(phi[j + states() * k], error(k));
      next(j) = total;
    }
    for (Index j = 0; j < states(); ++j) error(j) = next(j);
    for (Index j = states(); j < size(); ++j) {
      Terms total = {};
      total.add(filter_.colour_decay[static_cast<std::size_t>(j - states())], error(j));
      error(j) = total;
    }
  }

  /// Rates in an equation over step i, with values at its begin, middle and end.
  LACUNA_INLINE void push(Index i, Index equation, const Terms& begin, const Terms& middle,
                          const Terms& end) {
    const Index m = states();
    const double* w = record_.response.data() + (i * m + equation) * 3 * m;
    for (Index j = 0; j < m; ++j) {
      Terms& own = error(j);
      own.add(w[j], begin);
      own.add(w[m + j], middle);
      own.add(w[2 * m + j], end);
    }
  }

 private:
  LACUNA_INLINE Index size() const { return Size == Eigen::Dynamic ? filter_.size : Size; }
  LACUNA_INLINE Index states() const { return Exact ? size() : record_.states(); }

  LACUNA_INLINE Terms& error(Index j) { return error_[static_cast<std::size_t>(j)]; }
  LACUNA_INLINE Terms& next(Index j) { return next_[static_cast<std::size_t>(j)]; }

  static Errors zeros(Index size) {
    if constexpr (Size == Eigen::Dynamic)
      return Errors(static_cast<std::size_t>(size));
    else
      return {};
  }

  LACUNA_INLINE void write(Index row, double scale, const Terms& seen) {
    for (int p = 0; p < Terms::kPacks; ++p) {
      const Pack scaled = scale * seen.packs[p].values;
      double* const* out = out_.data() + p * kLane;
      for (int lane = 0; lane < kLane; ++lane)
        if (p * kLane + lane < count_) out[lane][row] = scaled[lane];
    }
  }

  const LinearisedRecord& record_;
  const InnovationFilter& filter_;
  Index count_;
  std::array<const double*, Together> values_;
  std::array<double*, Together> out_;
  Errors error_, next_;
};

template <int Size, bool Exact, int Together>
LACUNA_INLINE void rate_lanes(const ResponseTask& task, Index first) {
  ErrorRecursion<Size, Exact, Together> error(task, first);
  const LinearisedRecord& record = task.record;
  const TermLanes<Together> none = {};
  TermLanes<Together> begin = {}, middle = {}, end = {};
  error.read(0, begin);
  for (Index i = 0; i < record.samples(); ++i) {
    error.measure(i, -1, none);
    if (i + 1 == record.samples()) break;
    error.carry(i);
    error.read(record.grid.middle(i), middle);
    error.read(record.grid.end(i), end);
    error.push(i, task.place, begin, middle, end);
    if (record.grid.stride == 2)
      begin = end;
    else
      error.read(record.grid.begin(i + 1), begin);
  }
}

template <int Size, bool Exact, int Together>
LACUNA_INLINE void channel_lanes(const ResponseTask& task, Index first) {
  ErrorRecursion<Size, Exact, Together> error(task, first);
  TermLanes<Together> extra = {};
  for (Index i = 0; i < task.record.samples(); ++i) {
    error.read(i, extra);
    error.measure(i, task.place, extra);
    if (i + 1 < task.record.samples()) error.carry(i);
  }
}

/// Where terms act.
enum class Acting { OnRate, OnChannel };

/// All columns of the values, as many together as is good.
template <int Size, bool Exact, Acting Place>
LACUNA_INLINE void all_lanes(const ResponseTask& task) {
  const auto some = [&](Index first, auto together) __attribute__((always_inline)) {
    if constexpr (Place == Acting::OnRate)
      rate_lanes<Size, Exact, together()>(task, first);
    else
      channel_lanes<Size, Exact, together()>(task, first);
  };
  for (Index first = 0; first < task.values.cols(); first += kMany)
    if (task.values.cols() - first > kFew)
      some(first, std::integral_constant<int, kMany>{});
    else
      some(first, std::integral_constant<int, kFew>{});
}

template <int Size, bool Exact, Acting Place>
void respond_generic(const ResponseTask& task) {
  all_lanes<Size, Exact, Place>(task);
}

#ifdef LACUNA_KERNEL_DISPATCH
template <int Size, bool Exact, Acting Place>
[[gnu::target("avx2,fma")]] void respond_avx2(const ResponseTask& task) {
  all_lanes<Size, Exact, Place>(task);
}
#endif

template <int Size, bool Exact, Acting Place>
void respond_with(const ResponseTask& task) {
#ifdef LACUNA_KERNEL_DISPATCH
  if (has_avx2()) return respond_avx2<Size, Exact, Place>(task);
#endif
  respond_generic<Size, Exact, Place>(task);
}

template <Acting Place>
void respond(const ResponseTask& task) {
  with_size(task.filter.size, [&](auto size) {
    if constexpr (size() != Eigen::Dynamic)
      if (task.filter.size == task.record.states())
        return respond_with<size(), true, Place>(task);
    respond_with<size(), false, Place>(task);
  });
}

void check(const InnovationFilter& filter, const LinearisedRecord& record,
           const Eigen::Ref<const Matrix>& values, Index expected,
           const Eigen::Ref<Matrix>& out) {
  if (values.rows() != expected || out.rows() != filter.channels * record.samples() ||
      out.cols() != values.cols())
    throw ArgumentError("column response", "the values do not fit the record",
                        "give one for each sample, and one for each step's middle");
}

}  // namespace

void column_response(const LinearisedRecord& record, const InnovationFilter& filter,
                     Index equation, const Eigen::Ref<const Matrix>& values,
                     Eigen::Ref<Matrix> out) {
  check(filter, record, values, record.grid.rows(record.samples()), out);
  respond<Acting::OnRate>({record, filter, equation, values, out});
}

void channel_response(const LinearisedRecord& record, const InnovationFilter& filter,
                      Index state, const Eigen::Ref<const Matrix>& values,
                      Eigen::Ref<Matrix> out) {
  check(filter, record, values, record.samples(), out);
  respond<Acting::OnChannel>({record, filter, state, values, out});
}

}  // namespace lacuna
