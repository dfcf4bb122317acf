// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

/// An array that is whole and no matrix of real numbers: text, a single number, more
/// dimensions.
class NoMatrix : public DataError {
 public:
  using DataError::DataError;
};

/// One number inside an item of a NumPy array.
struct NpyField {
  std::string name;  ///< empty in arrays that are not structured
  char kind = 'f';   ///< f float, i signed (also M and m, dates and spans), u unsigned (also b)
  std::size_t size = 8;    ///< bytes
  std::size_t offset = 0;  ///< of its first byte in the item
  bool big_endian = false;
  std::string unit = {};  ///< of a date (since 1970) or a span of time, a whole number of these

  /// Whether its bytes are those of a double on this machine.
  bool is_native_double() const noexcept {
    return kind == 'f' && size == sizeof(double) && !big_endian &&
           std::endian::native == std::endian::little;
  }
};

/// What stands in front of the numbers of a .npy file; its sizes fit the file.
struct NpyHeader {
  std::vector<NpyField> fields;  ///< one, or the named fields of a structured type
  bool structured = false;
  std::size_t item_size = 8;  ///< bytes of an item with all its fields
  bool fortran_order = false;
  std::size_t rows = 0;
  std::size_t columns = 1;     ///< of an array that is not structured
  std::size_t data_begin = 0;  ///< offset of the numbers in the file
};

/// Reads the header (format versions 1 to 3) and checks it against the size of the file.
/// @param bytes with which the file begins, the header at least.
/// @param file_size in bytes.
/// @throws DataError naming source and what does not fit; NoMatrix for what is not supported.
NpyHeader parse_npy_header(std::string_view bytes, std::size_t file_size,
                           const std::string& source);

}  // namespace lacuna
