// SPDX-License-Identifier: MIT
// Numbers, vectors and matrices, and references to functions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace lacuna {

/// Row, column and term numbers; signed, as everywhere in Eigen.
using Index = Eigen::Index;

/// A column of doubles.
using Vector = Eigen::VectorXd;

/// A dense column-major matrix of doubles.
using Matrix = Eigen::MatrixXd;

/// A set of term numbers (columns of Theta), strictly increasing.
using TermSet = std::vector<Index>;

/// The numbers of a column, as functions of plain sequences take them.
inline std::span<const double> as_span(const Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

template <class Signature>
class FunctionRef;

/// Non-owning reference to a callable: no allocation, one indirect call. The callable must
/// outlive it; use it for parameters only.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  // NOLINTBEGIN(google-explicit-constructor, bugprone-forwarding-reference-overload)
  /// Refers to a callable; the type of a parameter, so that the constructor is not explicit.
  template <class Callable>
  requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
           std::is_invocable_r_v<Result, Callable&, Arguments...>)
      FunctionRef(Callable&& callable)
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* object, Arguments... arguments) -> Result {
          using Target = std::remove_reference_t<Callable>;
          return (*static_cast<Target*>(object))(std::forward<Arguments>(arguments)...);
        }) {}
  // NOLINTEND(google-explicit-constructor, bugprone-forwarding-reference-overload)

  /// Calls it.
  Result operator()(Arguments... arguments) const {
    return call_(object_, std::forward<Arguments>(arguments)...);
  }

 private:
  void* object_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace lacuna
