// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

class OptionVisitor;

/// What is fixed about a concrete stage: its registered name, a sentence, where it comes from.
struct StageInfo {
  std::string_view name;       ///< registered name, lower case with hyphens: "irls-l1"
  std::string_view summary;    ///< one sentence for `list` and `describe`
  std::string_view reference;  ///< the source, with equation number where there is one
};

/// Common base of every plug point (Basis, Regressor, ...): a named thing with options.
///
/// A plug point derives from it, adds `static constexpr std::string_view kKind`, a public
/// non-virtual method that checks its arguments, and one private virtual hook.
class StageInterface {
 public:
  virtual ~StageInterface() = default;

  /// Name, summary and source of this stage.
  virtual const StageInfo& info() const = 0;

  /// Shows every option with its present value to the visitor.
  virtual void visit_options(OptionVisitor& visitor) const = 0;

 protected:
  StageInterface() = default;
  StageInterface(const StageInterface&) = default;
  StageInterface& operator=(const StageInterface&) = default;
};

/// Value handle on a stage: shared, immutable, never null; cheap to copy, safe to share
/// between threads. Made by the functions of the shelves, `Stage<Regressor> r =
/// stlsq({.threshold = 0.1});`, by Registry::make(), and from any object of a class of one's
/// own.
template <class Interface>
class Stage {
 public:
  /// Takes over a concrete stage.
  template <std::derived_from<Interface> Concrete>
  Stage(Concrete stage)  // NOLINT(google-explicit-constructor): a stage is its own handle
      : pointer_(std::make_shared<const Concrete>(std::move(stage))) {}

  /// Shares an existing stage.
  /// @throws ArgumentError when the pointer is null.
  explicit Stage(std::shared_ptr<const Interface> stage) : pointer_(std::move(stage)) {
    if (!pointer_) throw ArgumentError(std::string(Interface::kKind), "no stage given", "");
  }

  const Interface* operator->() const noexcept { return pointer_.get(); }  ///< the stage
  const Interface& operator*() const noexcept { return *pointer_; }        ///< the stage

  /// The stage, where a function takes one for the time of a call.
  operator const Interface&() const noexcept {  // NOLINT(google-explicit-constructor): as above
    return *pointer_;
  }

  /// The shared object, for code that handles stages of any kind.
  const std::shared_ptr<const Interface>& shared() const noexcept { return pointer_; }

 private:
  std::shared_ptr<const Interface> pointer_;
};

}  // namespace lacuna
