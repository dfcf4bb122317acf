// SPDX-License-Identifier: MIT
// What the records of one file and the pieces of one record are called: "run.csv, record 2",
// "run.csv, piece 2", "run.csv, record 2, piece 1". Records have initial states of their own;
// pieces are what missing samples leave of one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

inline constexpr std::string_view kBeforeRecordNumber = ", record ";
inline constexpr std::string_view kBeforePieceNumber = ", piece ";

/// @param number of the record, from 1.
inline std::string record_name(const std::string& file, std::size_t number) {
  return file + std::string(kBeforeRecordNumber) + std::to_string(number);
}

/// @param record its name, that of the file where it is the only one.
/// @param number of the piece, from 1.
inline std::string piece_name(const std::string& record, std::size_t number) {
  return record + std::string(kBeforePieceNumber) + std::to_string(number);
}

/// Where the name of the file ends in that of a record or piece; npos where it is all there is.
inline std::size_t end_of_file_name(std::string_view source) {
  const std::size_t record = source.rfind(kBeforeRecordNumber);
  return record != std::string_view::npos ? record : source.rfind(kBeforePieceNumber);
}

/// The record that a piece is of: "run.csv, record 2" of "run.csv, record 2, piece 1".
inline std::string record_of(const std::string& source) {
  return source.substr(0, source.rfind(kBeforePieceNumber));
}

/// Names of what a file was cut into.
/// @param numbers of the records that the parts are of, in the order of the file: another one
///   than before begins a record.
inline std::vector<std::string> names_of_parts(const std::string& file,
                                               const std::vector<double>& numbers) {
  std::vector<std::string> names;
  std::size_t record = 0;
  for (auto begin = numbers.begin(), end = begin; begin != numbers.end(); begin = end) {
    end = std::find_if(begin, numbers.end(), [&](double other) { return other != *begin; });
    const bool is_only = begin == numbers.begin() && end == numbers.end();
    const std::string name = is_only ? file : record_name(file, ++record);
    const auto pieces = static_cast<std::size_t>(end - begin);
    for (std::size_t piece = 1; piece <= pieces; ++piece)
      names.push_back(pieces == 1 ? name : piece_name(name, piece));
  }
  return names;
}

}  // namespace lacuna
