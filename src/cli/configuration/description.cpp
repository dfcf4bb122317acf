// SPDX-License-Identifier: MIT
#include "cli/configuration/description.hpp"

#include <sstream>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

std::string range_text(const FieldInfo& info) {
  if (info.min && info.max) return format_number(*info.min) + " .. " + format_number(*info.max);
  if (info.min) return ">= " + format_number(*info.min);
  return info.max ? "<= " + format_number(*info.max) : "";
}

/// Puts every option into words.
class Describer final : public OptionVisitor {
 public:
  void field(const FieldInfo& info, double& value) override {
    add(info, "number", format_number(value));
  }
  void field(const FieldInfo& info, int& value) override {
    add(info, "whole number", std::to_string(value));
  }
  void field(const FieldInfo& info, bool& value) override {
    add(info, "true or false", value ? "true" : "false");
  }
  void field(const FieldInfo& info, std::string& value) override { add(info, "text", value); }
  void field(const FieldInfo& info, std::optional<double>& value) override {
    add(info, "number or none", value ? format_number(*value) : "none");
  }
  void field(const FieldInfo& info, std::optional<int>& value) override {
    add(info, "whole number or none", value ? std::to_string(*value) : "none");
  }
  void field(const FieldInfo& info, std::vector<std::string>& value) override {
    add(info, "list of texts", value.empty() ? "none" : join(value, ", "));
  }

  std::vector<OptionDescription> take() { return std::move(options_); }

 protected:
  void choice(const FieldInfo& info, std::span<const std::string_view> names,
              int& index) override {
    const std::vector<std::string> all(names.begin(), names.end());
    add(info, "one of " + join(all, ", "), all[static_cast<std::size_t>(index)]);
  }
  void nested_stage(const FieldInfo& info, std::string_view kind,
                    std::shared_ptr<const StageInterface>& stage) override {
    add(info, std::string(kind), std::string(stage->info().name));
  }

 private:
  void add(const FieldInfo& info, std::string type, std::string value) {
    options_.push_back({std::string(info.name), std::move(type), std::string(info.unit),
                        range_text(info), std::move(value), std::string(info.text)});
  }
  std::vector<OptionDescription> options_;
};

std::string option_line(const OptionDescription& option) {
  std::string line = "  " + option.name + "  (" + option.type;
  if (!option.unit.empty()) line += ", " + option.unit;
  if (!option.range.empty()) line += ", " + option.range;
  return line + "; default " + (option.value.empty() ? "empty" : option.value) + ")\n      " +
         option.text + "\n";
}

}  // namespace

std::vector<OptionDescription> describe_options(const RegistryEntry& entry) {
  Describer describer;
  entry.make(describer);
  return describer.take();
}

std::vector<OptionDescription> describe_options(const StageInterface& stage) {
  Describer describer;
  stage.visit_options(describer);
  return describer.take();
}

std::string format_description(const RegistryEntry& entry) {
  std::ostringstream out;
  out << entry.info.name << " (" << entry.kind << ")\n  " << entry.info.summary << "\n";
  if (!entry.info.reference.empty()) out << "  Source: " << entry.info.reference << "\n";
  if (!entry.unavailable.empty()) out << "  Unavailable: " << entry.unavailable << "\n";
  const std::vector<OptionDescription> options = describe_options(entry);
  out << (options.empty() ? "It has no options.\n" : "Options:\n");
  for (const OptionDescription& option : options) out << option_line(option);
  return out.str();
}

}  // namespace lacuna
