// SPDX-License-Identifier: MIT
// What the pieces of one file are called: "run.csv, record 2".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lacuna {

inline constexpr std::string_view kBeforePieceNumber = ", record ";

/// @param number of the piece, from 1.
inline std::string piece_name(const std::string& file, std::size_t number) {
  return file + std::string(kBeforePieceNumber) + std::to_string(number);
}

/// Where the name of the file ends in that of a piece; npos where it is all there is.
inline std::size_t end_of_file_name(std::string_view source) {
  return source.rfind(kBeforePieceNumber);
}

}  // namespace lacuna
