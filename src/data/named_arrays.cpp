// SPDX-License-Identifier: MIT
#include "named_arrays.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

bool is_vector(const Matrix& values) { return std::min(values.rows(), values.cols()) == 1; }

Index samples_in(const std::vector<NamedArray>& arrays) {
  Index longest = 0, tallest = 0;
  for (const auto& [name, values] : arrays) {
    if (is_vector(values)) longest = std::max(longest, values.size());
    tallest = std::max(tallest, values.rows());
  }
  return longest > 1 ? longest : tallest;
}

/// With a sample in each row; nothing where neither side has so many.
std::optional<Matrix> with_samples_in_rows(Matrix values, Index samples) {
  if (values.rows() == samples) return values;
  if (values.cols() == samples) return Matrix(values.transpose());
  return std::nullopt;
}

/// Length of what all names begin with, up to a dot and with it.
std::size_t shared_beginning(const std::vector<NamedArray>& arrays) {
  const std::string& first = arrays.front().name;
  for (std::size_t end = first.rfind('.'); end != std::string::npos && end > 0;
       end = first.rfind('.', end - 1)) {
    const std::string beginning = first.substr(0, end + 1);
    if (std::all_of(arrays.begin(), arrays.end(),
                    [&](const NamedArray& array) { return array.name.starts_with(beginning); }))
      return beginning.size();
  }
  return 0;
}

std::string size_text(const Matrix& values) {
  return std::to_string(values.rows()) + " x " + std::to_string(values.cols());
}

}  // namespace

Table table_of_arrays(std::vector<NamedArray> arrays, const std::string& source) {
  std::erase_if(arrays, [](const NamedArray& array) { return array.values.size() == 0; });
  if (arrays.empty())
    throw DataError(source, "there is no array of numbers in it",
                    "save one array for each column");
  const Index samples = samples_in(arrays);
  const std::size_t beginning = shared_beginning(arrays);
  Table table;
  table.source = source;
  std::vector<Quantity> columns;
  std::vector<std::string> notes;
  for (auto& [full_name, values] : arrays) {
    const std::string name = full_name.substr(beginning);
    const std::string size = size_text(values);
    const std::optional<Matrix> rows = with_samples_in_rows(std::move(values), samples);
    if (!rows) {
      notes.push_back(source + ": the array '" + name + "' has " + size + " values, not " +
                      std::to_string(samples) + " samples, and is left out");
      continue;
    }
    for (Index c = 0; c < rows->cols(); ++c)
      columns.push_back({rows->cols() == 1 ? name : name + std::to_string(c + 1), ""});
    table.values.conservativeResize(samples, static_cast<Index>(columns.size()));
    table.values.rightCols(rows->cols()) = *rows;
  }
  name_columns(table, columns, std::nullopt);
  table.notes.insert(table.notes.end(), notes.begin(), notes.end());
  return table;
}

}  // namespace lacuna
