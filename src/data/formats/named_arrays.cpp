// SPDX-License-Identifier: MIT
#include "named_arrays.hpp"

#include <algorithm>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Index samples_in(const std::vector<ArrayShape>& shapes) {
  Index longest = 0, tallest = 0;
  for (const ArrayShape& shape : shapes) {
    if (shape.is_vector()) longest = std::max(longest, shape.rows * shape.columns);
    tallest = std::max(tallest, shape.rows);
  }
  return longest > 1 ? longest : tallest;
}

/// Length of what all names begin with, up to a dot and with it.
std::size_t shared_beginning(const std::vector<ArrayShape>& shapes) {
  const std::string& first = shapes.front().name;
  for (std::size_t end = first.rfind('.'); end != std::string::npos && end > 0;
       end = first.rfind('.', end - 1)) {
    const std::string beginning = first.substr(0, end + 1);
    if (std::all_of(shapes.begin(), shapes.end(),
                    [&](const ArrayShape& shape) { return shape.name.starts_with(beginning); }))
      return beginning.size();
  }
  return 0;
}

std::string shape_text(const ArrayShape& shape) {
  return std::to_string(shape.rows) + " x " + std::to_string(shape.columns);
}

bool is_empty(const ArrayShape& shape) { return shape.rows == 0 || shape.columns == 0; }

}  // namespace

ArrayTable arrange_arrays(const std::vector<ArrayShape>& shapes, const std::string& source) {
  std::vector<ArrayShape> filled = shapes;
  std::erase_if(filled, is_empty);
  if (filled.empty())
    throw DataError(source, "there is no array of numbers in it",
                    "save one array for each column");
  ArrayTable all;
  all.samples = samples_in(filled);
  const std::size_t beginning = shared_beginning(filled);
  all.table.source = source;
  std::vector<Quantity> columns;
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const ArrayShape& shape = shapes[i];
    if (is_empty(shape)) continue;
    const std::string name = shape.name.substr(beginning);
    const bool in_columns = shape.rows != all.samples;
    if (in_columns && shape.columns != all.samples) {
      notes.push_back(source + ": the array '" + name + "' has " + shape_text(shape) +
                      " values, not " + std::to_string(all.samples) +
                      " samples, and is left out");
      continue;
    }
    const Index count = in_columns ? shape.rows : shape.columns;
    all.places.push_back({i, in_columns, static_cast<Index>(columns.size()), count});
    for (Index c = 0; c < count; ++c)
      columns.push_back({count == 1 ? name : name + std::to_string(c + 1), shape.unit});
  }
  name_columns(all.table, columns, std::nullopt);
  all.table.notes.insert(all.table.notes.end(), notes.begin(), notes.end());
  return all;
}

const ArrayPlace& place_of(const ArrayTable& all, Index column) {
  return *std::find_if(all.places.begin(), all.places.end(), [&](const ArrayPlace& place) {
    return column < place.first_column + place.columns;
  });
}

namespace {

void count_times_of_arrays(const std::vector<NamedArray>& arrays, const TimeColumn& time,
                           ArrayTable& all) {
  const ArrayPlace& place = place_of(all, time.column);
  const NamedArray& array = arrays[place.array];
  const Index line = time.column - place.first_column;
  WrittenNumbers written{{}, array.epsilon};
  if (array.stamp)
    written.stamp = [&](Index sample) {
      return place.in_columns ? array.stamp(line, sample) : array.stamp(sample, line);
    };
  count_times(all.table, time, written);
}

}  // namespace

Table table_of_arrays(const std::vector<NamedArray>& arrays, const std::string& source,
                      const TimeFinder& find) {
  std::vector<ArrayShape> shapes;
  for (const NamedArray& array : arrays)
    shapes.push_back({array.name, array.values.rows(), array.values.cols(), array.unit});
  ArrayTable all = arrange_arrays(shapes, source);
  const auto time = find(all.table);
  Matrix& values = all.table.values;
  values.resize(all.samples, static_cast<Index>(all.table.columns.size()));
  for (const ArrayPlace& place : all.places) {
    auto block = values.middleCols(place.first_column, place.columns);
    if (place.in_columns)
      block = arrays[place.array].values.transpose();
    else
      block = arrays[place.array].values;
  }
  if (time) count_times_of_arrays(arrays, *time, all);
  return std::move(all.table);
}

}  // namespace lacuna
