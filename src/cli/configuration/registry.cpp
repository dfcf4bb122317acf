// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/registry.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// Changes nothing: makes a stage with the options it has by default.
class KeepDefaults final : public OptionVisitor {
 public:
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

std::tuple<std::string_view, std::string_view> key(const RegistryEntry& entry) {
  return {entry.kind, entry.info.name};
}

}  // namespace

std::vector<std::string> Registry::kinds() const {
  std::vector<std::string> result;
  for (const RegistryEntry& entry : entries_)
    if (result.empty() || result.back() != entry.kind) result.emplace_back(entry.kind);
  return result;
}

std::vector<std::string> Registry::names(std::string_view kind) const {
  std::vector<std::string> result;
  for (const RegistryEntry& entry : entries_)
    if (entry.kind == kind) result.emplace_back(entry.info.name);
  return result;
}

const RegistryEntry& Registry::find(std::string_view kind, std::string_view name) const {
  for (const RegistryEntry& entry : entries_)
    if (entry.kind == kind && entry.info.name == name) return entry;
  const std::vector<std::string> known = names(kind);
  if (known.empty())
    throw ConfigError("registry", "there is no kind of part called '" + std::string(kind) + "'",
                      suggestion(kind, kinds()));
  throw ConfigError(std::string(kind),
                    "there is no " + std::string(kind) + " called '" + std::string(name) + "'",
                    suggestion(name, known));
}

void Registry::add_entry(RegistryEntry entry) {
  const auto place = std::lower_bound(
      entries_.begin(), entries_.end(), entry,
      [](const RegistryEntry& a, const RegistryEntry& b) { return key(a) < key(b); });
  if (place != entries_.end() && key(*place) == key(entry))
    throw ConfigError(std::string(entry.kind),
                      "the name '" + std::string(entry.info.name) + "' is registered already",
                      "give the part another name");
  entries_.insert(place, std::move(entry));
}

std::shared_ptr<const StageInterface> Registry::make_default(std::string_view kind,
                                                             std::string_view name) const {
  const RegistryEntry& entry = find(kind, name);
  if (!entry.unavailable.empty())
    throw ConfigError(std::string(kind),
                      "'" + std::string(name) + "' is unavailable: " + entry.unavailable,
                      "choose another; `lacuna list " + std::string(kind) + "` shows them");
  KeepDefaults keep;
  return entry.make(keep);
}

}  // namespace lacuna
