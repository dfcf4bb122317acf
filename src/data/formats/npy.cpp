// SPDX-License-Identifier: MIT
#include "npy.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/files/atomic_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "npy_header.hpp"

namespace lacuna {
namespace {

/// The bits of an unsigned integer of `size` bytes, least significant byte first or last.
std::uint64_t load_bits(const char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = big_endian ? i : size - 1 - i;
    bits = (bits << 8U) | static_cast<unsigned char>(bytes[at]);
  }
  return bits;
}

/// IEEE 754 half precision: 1 sign, 5 exponent, 10 fraction bits.
double half_value(std::uint64_t bits) {
  const auto fraction = static_cast<double>(bits & 0x3FFU);
  const int exponent = static_cast<int>((bits >> 10U) & 0x1FU);
  double value = 0.0;
  if (exponent == 31)
    value = fraction > 0.0 ? std::numeric_limits<double>::quiet_NaN()
                           : std::numeric_limits<double>::infinity();
  else
    value = exponent == 0 ? std::ldexp(fraction, -24)
                          : std::ldexp(1024.0 + fraction, exponent - 25);
  return (bits & 0x8000U) != 0 ? -value : value;
}

double float_value(std::uint64_t bits, std::size_t size) {
  if (size == 8) return std::bit_cast<double>(bits);
  if (size == 4)
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  return half_value(bits);
}

std::int64_t signed_value(std::uint64_t bits, std::size_t size) {
  const auto unused = static_cast<unsigned>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

double load_value(const char* bytes, const NpyField& field) {
  const std::uint64_t bits = load_bits(bytes, field.size, field.big_endian);
  if (field.kind == 'f') return float_value(bits, field.size);
  if (field.kind == 'i') return static_cast<double>(signed_value(bits, field.size));
  return static_cast<double>(bits);
}

Stamp load_stamp(const char* bytes, const NpyField& field) {
  const std::uint64_t bits = load_bits(bytes, field.size, field.big_endian);
  return field.kind == 'i' ? stamp_of(signed_value(bits, field.size)) : stamp_of(bits);
}

/// Reads one column whose values lie `stride` bytes apart.
void load_column(const char* bytes, std::size_t stride, const NpyField& field,
                 Eigen::Ref<Vector> column) {
  const bool plain = field.is_native_double();
  for (Index row = 0; row < column.size(); ++row, bytes += stride) {
    if (plain)
      std::memcpy(&column[row], bytes, sizeof(double));
    else
      column[row] = load_value(bytes, field);
  }
}

void load_structured(std::string_view data, const NpyHeader& header, Matrix& values) {
  Index column = 0;
  for (const NpyField& field : header.fields)
    load_column(data.data() + field.offset, header.item_size, field, values.col(column++));
}

void load_matrix(std::string_view data, const NpyHeader& header, Matrix& values) {
  const auto rows = static_cast<std::size_t>(values.rows());
  const auto columns = static_cast<std::size_t>(values.cols());
  const NpyField& field = header.fields[0];
  const std::size_t stride = header.fortran_order ? field.size : field.size * columns;
  const std::size_t next = header.fortran_order ? field.size * rows : field.size;
  // A fact of the machines: so many rows stay in cache while their columns are taken apart.
  constexpr std::size_t kTogether = 512;
  for (std::size_t row = 0; row < rows; row += kTogether) {
    const auto count = static_cast<Index>(std::min(kTogether, rows - row));
    for (std::size_t i = 0; i < columns; ++i)
      load_column(data.data() + row * stride + i * next, stride, field,
                  values.col(static_cast<Index>(i)).segment(static_cast<Index>(row), count));
  }
}

void append_value(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned i = 0; i < 8; ++i) bytes += static_cast<char>((bits >> (8 * i)) & 0xFFU);
}

}  // namespace

std::string npy_begin(std::string_view type, bool fortran_order, Index rows, Index columns) {
  constexpr std::size_t kAlignment = 64, kPreamble = 10;  // facts of the format, in bytes
  std::string text = "{'descr': '" + std::string(type) +
                     "', 'fortran_order': " + (fortran_order ? "True" : "False") +
                     ", 'shape': (" + std::to_string(rows) + ", " + std::to_string(columns) +
                     "), }";
  const std::size_t used = (kPreamble + text.size() + 1) % kAlignment;
  text.append((kAlignment - used) % kAlignment, ' ');
  text += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(text.size() & 0xFFU);
  bytes += static_cast<char>(text.size() >> 8U);
  return bytes + text;
}

Table npy_columns(const NpyHeader& header, const std::string& source) {
  Table table;
  table.source = source;
  std::vector<Quantity> names;
  for (const NpyField& field : header.fields) names.push_back({field.name, ""});
  if (!header.structured) names.resize(header.columns);
  name_columns(table, names, std::nullopt);
  return table;
}

Matrix npy_values(const NpyHeader& header, std::string_view data) {
  Matrix values(static_cast<Index>(header.rows),
                static_cast<Index>(header.structured ? header.fields.size() : header.columns));
  if (header.structured)
    load_structured(data, header, values);
  else
    load_matrix(data, header, values);
  return values;
}

Stamp npy_stamp(const NpyHeader& header, const char* data, Index row, Index column) {
  const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
  if (header.structured)
    return load_stamp(data + r * header.item_size + header.fields[c].offset, header.fields[c]);
  const std::size_t place = header.fortran_order ? c * header.rows + r : r * header.columns + c;
  return load_stamp(data + place * header.item_size, header.fields[0]);
}

WrittenNumbers npy_written(const NpyHeader& header, const char* data, Index column) {
  const NpyField& field =
      header.fields[header.structured ? static_cast<std::size_t>(column) : 0];
  // Significant bits of doubles, singles and halves (IEEE 754).
  if (field.kind == 'f')
    return {{}, std::exp2(field.size == 8 ? -52.0 : field.size == 4 ? -23.0 : -10.0)};
  return {[&header, data, column](Index row) { return npy_stamp(header, data, row, column); },
          0.0};
}

Table parse_npy(std::string_view bytes, const std::string& source, const TimeFinder& find) {
  const NpyHeader header = parse_npy_header(bytes, bytes.size(), source);
  const std::string_view data = bytes.substr(header.data_begin);
  Table table = npy_columns(header, source);
  const auto time = find(table);
  table.values = npy_values(header, data);
  if (time) count_times(table, *time, npy_written(header, data.data(), time->column));
  return table;
}

void write_npy(const std::filesystem::path& path, const Matrix& values) {
  std::string bytes = npy_begin("<f8", true, values.rows(), values.cols());
  bytes.reserve(bytes.size() + static_cast<std::size_t>(values.size()) * sizeof(double));
  for (Index i = 0; i < values.size(); ++i) append_value(bytes, values.data()[i]);
  write_file_atomically(path, bytes);
}

}  // namespace lacuna
