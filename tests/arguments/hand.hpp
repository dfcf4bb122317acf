// SPDX-License-Identifier: MIT
// Calls of functions with arguments that are chosen by number: what generate.cpp writes.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna::arguments {

/// A value of a type with what it is called.
template <class T>
struct Choice {
  std::string name;
  T value;
  bool is_finite = true;  ///< and can be squared
};

/// The values of a type to try, the first one being what a caller should give: values.hpp.
template <class T>
struct Choices;

/// What is kept of an argument of a type: the sequence of a span, the stage of an interface.
template <class T>
struct Kept {
  using Type = T;
};
template <class T>
struct Kept<Eigen::Ref<T>> {
  using Type = std::remove_const_t<T>;
};
template <class T>
struct Kept<std::span<T>> {
  using Type = std::vector<std::remove_const_t<T>>;
};
template <>
struct Kept<std::string_view> {
  using Type = std::string;
};
template <std::derived_from<StageInterface> T>
requires std::is_abstract_v<T>
struct Kept<T> {
  using Type = Stage<T>;
};
template <class T>
requires(std::is_abstract_v<T> && !std::derived_from<T, StageInterface>) struct Kept<T> {
  using Type = std::shared_ptr<const T>;
};
template <class Parameter>
using KeptFor = typename Kept<std::remove_cvref_t<Parameter>>::Type;

/// The members of a struct that are to be finite: generate.cpp.
template <class T>
struct Fields;

template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::true_type {};
template <class T>
struct IsSequence<std::optional<T>> : std::false_type {};

/// Whether all numbers in a value are finite, as far as they can be seen. Records are the
/// caller's: check_dataset() looks at them.
template <class T>
bool finite(const T& value) {
  const auto all = [](const auto& part) { return finite(part); };
  if constexpr (std::is_same_v<T, Dataset> || std::is_same_v<T, Trajectory>) {
    return true;
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(value);
  } else if constexpr (std::is_base_of_v<Eigen::DenseBase<T>, T>) {
    return value.allFinite();
  } else if constexpr (IsSequence<T>::value) {
    for (const auto& part : value)
      if (!finite(part)) return false;
    return true;
  } else if constexpr (requires {
                         value.has_value();
                         *value;
                       }) {
    return !value.has_value() || finite(*value);
  } else if constexpr (requires { Fields<T>::all(value, all); }) {
    return Fields<T>::all(value, all);
  } else {
    return true;
  }
}

/// Gives a function its arguments: number picks[i] of the choices for parameter i.
class Hand {
 public:
  explicit Hand(std::vector<std::size_t> picks) : picks_(std::move(picks)) {}

  template <class Parameter>
  decltype(auto) take(std::size_t i) {
    using Value = KeptFor<Parameter>;
    static const std::vector<Choice<Value>> choices = Choices<Value>::all();
    const std::size_t pick = i < picks_.size() ? picks_[i] : 0;
    const Choice<Value>& choice = choices[pick % choices.size()];
    if (sizes_.size() <= i) sizes_.resize(i + 1);
    if (names_.size() <= i) names_.resize(i + 1);
    sizes_[i] = choices.size();
    names_[i] = choice.name;
    are_finite_ = are_finite_ && choice.is_finite;
    const auto kept = std::make_shared<Value>(choice.value);
    kept_.push_back(kept);
    return given<Parameter>(*kept);
  }

  const std::vector<std::size_t>& sizes() const {
    return sizes_;
  }  ///< choices of each parameter
  const std::vector<std::string>& names() const { return names_; }
  bool are_finite() const { return are_finite_; }

 private:
  template <class Parameter, class Value>
  static decltype(auto) given(Value& value) {
    using Plain = std::remove_cvref_t<Parameter>;
    if constexpr (requires { value == nullptr; } && std::is_abstract_v<Plain>)
      if (value == nullptr) throw ArgumentError("arguments", "no object is given", "");
    if constexpr (std::is_abstract_v<Plain>)
      return static_cast<const Plain&>(*value);
    else if constexpr (std::is_rvalue_reference_v<Parameter>)
      return std::move(value);
    else
      return static_cast<Value&>(value);
  }

  std::vector<std::size_t> picks_, sizes_;
  std::vector<std::string> names_;
  bool are_finite_ = true;
  std::vector<std::shared_ptr<void>> kept_;
};

/// A public function.
struct Call {
  std::string header, name;
  bool may_be_infinite = false;  ///< its docstring speaks of NaN or of infinity
  bool passes_on = false;        ///< its header says that it makes such numbers of such numbers

  /// Makes the call. @return whether what it gives is finite. Empty: some type has no choices.
  std::function<bool(Hand&)> run;
};

template <class... Parameters, class Function>
Call call(std::string header, std::string name, bool may_be_infinite, bool passes_on,
          Function function) {
  Call result{std::move(header), std::move(name), may_be_infinite, passes_on, {}};
  if constexpr ((requires { Choices<KeptFor<Parameters>>::all(); } && ...))
    result.run = [function](Hand& hand) {
      if constexpr (std::is_void_v<decltype(function(hand))>) {
        function(hand);
        return true;
      } else {
        return finite(function(hand));
      }
    };
  return result;
}

}  // namespace lacuna::arguments
