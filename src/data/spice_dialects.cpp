// SPDX-License-Identifier: MIT
// What circuit simulators write as text.
#include <algorithm>

#include "dialects.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/data/text_field.hpp"

namespace lacuna::dialects {
namespace {

std::vector<std::string> strings_of(const std::vector<std::string_view>& fields) {
  return {fields.begin(), fields.end()};
}

bool is_dashes(std::string_view line) {
  line = strip(line);
  return line.size() >= 10 && line.find_first_not_of('-') == std::string_view::npos;
}

bool all_numbers(const std::vector<std::string_view>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
    return read_field(field).kind == TextField::Kind::Number;
  });
}

/// Every second column repeats the first one.
bool repeats_time(const std::vector<std::string_view>& fields) {
  if (fields.size() < 4 || fields.size() % 2 != 0) return false;
  for (std::size_t i = 2; i < fields.size(); i += 2)
    if (fields[i] != fields[0]) return false;
  return true;
}

std::vector<std::string> without_repeats(const std::vector<std::string_view>& fields) {
  std::vector<std::string> kept{std::string(fields[0])};
  for (std::size_t i = 1; i < fields.size(); i += 2) kept.emplace_back(fields[i]);
  return kept;
}

}  // namespace

std::optional<PlainText> stepped_ltspice(std::string_view text) {
  constexpr std::string_view kStep = "Step Information:";
  if (text.find(kStep) == std::string_view::npos) return std::nullopt;
  PlainText plain{"", "taken for a stepped run of LTspice", "run"};
  Lines lines(text);
  int step = 0;
  bool named = false;
  while (const auto line = lines.next()) {
    if (line->substr(0, kStep.size()) == kStep) {
      ++step;
      plain.text += "\n";
      continue;
    }
    std::vector<std::string> fields = strings_of(fields_of(*line, '\t'));
    fields.push_back(named ? std::to_string(step) : "run");
    named = true;
    plain.text += strip(*line).empty() ? "\n" : joined_line(fields);
  }
  return plain;
}

std::optional<PlainText> ngspice_print(std::string_view text) {
  constexpr std::size_t kHead = 4096;  // in which the first page begins
  if (text.substr(0, kHead).find("\nIndex ") == std::string_view::npos) return std::nullopt;
  Lines lines(text);
  PlainText plain{"", "taken for a listing of ngspice"};
  std::optional<std::string_view> last, names;
  while (const auto line = lines.next()) {
    const std::string_view content = strip(*line);
    const auto fields = fields_of(content, ' ');
    if (names && !fields.empty() && all_numbers(fields)) {
      std::vector<std::string> row = strings_of(fields);
      row.erase(row.begin());  // the number of the point
      plain.text += joined_line(row);
    } else if (is_dashes(content) && last && last->substr(0, 5) == "Index" && !names) {
      names = last;
      std::vector<std::string> heads = strings_of(fields_of(*last, ' '));
      heads.erase(heads.begin());
      plain.text += joined_line(heads);
    } else {
      plain.text += "\n";  // titles, and heads that are repeated on every page
    }
    if (!content.empty() && !is_dashes(content)) last = content;
  }
  if (!names) return std::nullopt;
  return plain;
}

std::optional<PlainText> ngspice_wrdata(std::string_view text) {
  Lines probe(text);
  auto first = probe.next();
  if (!first || first->find(',') != std::string_view::npos) return std::nullopt;
  const auto heads = fields_of(*first, ' ');
  if (!repeats_time(heads)) return std::nullopt;
  const bool named = !all_numbers(heads);
  if (named && lower_case(heads[0]) != "time") return std::nullopt;
  std::string begin;
  if (!named) {
    begin = "t";
    for (std::size_t i = 1; i < heads.size(); i += 2) begin += ";c" + std::to_string(i + 1);
    begin += "\n";
  }
  PlainText plain{begin, "taken for data of ngspice (wrdata)", "", begin};
  Lines lines(text);
  while (const auto line = lines.next()) {
    const auto fields = fields_of(*line, ' ');
    if (fields.size() != heads.size()) return std::nullopt;
    plain.text += joined_line(without_repeats(fields));
  }
  return plain;
}

std::optional<PlainText> ngspice_raw(std::string_view text) {
  if (text.substr(0, 6) != "Title:" || text.find("\nVariables:") == std::string_view::npos ||
      text.find("\nValues:") == std::string_view::npos)
    return std::nullopt;
  std::vector<std::string> names, row;
  Lines lines(text);
  bool listing = false;
  while (const auto line = lines.next()) {
    if (line->substr(0, 7) == "Values:") break;
    if (listing) {
      const auto fields = fields_of(strip(*line), ' ');
      if (fields.size() > 1) names.emplace_back(fields[1]);
    }
    listing = listing || line->substr(0, 10) == "Variables:";
  }
  if (names.empty()) return std::nullopt;
  const std::string heads = joined_line(names);
  PlainText plain{heads, "taken for a raw file of ngspice or LTspice", "", heads};
  while (const auto line = lines.next()) {
    auto fields = fields_of(strip(*line), ' ');
    if (fields.empty()) continue;
    // The first value of a point stands behind the point's number.
    row.emplace_back(row.empty() && fields.size() > 1 ? fields[1] : fields[0]);
    if (row.size() < names.size()) continue;
    plain.text += joined_line(row);
    row.clear();
  }
  return plain;
}

}  // namespace lacuna::dialects
