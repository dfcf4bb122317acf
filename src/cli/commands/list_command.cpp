// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "answers.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna::cli {
namespace {

/// One line of the list.
struct Line {
  std::string kind, name, text;
};

std::vector<Line> all_lines(const Registry& registry) {
  std::vector<Line> lines;
  for (const RegistryEntry& entry : registry.entries()) {
    std::string text(entry.info.summary);
    if (!entry.unavailable.empty()) text = "unavailable: " + entry.unavailable + ". " + text;
    lines.push_back({std::string(entry.kind), std::string(entry.info.name), std::move(text)});
  }
  for (const auto& [name, summary] : exports()) lines.push_back({"export", name, summary});
  for (const Preset& preset : presets())
    lines.push_back({"preset", preset.name, preset.summary});
  for (const TestSystem& system : test_systems())
    lines.push_back({"system", system.name, system.summary});
  return lines;
}

using Kind = std::vector<Line>;

/// Parts of one kind after those of another.
std::vector<Kind> by_kind(const std::vector<Line>& lines) {
  std::vector<Kind> kinds;
  for (const Line& line : lines) {
    if (kinds.empty() || kinds.back().front().kind != line.kind) kinds.emplace_back();
    kinds.back().push_back(line);
  }
  return kinds;
}

/// Whether a kind is no choice but a set of options with a name.
bool is_options(const Kind& kind) {
  return kind.size() == 1 && kind.front().name == kind.front().kind;
}

std::string names_in(const Kind& kind) {
  std::vector<std::string> names;
  for (const Line& line : kind) names.push_back(line.name);
  return join(names, ", ");
}

/// Kinds with the number of their parts, then sets of options.
std::string overview(const std::vector<Line>& lines) {
  std::string text, options;
  for (const Kind& kind : by_kind(lines)) {
    if (is_options(kind))
      options += (options.empty() ? "" : ", ") + kind.front().name;
    else
      text += kind.front().kind + " (" + std::to_string(kind.size()) + "): " + names_in(kind) +
              "\n";
  }
  return text + "\nSets of options: " + options +
         "\n\n`lacuna list KIND` shows what each part of a kind does, `lacuna describe NAME` the "
         "options of a part.\n";
}

std::string part_lines(const std::vector<Line>& lines, const std::string& kind) {
  std::size_t width = 0;
  for (const Line& line : lines)
    if (line.kind == kind) width = std::max(width, line.name.size() + 2);
  std::string text = kind + "\n";
  for (const Line& line : lines)
    if (line.kind == kind)
      text += "  " + line.name + std::string(width - line.name.size(), ' ') + line.text + "\n";
  return text;
}

void check_kind(const std::vector<Line>& lines, const std::string& kind) {
  std::vector<std::string> kinds;
  for (const Line& line : lines)
    if (kinds.empty() || kinds.back() != line.kind) kinds.push_back(line.kind);
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw ConfigError("list " + kind, "there is no kind of part called '" + kind + "'",
                      suggestion(kind, kinds));
}

}  // namespace

std::string list_of_parts(const Registry& registry, const std::string& kind) {
  const std::vector<Line> lines = all_lines(registry);
  if (kind.empty()) return overview(lines);
  check_kind(lines, kind);
  return part_lines(lines, kind);
}

Command declare_list() {
  auto kind = std::make_shared<std::string>();
  Command command{"list", "Show every part: bases, filters, regressors, ..."};
  command.add("KIND", kind.get(), "Only this kind of part");
  command.run = [kind](const Session& session) {
    show(session, list_of_parts(session.registry, *kind));
    return 0;
  };
  return command;
}

}  // namespace lacuna::cli
