// SPDX-License-Identifier: MIT
#include "lacuna/data/formats/write.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/file_bytes.hpp"

namespace lacuna {
namespace {

void append_number(std::string& text, double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
}

void append_comment(std::string& text, std::string_view comment) {
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    text += "# ";
    text += comment.substr(0, end);
    text += '\n';
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
}

std::string header_of(const Quantity& quantity) {
  return quantity.unit.empty() ? quantity.name : quantity.name + " [" + quantity.unit + "]";
}

/// A name that no other column has: the wanted one, with underscores behind it if need be.
std::string free_name(std::string name, const Dataset& data) {
  const auto taken = [&](const Quantity& quantity) { return quantity.name == name; };
  while (std::any_of(data.states.begin(), data.states.end(), taken) ||
         std::any_of(data.inputs.begin(), data.inputs.end(), taken))
    name += '_';
  return name;
}

/// dx/dt as a column: name "dx", unit of the state over that of time.
Quantity rate_of(const Quantity& state, const Dataset& data) {
  Quantity rate{free_name("d" + state.name, data), ""};
  const bool compound = state.unit.find_first_of(" /") != std::string::npos;
  if (!state.unit.empty())
    rate.unit = (compound ? "(" + state.unit + ")" : state.unit) + "/" + data.time_unit;
  return rate;
}

std::string header_line(const Dataset& data, bool numbered) {
  std::vector<std::string> headers;
  if (numbered) headers.push_back(free_name("trajectory", data));
  headers.push_back(header_of({"t", data.time_unit}));
  for (const Quantity& state : data.states) headers.push_back(header_of(state));
  for (const Quantity& input : data.inputs) headers.push_back(header_of(input));
  if (data.has_derivatives())
    for (const Quantity& state : data.states)
      headers.push_back(header_of(rate_of(state, data)));
  return join(headers, ",") + "\n";
}

void append_values(std::string& text, const Matrix& values, Index row) {
  for (Index column = 0; column < values.cols(); ++column) {
    text += ',';
    append_number(text, values(row, column));
  }
}

void append_trajectory(std::string& text, const Trajectory& trajectory,
                       const std::string& number, bool derivatives) {
  for (Index row = 0; row < trajectory.samples(); ++row) {
    text += number;
    append_number(text, trajectory.time[row]);
    append_values(text, trajectory.states, row);
    append_values(text, trajectory.inputs, row);
    if (derivatives) append_values(text, trajectory.derivatives, row);
    text += '\n';
  }
}

}  // namespace

std::string format_csv(const Dataset& data, const std::string& comment) {
  const bool numbered = data.trajectories.size() > 1;
  std::string text;
  append_comment(text, comment);
  text += header_line(data, numbered);
  for (std::size_t i = 0; i < data.trajectories.size(); ++i)
    append_trajectory(text, data.trajectories[i], numbered ? std::to_string(i + 1) + "," : "",
                      data.has_derivatives());
  return text;
}

void write_csv(const std::filesystem::path& path, const Dataset& data,
               const std::string& comment) {
  const std::string text = format_csv(data, comment);
  write_file_atomically(path, path.extension() == ".gz" ? gzip(text) : text);
}

}  // namespace lacuna
