// SPDX-License-Identifier: MIT
// Stages: named things with options, and handles on them.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// What is fixed about one option: everything `describe`, `--help` and the checks need.
struct FieldInfo {
  std::string_view name;           ///< as in the JSON configuration, snake_case
  std::string_view unit;           ///< "s", "samples"; "" for a pure number or text
  std::string_view text;           ///< one sentence
  std::optional<double> min = {};  ///< smallest allowed number, inclusive
  std::optional<double> max = {};  ///< largest allowed number, inclusive
};

/// Sees every field of an options aggregate, one call each, in order of declaration.
///
/// Options are plain aggregates with one member function that lists them once:
/// @code
///   struct StlsqOptions {
///     static constexpr StageInfo kInfo{"stlsq", "Sequentially ...", "Brunton et al. 2016"};
///     double threshold = 0.1;
///     void describe(OptionVisitor& v) {
///       v.field({"threshold", "", "Smaller coefficients are removed.", 0.0}, threshold);
///     }
///   };
/// @endcode
/// Reading from JSON, checking ranges, writing, and `--help` are visitors.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  /// One field with its present value, which the visitor may change.
  virtual void field(const FieldInfo& info, double& value) = 0;
  virtual void field(const FieldInfo& info, int& value) = 0;
  virtual void field(const FieldInfo& info, bool& value) = 0;
  virtual void field(const FieldInfo& info, std::string& value) = 0;
  virtual void field(const FieldInfo& info, std::optional<double>& value) = 0;
  virtual void field(const FieldInfo& info, std::optional<int>& value) = 0;
  virtual void field(const FieldInfo& info, std::vector<std::string>& value) = 0;

  /// An enumeration whose values 0, 1, ... have the given names, one for each.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void field(const FieldInfo& info, std::span<const std::string_view> names, Enum& value) {
    int index = static_cast<int>(value);
    choice(info, names, index);
    value = static_cast<Enum>(index);
  }

  /// A stage inside a stage, e.g. the differentiator of the strong form.
  template <class Interface>
  void field(const FieldInfo& info, Stage<Interface>& value) {
    std::shared_ptr<const StageInterface> stage = value.shared();
    nested_stage(info, Interface::kKind, stage);
    auto typed = std::dynamic_pointer_cast<const Interface>(std::move(stage));
    value = Stage<Interface>(std::move(typed));
  }

 protected:
  /// A named choice: `index` counts into `names`.
  virtual void choice(const FieldInfo& info, std::span<const std::string_view> names,
                      int& index) = 0;

  /// A nested stage of the given kind; a visitor that replaces it gives one of the same kind.
  virtual void nested_stage(const FieldInfo& info, std::string_view kind,
                            std::shared_ptr<const StageInterface>& stage) = 0;
};

/// Leaves every option as it is: the base of visitors that look at some kinds of fields only,
/// which override those and say `using IdleVisitor::field`.
class IdleVisitor : public OptionVisitor {
 public:
  using OptionVisitor::field;
  void field(const FieldInfo&, double&) override {}
  void field(const FieldInfo&, int&) override {}
  void field(const FieldInfo&, bool&) override {}
  void field(const FieldInfo&, std::string&) override {}
  void field(const FieldInfo&, std::optional<double>&) override {}
  void field(const FieldInfo&, std::optional<int>&) override {}
  void field(const FieldInfo&, std::vector<std::string>&) override {}

 protected:
  void choice(const FieldInfo&, std::span<const std::string_view>, int&) override {}
  void nested_stage(const FieldInfo&, std::string_view,
                    std::shared_ptr<const StageInterface>&) override {}
};

/// Checks one number against the range of its field.
/// @throws ConfigError naming the stage, the field, the value and the range.
void check_range(std::string_view stage, const FieldInfo& info, double value);

/// Visitor that checks the range of every number.
class RangeCheck final : public IdleVisitor {
 public:
  explicit RangeCheck(std::string_view stage) : stage_(stage) {}  ///< its name, for messages
  using IdleVisitor::field;
  void field(const FieldInfo& info, double& value) override;
  void field(const FieldInfo& info, int& value) override;
  void field(const FieldInfo& info, std::optional<double>& value) override;
  void field(const FieldInfo& info, std::optional<int>& value) override;

 protected:
  void choice(const FieldInfo& info, std::span<const std::string_view> names,
              int& index) override;

 private:
  std::string_view stage_;
};

/// The options, when every number lies in its range.
/// @throws ConfigError naming the field and its range.
template <class Options>
Options checked(Options options) {
  RangeCheck check(Options::kInfo.name);
  options.describe(check);
  return options;
}

/// Options of a stage that has none: `class Mine final : public Configured<Basis,
/// NoOptions<kMine>>` with `inline constexpr StageInfo kMine{"mine", "...", "..."};`.
template <const StageInfo& Info>
struct NoOptions {
  static constexpr const StageInfo& kInfo = Info;
  void describe(OptionVisitor&) {}
};

/// Gives a concrete stage its name and options, so that it only writes its hook:
/// `class Stlsq final : public Configured<Regressor, StlsqOptions>`.
/// `Options` is an aggregate with `kInfo` and `describe` (see OptionVisitor).
template <class Interface, class OptionsType>
class Configured : public Interface {
 public:
  using Options = OptionsType;

  /// @throws ConfigError when an option is out of its range.
  explicit Configured(Options options = {}) : options_(checked(std::move(options))) {}

  const Options& options() const noexcept { return options_; }  ///< as they were given
  const StageInfo& info() const final { return Options::kInfo; }

  void visit_options(OptionVisitor& visitor) const final {
    Options copy = options_;
    copy.describe(visitor);
  }

 private:
  Options options_;
};

}  // namespace lacuna
