// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// One registered part: its kind, its name and how to make it.
struct RegistryEntry {
  std::string_view kind;  ///< "regressor"
  StageInfo info;
  std::string
      unavailable;  ///< why it cannot be used here: "built without Ceres"; empty: it can

  /// Makes the stage with options that the visitor may change while it sees them.
  std::function<std::shared_ptr<const StageInterface>(OptionVisitor& visitor)> make;
};

/// Names and makers of all parts: an explicit object, no global. The command line, the JSON
/// configuration, `list`, `describe` and the contract tests are visitors of it.
class Registry {
 public:
  /// Adds a concrete stage (any class derived from Configured): its kind, name and options are
  /// taken from it. A stage that may be absent has a static `unavailable()` that says why.
  /// @param defaults its options where nobody says otherwise; must be given when they contain
  ///   another stage (`add<StrongForm>({.differentiator = FiniteDifferences{}})`).
  /// @throws ConfigError when the name is taken within its kind.
  template <class Concrete>
  void add(typename Concrete::Options defaults = {}) {
    std::string unavailable;
    if constexpr (requires { Concrete::unavailable(); }) unavailable = Concrete::unavailable();
    add_entry({Concrete::kKind, Concrete::Options::kInfo, std::move(unavailable),
               [defaults = std::move(defaults)](
                   OptionVisitor& visitor) -> std::shared_ptr<const StageInterface> {
                 typename Concrete::Options options = defaults;
                 options.describe(visitor);
                 return std::make_shared<const Concrete>(std::move(options));
               }});
  }

  /// All parts, ordered by kind and name.
  const std::vector<RegistryEntry>& entries() const noexcept { return entries_; }

  /// The kinds that have parts, in order.
  std::vector<std::string> kinds() const;

  /// Names of one kind, in order.
  std::vector<std::string> names(std::string_view kind) const;

  /// @throws ConfigError with the nearest name when there is no such part.
  const RegistryEntry& find(std::string_view kind, std::string_view name) const;

  /// A stage with its default options. @throws ConfigError when unknown or unavailable.
  template <class Interface>
  Stage<Interface> make(std::string_view name) const {
    return Stage<Interface>(
        std::dynamic_pointer_cast<const Interface>(make_default(Interface::kKind, name)));
  }

  /// Every part of a kind that can be used here, with its default options, ordered by name.
  template <class Interface>
  std::vector<Stage<Interface>> make_all() const {
    std::vector<Stage<Interface>> all;
    for (const RegistryEntry& entry : entries_)
      if (entry.kind == Interface::kKind && entry.unavailable.empty())
        all.push_back(make<Interface>(entry.info.name));
    return all;
  }

 private:
  void add_entry(RegistryEntry entry);
  std::shared_ptr<const StageInterface> make_default(std::string_view kind,
                                                     std::string_view name) const;
  std::vector<RegistryEntry> entries_;
};

/// A registry with every part that lacuna has.
Registry default_registry();

}  // namespace lacuna
