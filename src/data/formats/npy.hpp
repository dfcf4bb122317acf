// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "data/times/counted_times.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/table.hpp"
#include "npy_header.hpp"

namespace lacuna {

/// Parses a NumPy .npy array (versions 1 to 3) of one or two dimensions or of a structured type
/// with named fields; any real or integer type, either byte order, C or Fortran order.
/// Columns without a name are called c1, c2, ...
/// @throws DataError naming source and what is not supported.
/// @param find the time, which is counted from its first value where doubles do not hold it.
Table parse_npy(std::string_view bytes, const std::string& source,
                const TimeFinder& find = no_time);

/// A table without rows that has the columns of an array.
Table npy_columns(const NpyHeader& header, const std::string& source);

/// The numbers of an array. @param data header.rows rows of them, without the header.
Matrix npy_values(const NpyHeader& header, std::string_view data);

/// A whole number of an array. @param data as npy_values().
Stamp npy_stamp(const NpyHeader& header, const char* data, Index row, Index column);

/// How the numbers of a column are written; refers to header and data.
WrittenNumbers npy_written(const NpyHeader& header, const char* data, Index column);

/// What stands in front of the numbers of a .npy of version 1; 128 bytes.
/// @param type of the numbers: "<f8", ">f8".
std::string npy_begin(std::string_view type, bool fortran_order, Index rows, Index columns);

/// Writes a matrix as .npy version 1, little-endian doubles in Fortran order, whole or not at
/// all.
/// @throws FileError when it cannot be written.
void write_npy(const std::filesystem::path& path, const Matrix& values);

}  // namespace lacuna
