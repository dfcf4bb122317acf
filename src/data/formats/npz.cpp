// SPDX-License-Identifier: MIT
#include "npz.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "core/files/zip_reader.hpp"
#include "named_arrays.hpp"
#include "npy.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 34U;  // of one array: nobody's record

std::string name_of(const std::string& file) {
  const std::size_t end = file.rfind(".npy");
  return end == std::string::npos ? file : file.substr(0, end);
}

/// The array of an entry, or the fields of a structured one ("run.t").
/// @throws NoMatrix where it is none.
void add_arrays(const ZipArchive& archive, const ZipEntry& entry,
                std::vector<NamedArray>& arrays) {
  const std::string place = archive.source + ", " + entry.name;
  const auto bytes =
      std::make_shared<const std::string>(unpacked(archive, entry, kMostBytes));
  if (!entry.name.ends_with(".npy")) throw NoMatrix(place, "this is no array", "leave it out");
  const auto header =
      std::make_shared<const NpyHeader>(parse_npy_header(*bytes, bytes->size(), place));
  const std::string_view data = std::string_view(*bytes).substr(header->data_begin);
  const Matrix values = npy_values(*header, data);
  const Index parts = header->structured ? values.cols() : 1;
  for (Index part = 0; part < parts; ++part) {
    NamedArray array{name_of(entry.name), header->structured ? values.col(part) : values};
    if (header->structured)
      array.name += "." + header->fields[static_cast<std::size_t>(part)].name;
    array.unit = header->fields[static_cast<std::size_t>(part)].unit;
    const WrittenNumbers written = npy_written(*header, data.data(), part);
    array.epsilon = written.epsilon;
    if (written.stamp)
      array.stamp = [bytes, header, part, at = data.data()](Index row, Index column) {
        return npy_stamp(*header, at, row, part + column);
      };
    arrays.push_back(std::move(array));
  }
}

}  // namespace

Table parse_npz(std::string_view bytes, const std::string& source, const TimeFinder& find) {
  std::vector<NamedArray> arrays;
  std::vector<std::string> others;
  const ZipArchive archive =
      open_zip(bytes, source, "save it again with numpy.savez, or the columns as .csv");
  for (const ZipEntry& entry : archive.entries) {
    const std::string name = name_of(entry.name);
    try {
      add_arrays(archive, entry, arrays);
    } catch (const NoMatrix&) {
      others.push_back(name);
    }
  }
  Table table = table_of_arrays(arrays, source, find);
  for (const std::string& name : others)
    table.notes.push_back(source + ": '" + name +
                          "' is neither a vector nor a matrix of real numbers and is left out");
  return table;
}

}  // namespace lacuna
