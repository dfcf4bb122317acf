// SPDX-License-Identifier: MIT
// Oscilloscopes whose files are no plain tables.
#include <array>
#include <cmath>

#include "core/base/text.hpp"
#include "data/records/text_field.hpp"
#include "dialects.hpp"
#include "text_layout.hpp"

namespace lacuna::dialects {
namespace {

std::optional<double> number(std::string_view field) {
  const TextField found = read_field(field);
  if (found.kind != TextField::Kind::Number) return std::nullopt;
  return found.value;
}

std::string with_unit(std::string_view name, std::string_view word) {
  const std::string symbol = unit_symbol(word);
  return std::string(name) + (symbol.empty() ? "" : " [" + symbol + "]");
}

/// Which fields of a Rigol's header are what.
struct RigolHeader {
  std::vector<std::string_view> names;
  std::size_t start = 0, increment = 0;
};

std::optional<RigolHeader> rigol_header(std::string_view line) {
  RigolHeader header{fields_of(line, ',')};
  if (header.names.size() < 4 || lower_case(header.names[0]) != "x") return std::nullopt;
  for (std::size_t i = 1; i < header.names.size(); ++i) {
    const std::string name = lower_case(header.names[i]);
    if (name == "start") header.start = i;
    if (name == "increment") header.increment = i;
  }
  if (header.start < 2 || header.increment != header.start + 1) return std::nullopt;
  return header;
}

}  // namespace

std::optional<TextDialect> rigol(std::string_view begin) {
  Lines lines(begin);
  const auto first = lines.next();
  const auto header = first ? rigol_header(*first) : std::nullopt;
  if (!header) return std::nullopt;
  const auto second = lines.next();
  if (!second) return std::nullopt;
  const auto units = fields_of(*second, ',');
  if (units.size() <= header->increment) return std::nullopt;
  const auto start = number(units[header->start]), step = number(units[header->increment]);
  if (!start || !step) return std::nullopt;

  std::vector<std::string> names{"t [s]"};
  for (std::size_t i = 1; i < header->start; ++i)
    names.push_back(with_unit(header->names[i], units[i]));
  const std::vector<std::string> heads{joined_line(names), "\n"};
  const auto translate = [heads, next = std::size_t{0}, channels = header->start,
                          start = *start,
                          step = *step](std::string_view line, std::string& text) mutable {
    if (next < heads.size()) {
      text += heads[next++];
      return;
    }
    const auto fields = fields_of(line, ',');
    const auto count = number(fields[0]);
    if (!count || fields.size() < channels) {
      text.append(line) += '\n';  // the reader says what is wrong with it
      return;
    }
    std::vector<std::string> row{format_number(start + *count * step)};
    for (std::size_t i = 1; i < channels; ++i) row.emplace_back(fields[i]);
    text += joined_line(row);
  };
  return TextDialect{"taken for a record of a Rigol oscilloscope", translate};
}

std::optional<TextDialect> tektronix(std::string_view begin) {
  if (begin.substr(0, 14) != "Record Length,") return std::nullopt;
  std::string name = "CH1", unit, time_unit = "s";
  Lines lines(begin);
  while (const auto line = lines.next()) {
    const auto fields = fields_of(*line, ',');
    if (fields.size() < 5) return std::nullopt;  // a preamble above the samples
    if (!number(fields[3]) || !number(fields[4])) return std::nullopt;
    if (fields[0] == "Source") name = fields[1];
    if (fields[0] == "Vertical Units") unit = fields[1];
    if (fields[0] == "Horizontal Units") time_unit = unit_symbol(fields[1]);
  }
  const auto translate = [](std::string_view line, std::string& text) {
    const auto fields = fields_of(line, ',');
    if (fields.size() < 5)
      text.append(line) += '\n';  // the reader says what is wrong with it
    else
      text += joined_line({std::string(fields[3]), std::string(fields[4])});
  };
  return TextDialect{"taken for a record of a Tektronix oscilloscope", translate, "",
                     joined_line({"t [" + (time_unit.empty() ? "s" : time_unit) + "]",
                                  name + (unit.empty() ? "" : " [" + unit + "]")})};
}

}  // namespace lacuna::dialects
