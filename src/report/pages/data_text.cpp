// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "readable.hpp"
#include "report/pages/data_summary.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

bool is_measured(const ChannelSummary& column) { return column.role != "not measured"; }

std::string range_text(const ChannelSummary& column) {
  if (!is_measured(column)) return "-";
  return format_number(column.least, 4) + " .. " + format_number(column.largest, 4);
}

std::string noise_text(const ChannelSummary& column) {
  if (!column.channel) return "";
  if (!column.channel->measured) return "made from others";
  const StateNoise& noise = column.channel->noise;
  if (noise.kind == NoiseKind::None) return "none seen";
  if (!std::isfinite(noise.sigma)) return "not known (values too large)";
  const double span = column.largest - column.least;
  const std::string fraction = span > 0.0 && std::isfinite(span)
                                   ? " (" + percent(noise.sigma / span) + " of the range)"
                                   : "";
  return format_number(noise.sigma, 2) + " " + to_string(noise.kind) + fraction;
}

/// What is odd about a column, or how it goes on between samples.
std::string remark_text(const ChannelSummary& column, const std::string& time_unit) {
  std::vector<std::string> parts;
  if (column.hold)
    parts.push_back(*column.hold == Hold::Zero ? "held between samples"
                                               : to_string(*column.hold) + " between samples");
  else if (is_measured(column) && !column.channel && column.least == column.largest)
    parts.push_back("never moves");
  if (column.signal_until)
    parts.push_back("signal up to " + format_number(*column.signal_until, 3) + " 1/" +
                    time_unit);
  if (column.channel) {
    const Channel& channel = *column.channel;
    if (channel.missing > 0.0) parts.push_back(percent(channel.missing) + " blank");
    const double clipped = channel.at_top + channel.at_bottom;
    if (clipped > 0.0) parts.push_back(percent(clipped) + " clipped");
    if (channel.noise.lattice)
      parts.push_back("steps of " + format_number(*channel.noise.lattice, 3));
  }
  return join(parts, ", ");
}

std::string record_line(const RecordSummary& record, const std::string& unit) {
  return "  " + record.source + ": " + std::to_string(record.samples) + " rows, " +
         format_number(record.begin, 6) + " .. " + format_number(record.end, 6) + " " + unit +
         ", step " + format_number(record.step, 4) + " " + unit +
         (record.uniform ? "" : " on average (not uniform)") + "\n";
}

Json to_json(const ChannelSummary& column) {
  Json json{
      {"name", column.quantity.name}, {"unit", column.quantity.unit}, {"role", column.role}};
  if (is_measured(column)) json["range"] = {column.least, column.largest};
  if (column.hold) json["hold"] = to_string(*column.hold);
  if (!column.channel) return json;
  const Channel& channel = *column.channel;
  json["measured"] = channel.measured;
  json["noise"] = {{"kind", to_string(channel.noise.kind)}, {"sigma", channel.noise.sigma}};
  json["signal_until"] = column.signal_until ? Json(*column.signal_until) : Json();
  json["lattice"] = channel.noise.lattice ? Json(*channel.noise.lattice) : Json();
  json["outliers"] = channel.noise.outliers;
  json["repeats"] = channel.repeats;
  json["missing"] = channel.missing;
  json["at_top"] = channel.at_top;
  json["at_bottom"] = channel.at_bottom;
  return json;
}

std::string columns_text(const std::vector<Quantity>& columns, std::size_t begin,
                         std::size_t end) {
  std::vector<std::string> names;
  for (std::size_t i = begin; i < end; ++i)
    names.push_back(with_unit(columns[i].name, columns[i].unit));
  return join(names, ", ");
}

/// "2500 rows, step 0.02 s", with the number of records where there are several.
std::string size_text(const Dataset& data) {
  std::string text = std::to_string(data.samples()) + " rows";
  if (data.trajectories.size() > 1)
    text += " in " + std::to_string(data.trajectories.size()) + " records";
  const Trajectory& longest = longest_record(data);
  if (longest.samples() < 2) return text;
  text += ", step " + format_number(mean_step(longest), 4) + " " + data.time_unit;
  return text + (uniform_step(longest) ? "" : " on average");
}

}  // namespace

std::string format_text(const DataSummary& summary) {
  std::string text = "Records\n";
  for (const RecordSummary& record : summary.records)
    text += record_line(record, summary.time_unit);
  std::vector<std::vector<std::string>> rows{{"column", "role", "range", "noise", ""}};
  for (const ChannelSummary& column : summary.channels)
    rows.push_back({with_unit(column.quantity.name, column.quantity.unit), column.role,
                    range_text(column), noise_text(column),
                    remark_text(column, summary.time_unit)});
  text += "\nColumns\n" + text_table(rows);
  if (!summary.hints.empty()) text += "\nHints\n";
  for (const Hint& hint : summary.hints)
    text +=
        "  " + to_string(hint.kind) + ": " + hint.message + ". Remedy: " + hint.remedy + ".\n";
  if (!summary.notes.empty()) text += "\nNotes\n";
  for (const std::string& note : said_once(summary.notes)) text += "  " + note + "\n";
  return text;
}

std::string format_json(const DataSummary& summary) {
  Json json{{"format", "lacuna.check/1"}, {"time_unit", summary.time_unit}};
  json["records"] = Json::array();
  for (const RecordSummary& record : summary.records)
    json["records"].push_back({{"source", record.source},
                               {"rows", record.samples},
                               {"begin", record.begin},
                               {"end", record.end},
                               {"step", record.step},
                               {"uniform", record.uniform}});
  json["columns"] = Json::array();
  for (const ChannelSummary& column : summary.channels)
    json["columns"].push_back(to_json(column));
  json["hints"] = Json::array();
  for (const Hint& hint : summary.hints)
    json["hints"].push_back(
        {{"kind", to_string(hint.kind)}, {"message", hint.message}, {"remedy", hint.remedy}});
  json["notes"] = summary.notes;
  return json_lines(json);
}

std::string data_line(const Dataset& data, Index known) {
  check_form(data);
  std::vector<std::string> files;
  for (const Trajectory& record : data.trajectories)
    if (const std::string file = short_name(file_of(record));
        files.empty() || files.back() != file)
      files.push_back(file);
  const auto inputs = static_cast<std::size_t>(std::clamp<Index>(known, 0, data.input_count()));
  std::vector<Quantity> seen, hidden;
  for (std::size_t k = 0; k < data.states.size(); ++k)
    (is_hidden(data, static_cast<Index>(k)) ? hidden : seen).push_back(data.states[k]);
  std::string line =
      briefly(files) + ": " + size_text(data) + "; states " + columns_text(seen, 0, seen.size());
  if (!hidden.empty()) line += "; not measured " + columns_text(hidden, 0, hidden.size());
  if (inputs > 0) line += "; inputs " + columns_text(data.inputs, 0, inputs);
  if (inputs < data.inputs.size())
    line += "; not used " + columns_text(data.inputs, inputs, data.inputs.size());
  return line;
}

}  // namespace lacuna
