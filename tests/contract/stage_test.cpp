// SPDX-License-Identifier: MIT
// What every registered part owes: words for all that it has, defaults that work, options that
// survive the way through JSON.
#include <algorithm>
#include <set>

#include "cli/configuration/description.hpp"
#include "cli/configuration/diagnosis_configuration.hpp"
#include "cli/configuration/identification_configuration.hpp"
#include "contract/contract.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "report/json/stage_json.hpp"

namespace lacuna::contract {
namespace {

/// Gives every plain option another value that is allowed.
class ChangeOptions final : public OptionVisitor {
 public:
  void field(const FieldInfo& info, double& value) override { change(info, value); }
  void field(const FieldInfo& info, int& value) override {
    for (const int step : {2, -2, 1, -1}) {
      const double other = value + step;
      if ((info.min && other < *info.min) || (info.max && other > *info.max)) continue;
      value += step;
      return;
    }
  }
  void field(const FieldInfo&, bool& value) override { value = !value; }
  void field(const FieldInfo&, std::string& value) override { value += "x"; }
  void field(const FieldInfo& info, std::optional<double>& value) override {
    value = value.value_or(info.min.value_or(0.25));
    change(info, *value);
  }
  void field(const FieldInfo& info, std::optional<int>& value) override {
    // Odd where the least one is: a window has a middle, and is longer than a degree.
    const int least = value.value_or(info.min ? static_cast<int>(*info.min) : 1);
    value = info.max && least + 8 > *info.max ? least + 2 : least + 8;
  }
  void field(const FieldInfo&, std::vector<std::string>& value) override {
    value.push_back("x*y");
  }

 protected:
  void choice(const FieldInfo&, std::span<const std::string_view> names, int& index) override {
    index = (index + 1) % static_cast<int>(names.size());
  }
  void nested_stage(const FieldInfo&, std::string_view,
                    std::shared_ptr<const StageInterface>&) override {}

 private:
  static void change(const FieldInfo& info, double& value) {
    const double other = value == 0.0 ? 0.125 : value / 3.0;
    value = info.min && other < *info.min ? 0.5 * (*info.min + info.max.value_or(1.0)) : other;
  }
};

/// The stage that a configuration makes of {"type": ..., options}.
std::string through_configuration(const std::string& kind, const std::string& json) {
  Configuration configuration;
  if (kind == "l1-solver")
    configuration.merge_text(R"({"regressor": {"type": "irls-l1", "inner": )" + json + "}}",
                             "t");
  else
    configuration.merge_text("{\"" + kind + "\": " + json + "}", "t");
  return format_pipeline(configuration.build(default_registry()));
}

/// The part of a diagnosis that a configuration makes of its JSON.
std::string through_diagnosis(const std::string& kind, const RegistryEntry& entry,
                              const std::string& json) {
  Configuration configuration;
  configuration.merge_text(kind == "hypothesis"
                               ? "{\"hypotheses\": [\"" + std::string(entry.info.name) + "\"]}"
                               : "{\"" + kind + "\": " + json + "}",
                           "t");
  const DiagnosisOptions options = diagnosis_options(configuration, default_registry());
  if (kind == "criterion") return format_stage(*options.criterion);
  if (kind == "decision") return format_stage(StandardDecision(options.decision));
  return format_stage(*options.hypotheses.at(0));
}

/// The options of `identify` that a configuration makes of their JSON.
std::string through_identification(const std::string& kind, const std::string& json) {
  Configuration configuration;
  configuration.merge_text("{\"" + kind + "\": " + json + "}", "t");
  const IdentificationOptions options =
      identification_options(configuration, default_registry());
  if (kind == "library") return format_stage(Rules<LibraryOptions>(options.library));
  if (kind == "forms") return format_stage(Rules<FormOptions>(options.forms));
  if (kind == "dead-time") return format_stage(Rules<DeadTimeOptions>(options.dead_time));
  if (kind == "plain-structure")
    return format_stage(Rules<PlainStructureOptions>(options.plain_structure));
  if (kind == "validation") return format_stage(Rules<ValidationOptions>(options.validation));
  if (kind == "relations") return format_stage(Rules<RelationOptions>(options.relations));
  if (kind == "map") return format_stage(Rules<MapHintOptions>(options.map));
  if (kind == "sync") return format_stage(Rules<SyncVerdictOptions>(options.sync));
  return format_stage(Rules<AdviceOptions>(options.advice));
}

bool is_of_identification(const std::string& kind) {
  return kind == "library" || kind == "forms" || kind == "dead-time" ||
         kind == "plain-structure" || kind == "validation" || kind == "relations" ||
         kind == "advice" || kind == "map" || kind == "sync";
}

bool is_of_diagnosis(const std::string& kind) {
  return kind == "criterion" || kind == "decision" || kind == "hypothesis";
}

/// The JSON of a part, read back.
std::string read_back(const RegistryEntry& entry, const std::string& json) {
  const std::string kind(entry.kind);
  if (is_of_diagnosis(kind)) return through_diagnosis(kind, entry, json);
  if (is_of_identification(kind)) return through_identification(kind, json);
  return through_configuration(kind, json);
}

class EveryPart : public testing::TestWithParam<RegistryEntry> {};

TEST_P(EveryPart, SaysWhatItIs) {
  const RegistryEntry& entry = GetParam();
  EXPECT_FALSE(entry.info.name.empty());
  EXPECT_EQ(entry.info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
            std::string_view::npos);
  EXPECT_GT(entry.info.summary.size(), 15u);
}

TEST_P(EveryPart, ExplainsEveryOption) {
  std::set<std::string> names;
  for (const OptionDescription& option : describe_options(GetParam())) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name << " twice";
    EXPECT_GT(option.text.size(), 8u) << option.name;
  }
}

TEST_P(EveryPart, IsMadeWithItsDefaultsOrSaysWhyNot) {
  const RegistryEntry& entry = GetParam();
  const auto all = variants(default_registry(), entry.kind);
  for (const StageVariant& variant : all) {
    if (variant.label != entry.info.name) continue;
    EXPECT_EQ(variant.stage == nullptr, !variant.unavailable.empty());
    EXPECT_EQ(variant.unavailable, entry.unavailable);
  }
}

class EveryConfigurablePart : public testing::TestWithParam<RegistryEntry> {};

TEST_P(EveryConfigurablePart, OptionsSurviveJson) {
  const RegistryEntry& entry = GetParam();
  ChangeOptions change;
  const std::string changed = format_stage(*entry.make(change));
  const std::string found = read_back(entry, changed);
  EXPECT_NE(found.find(changed), std::string::npos) << changed;
}

std::string part_name(const testing::TestParamInfo<RegistryEntry>& part) {
  std::string name = std::string(part.param.kind) + "_" + std::string(part.param.info.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Parts that a configuration of this build may name, with options.
std::vector<RegistryEntry> configurable_parts() {
  std::vector<RegistryEntry> parts = default_registry().entries();
  std::erase_if(parts, [](const RegistryEntry& entry) {
    return entry.kind == "integrator" || entry.kind == "effect" || !entry.unavailable.empty();
  });
  return parts;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryConfigurablePart,
                         testing::ValuesIn(configurable_parts()), part_name);
INSTANTIATE_TEST_SUITE_P(Registry, EveryPart, testing::ValuesIn(default_registry().entries()),
                         part_name);

}  // namespace
}  // namespace lacuna::contract
