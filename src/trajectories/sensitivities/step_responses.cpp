// SPDX-License-Identifier: MIT
// Transitions and responses of the steps of a record, four steps side by side.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/lanes.hpp"
#include "parabolas.hpp"
#include "trajectories/sensitivities/fixed_size.hpp"
#include "trajectories/sensitivities/record_steps.hpp"

namespace lacuna {
namespace {

/// What is to be done.
struct Task {
  const Matrix& slopes;
  const StepGrid& grid;
  const Vector& length;
  const StepSize& size;
  StepResponses& out;
};

/// What a product is added to, and how large the elements of its left factor are; null:
/// nothing, and not known.
struct Beside {
  const double* base;
  const double* size;
};

/// out = base + factor left right, with square matrices of four steps, row by row, a pack for
/// each element. Where it pays, elements that are 0 are passed over.
template <int Size>
LACUNA_INLINE void multiply(Index m, const Pack& factor, const double* left,
                            const double* right, const Beside& beside, double* out) {
  constexpr bool kFixed = Size != Eigen::Dynamic && Size <= 8;
  constexpr int kTogether = kFixed ? Size : 8;  // columns that are kept in registers
  for (Index i = 0; i < m; ++i)
    for (Index first = 0; first < m; first += kTogether) {
      const Index count = kFixed ? kTogether : std::min<Index>(kTogether, m - first);
      Pack total[kTogether] = {};
      if (beside.base)
        for (Index j = 0; j < count; ++j)
          total[j] = at<kLane>(beside.base + (i * m + first + j) * kLane).values;
      for (Index k = 0; k < m; ++k) {
        if (Size > 4 || Size == Eigen::Dynamic)
          if (beside.size && beside.size[i + m * k] == 0.0) continue;
        const Pack scaled = factor * at<kLane>(left + (i * m + k) * kLane).values;
        for (Index j = 0; j < count; ++j)
          total[j] += scaled * at<kLane>(right + (k * m + first + j) * kLane).values;
      }
      for (Index j = 0; j < count; ++j)
        at<kLane>(out + (i * m + first + j) * kLane).values = total[j];
    }
}

/// Four steps on their way: W_q is the response of the state to a rate that is the parabola q.
template <int Size>
class StepPack {
 public:
  LACUNA_INLINE explicit StepPack(const Task& task)
      : task_(task), states_(task.size.states), memory_(kSquares * room()), size_(elements()) {
    double* next = memory_.data();
    for (double** square : {&a_, &b_, &c_, &k2_, &k3_, &k4_, &whole_, &later_, &transition_,
                            &response_[0], &response_[1], &response_[2]}) {
      *square = next;
      next += room();
    }
  }

  /// Steps first, first + 1, ... first + 3; the last of the record stands in for those behind.
  LACUNA_INLINE void run(Index first) {
    for (Index lane = 0; lane < kLane; ++lane) {
      step_[lane] = std::min(first + lane, task_.length.size() - 1);
      length_[lane] = task_.length[step_[lane]] / task_.size.parts;
    }
    look_at_sizes();
    for (int part = 0; part < task_.size.parts; ++part) add_part(part);
    for (Index lane = 0; lane < kLane && first + lane < task_.length.size(); ++lane)
      write(lane);
  }

 private:
  using Factors = std::array<double, 3>;
  static constexpr int kSquares = 12;

  /// Numbers in so many squares.
  static constexpr int count_of(int squares) {
    return Size == Eigen::Dynamic ? Eigen::Dynamic : squares * Size * Size;
  }

  LACUNA_INLINE Index m() const { return Size == Eigen::Dynamic ? states_ : Size; }
  LACUNA_INLINE Index room() const { return m() * m() * kLane; }
  LACUNA_INLINE Index elements() const { return m() * m(); }

  /// The slopes at a fraction of the steps.
  LACUNA_INLINE void read_slope(double fraction, double* into) const {
    const double* a[kLane];
    for (Index lane = 0; lane < kLane; ++lane) a[lane] = slope_of(lane);
    const Index count = elements();
    if (fraction == 0.0 || fraction == 0.5 || fraction == 1.0) {
      const Index skip = fraction == 0.0 ? 0 : fraction == 0.5 ? count : 2 * count;
      for (Index i = 0; i < m(); ++i)
        for (Index j = 0; j < m(); ++j) {
          const Index e = i + m() * j + skip;
          at<kLane>(into + (i * m() + j) * kLane).values =
              Pack{a[0][e], a[1][e], a[2][e], a[3][e]};
        }
      return;
    }
    const Factors weight = parabolas(fraction);
    for (Index i = 0; i < m(); ++i)
      for (Index j = 0; j < m(); ++j) {
        Pack value = {};
        for (std::size_t node = 0; node < 3; ++node) {
          const Index e = i + m() * j + static_cast<Index>(node) * count;
          value += weight[node] * Pack{a[0][e], a[1][e], a[2][e], a[3][e]};
        }
        at<kLane>(into + (i * m() + j) * kLane).values = value;
      }
  }

  LACUNA_INLINE const double* slope_of(Index lane) const {
    return task_.slopes.data() + task_.grid.begin(step_[lane]) * elements();
  }

  /// How large the elements of the slopes are; most are 0 where many states act on few.
  LACUNA_INLINE void look_at_sizes() {
    if constexpr (Size != Eigen::Dynamic && Size <= 4) return;  // none is passed over
    const Index count = elements();
    for (Index e = 0; e < count; ++e) size_[e] = 0.0;
    for (Index lane = 0; lane < kLane; ++lane)
      for (Index node = 0; node < 3; ++node) {
        const double* a = slope_of(lane) + node * count;
        for (Index e = 0; e < count; ++e) size_[e] += std::abs(a[e]);
      }
  }

  /// Runge and Kutta for the transition, Simpson's rule for the responses.
  LACUNA_INLINE void add_part(int part) {
    const int parts = task_.size.parts;
    const double from = static_cast<double>(part) / parts, to = (part + 1.0) / parts;
    const double half = 0.5 * (from + to);
    if (part == 0)
      read_slope(from, a_);
    else
      std::swap(a_, c_);
    read_slope(half, b_);
    read_slope(to, c_);
    const Pack h = at<kLane>(length_).values;
    product(b_, 0.5 * h, b_, a_, k2_);
    product(b_, 0.5 * h, b_, k2_, k3_);
    product(c_, h, c_, k3_, k4_);
    for (Index e = 0; e < room(); e += kLane) {
      const Pack more = at<kLane>(a_ + e).values + 2.0 * at<kLane>(k2_ + e).values +
                        2.0 * at<kLane>(k3_ + e).values + at<kLane>(k4_ + e).values;
      at<kLane>(whole_ + e).values = h / 6.0 * more;
      at<kLane>(k2_ + e).values =
          0.25 * h * (at<kLane>(b_ + e).values + at<kLane>(c_ + e).values);
    }
    add_identity(whole_);
    product(k2_, Pack{} + 0.5, k2_, k2_, later_);
    add_identity(later_);
    const Factors first = parabolas(from), middle = parabolas(half), last = parabolas(to);
    for (std::size_t q = 0; q < 3; ++q)
      add_response(part, {first[q], 4.0 * middle[q], last[q]}, response_[q]);
    if (part == 0)
      std::swap(transition_, whole_);
    else
      carry(transition_);
  }

  LACUNA_INLINE void add_identity(double* square) const {
    for (Index i = 0; i < m(); ++i) at<kLane>(square + i * (m() + 1) * kLane).values += 1.0;
  }

  /// The response of one part behind those of the parts before it.
  LACUNA_INLINE void add_response(int part, const Factors& fraction, double*& response) {
    if (part > 0) carry(response);
    const Pack h = at<kLane>(length_).values / 6.0;
    for (Index e = 0; e < room(); e += kLane) {
      const Pack own = h * (fraction[0] * at<kLane>(whole_ + e).values +
                            fraction[1] * at<kLane>(later_ + e).values);
      if (part == 0)
        at<kLane>(response + e).values = own;
      else
        at<kLane>(response + e).values += own;
    }
    for (Index i = 0; i < m(); ++i)
      at<kLane>(response + i * (m() + 1) * kLane).values += h * fraction[2];
  }

  /// out = base + factor left right, with a left factor that is 0 where the slopes are.
  LACUNA_INLINE void product(const double* base, const Pack& factor, const double* left,
                             const double* right, double* out) const {
    multiply<Size>(m(), factor, left, right, {base, size_.data()}, out);
  }

  /// x -> whole x
  LACUNA_INLINE void carry(double*& x) {
    multiply<Size>(m(), Pack{} + 1.0, whole_, x, {nullptr, nullptr}, k4_);
    std::swap(x, k4_);
  }

  LACUNA_INLINE void write(Index lane) const {
    double* transition = task_.out.transition.data() + step_[lane] * elements();
    double* response = task_.out.response.data() + step_[lane] * 3 * elements();
    for (Index i = 0; i < m(); ++i)
      for (Index j = 0; j < m(); ++j) {
        const Index e = (i * m() + j) * kLane + lane;
        transition[i + m() * j] = transition_[e];
        for (std::size_t q = 0; q < 3; ++q)
          response[3 * m() * j + m() * static_cast<Index>(q) + i] = response_[q][e];
      }
  }

  const Task& task_;
  Index states_;
  Index step_[kLane] = {};
  alignas(32) double length_[kLane] = {};  ///< of a part
  /// Square matrices of four steps, row by row, a pack for each element.
  Numbers<count_of(kSquares* static_cast<int>(kLane))> memory_;
  double *a_, *b_, *c_, *k2_, *k3_, *k4_, *whole_, *later_, *transition_;
  std::array<double*, 3> response_;
  Numbers<count_of(1)> size_;
};

template <int Size>
LACUNA_INLINE void respond(const Task& task) {
  StepPack<Size> steps(task);
  for (Index first = 0; first < task.length.size(); first += kLane) steps.run(first);
}

template <int Size>
void respond_generic(const Task& task) {
  respond<Size>(task);
}

#ifdef LACUNA_KERNEL_DISPATCH
template <int Size>
[[gnu::target("avx2,fma")]] void respond_avx2(const Task& task) {
  respond<Size>(task);
}
#endif

}  // namespace

StepResponses step_responses(const Matrix& slopes, const StepGrid& grid, const Vector& length,
                             const StepSize& size) {
  const Index m = size.states;
  StepResponses out{Matrix(m * m, length.size()), Matrix(3 * m * m, length.size())};
  const Task task{slopes, grid, length, size, out};
  with_size(m, [&](auto fixed) {
#ifdef LACUNA_KERNEL_DISPATCH
    if (has_avx2()) return respond_avx2<fixed()>(task);
#endif
    respond_generic<fixed()>(task);
  });
  return out;
}

}  // namespace lacuna
