// SPDX-License-Identifier: MIT
#include "cli/configuration/variants.hpp"

#include "core/base/text.hpp"

namespace lacuna {
namespace {

using StagePointer = std::shared_ptr<const StageInterface>;

/// Lets plain options be and hands every stage inside a stage to a function, but for those of its
/// own kind: bases of bases have no end.
class NestedVisitor final : public IdleVisitor {
 public:
  using Visit = std::function<void(std::string_view kind, StagePointer& stage)>;
  NestedVisitor(std::string_view outer, Visit visit)
      : outer_(outer), visit_(std::move(visit)) {}

 protected:
  void nested_stage(const FieldInfo&, std::string_view kind, StagePointer& stage) override {
    if (kind != outer_) visit_(kind, stage);
  }

 private:
  std::string_view outer_;
  Visit visit_;
};

/// What to put into each nested stage, in order.
struct Filling {
  std::vector<StagePointer> stages;
  std::vector<std::string> labels;
  std::string unavailable;
};

std::vector<std::string> nested_kinds(const RegistryEntry& entry) {
  std::vector<std::string> kinds;
  NestedVisitor visitor(
      entry.kind, [&](std::string_view kind, StagePointer&) { kinds.emplace_back(kind); });
  entry.make(visitor);
  return kinds;
}

/// Every filling with one more nested stage of the given kind.
std::vector<Filling> extended(const std::vector<Filling>& fillings,
                              const std::vector<StageVariant>& choices) {
  std::vector<Filling> result;
  for (const Filling& filling : fillings) {
    for (const StageVariant& inner : choices) {
      Filling next = filling;
      next.stages.push_back(inner.stage);
      next.labels.push_back(inner.label);
      if (next.unavailable.empty()) next.unavailable = inner.unavailable;
      result.push_back(std::move(next));
    }
  }
  return result;
}

StageVariant make_variant(const RegistryEntry& entry, const Filling& filling) {
  StageVariant variant{std::string(entry.info.name), nullptr, entry.unavailable};
  if (!filling.labels.empty())
    variant.label.append("[").append(join(filling.labels, ",")).append("]");
  if (variant.unavailable.empty()) variant.unavailable = filling.unavailable;
  if (!variant.unavailable.empty()) return variant;
  std::size_t next = 0;
  NestedVisitor visitor(entry.kind, [&](std::string_view, StagePointer& stage) {
    stage = filling.stages[next++];
  });
  variant.stage = entry.make(visitor);
  return variant;
}

}  // namespace

std::vector<StageVariant> variants(const Registry& registry, std::string_view kind) {
  if (registry.names(kind).empty())
    throw ConfigError("registry", "there is no kind of part called '" + std::string(kind) + "'",
                      suggestion(kind, registry.kinds()));
  std::vector<StageVariant> result;
  for (const RegistryEntry& entry : registry.entries()) {
    if (entry.kind != kind) continue;
    std::vector<Filling> fillings(1);
    for (const std::string& inner : nested_kinds(entry))
      fillings = extended(fillings, variants(registry, inner));
    for (const Filling& filling : fillings) result.push_back(make_variant(entry, filling));
  }
  return result;
}

}  // namespace lacuna
