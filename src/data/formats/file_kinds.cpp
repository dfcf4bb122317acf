// SPDX-License-Identifier: MIT
#include "file_kinds.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <system_error>

#include "data/records/text_field.hpp"
#include "data/sheets/workbook.hpp"
#include "joined_files.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

struct Kind {
  std::string_view begin;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::string_view kTopics =
    "convert a topic: ros2 topic echo --csv /TOPIC > FILE.csv, while ros2 bag play FILE runs";
constexpr std::string_view kColumns = "save the columns as .csv or NumPy's .npy";

constexpr std::array<Kind, 16> kKinds{
    {{"MATLAB ", "a damaged MATLAB file", "save it again, or the columns as .csv"},
     {"\xD0\xCF\x11\xE0", "an old Excel workbook (.xls)", "save it as .xlsx"},
     {"TDSm", "a LabVIEW TDMS file",
      "convert it: python3 -c \"import nptdms; nptdms.TdmsFile.read('FILE.tdms')"
      ".as_dataframe(time_index=True).to_csv('FILE.csv')\""},
     {"PAR1", "a Parquet file",
      "convert it: python3 -c \"import pandas; pandas.read_parquet('FILE.parquet')"
      ".to_csv('FILE.csv', index=False)\""},
     {"\x89MCAP0\r\n", "an MCAP file", kTopics},
     {"SQLite format 3", "a database (a ROS 2 bag, if it ends in .db3)", kTopics},
     {"#ROSBAG V", "a ROS 1 bag",
      "convert a topic: rostopic echo -b FILE.bag -p /TOPIC > FILE.csv"},
     {"RIFF", "a sound file (WAV)", kColumns},
     {"%PDF", "a PDF document", "give the file with the numbers"},
     {"\x89PNG", "a picture (PNG)", "give the file with the numbers"},
     {"\xFF\xD8\xFF", "a picture (JPEG)", "give the file with the numbers"},
     {"{\\rtf", "a word processor's document (RTF)", "save it as plain text"},
     {"<!DOCTYPE", "a web page", "give the file with the numbers"},
     {"<html", "a web page", "give the file with the numbers"},
     {"\x7F"
      "ELF",
      "a program", "give the file with the numbers"},
     {"%!PS", "a PostScript document", "give the file with the numbers"}}};

/// Whether the name ends in an ending such as .npy, or in that and .gz.
bool is_named(const std::filesystem::path& path, std::string_view ending) {
  std::filesystem::path name = path.filename();
  if (lower_case(name.extension().string()) == ".gz") name = name.stem();
  return lower_case(name.extension().string()) == ending;
}

/// Version of a MATLAB file, as the two bytes behind its text say; 0 where it is none.
int mat_version(std::string_view bytes) {
  const std::string_view mark = bytes.substr(std::min<std::size_t>(bytes.size(), 124), 4);
  if (mark == std::string_view("\0\1IM", 4) || mark == std::string_view("\1\0MI", 4)) return 5;
  if (mark == std::string_view("\0\2IM", 4) || mark == std::string_view("\2\0MI", 4)) return 7;
  return 0;
}

}  // namespace

std::optional<KnownFile> known_file(std::string_view bytes) {
  for (const Kind& kind : kKinds)
    if (bytes.substr(0, kind.begin.size()) == kind.begin)
      return KnownFile{std::string(kind.what), std::string(kind.remedy)};
  if (bytes.substr(0, 4) == "PK\x03\x04")
    return KnownFile{"a zip archive", "unpack it and give the file with the numbers"};
  return std::nullopt;
}

FileAndSheet file_and_sheet(const std::filesystem::path& path) {
  const std::string text = path.string();
  const std::size_t sign = text.rfind('#');
  std::error_code ignored;
  if (sign == std::string::npos || std::filesystem::exists(path, ignored))
    return {path, std::nullopt};
  const std::filesystem::path file = text.substr(0, sign);
  if (!std::filesystem::exists(file, ignored)) return {path, std::nullopt};
  return {file, text.substr(sign + 1)};
}

std::vector<std::filesystem::path> files_named(std::string_view word) {
  std::vector<std::filesystem::path> files;
  std::vector<std::size_t> begins{0}, ends{word.size()};
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] == '+') begins.push_back(i + 1);
    if (word[i] == '+' || word[i] == '#') ends.push_back(i);
  }
  for (const std::size_t begin : begins)
    for (const std::size_t end : ends) {
      if (end <= begin || end - begin > PATH_MAX) continue;
      const std::string name(word.substr(begin, end - begin));
      std::error_code ignored;
      if (name == "-")
        files.emplace_back("/dev/stdin");
      else if (std::filesystem::exists(name, ignored))
        files.emplace_back(name);
      else
        for (std::string& match : files_that_match(name)) files.emplace_back(std::move(match));
    }
  return files;
}

void check_sheet(const std::optional<std::string>& sheet, FileKind kind,
                 const std::string& source) {
  if (sheet && kind != FileKind::Workbook)
    throw DataError(source, "only workbooks have sheets", "leave out '#" + *sheet + "'");
}

FileKind kind_of(const std::filesystem::path& path, std::string_view begin,
                 const std::string& source) {
  if (is_named(path, ".npy") || begin.starts_with("\x93NUMPY")) return FileKind::Npy;
  if (is_named(path, ".npz")) return FileKind::Npz;
  const int mat = mat_version(begin);
  if (mat == 7 || begin.starts_with("\x89HDF\r\n\x1a\n")) return FileKind::Hdf5;
  if (mat == 5) return FileKind::Mat;
  if (is_workbook(begin)) return FileKind::Workbook;
  if (const auto known = known_file(begin))
    throw DataError(source, "this is " + known->what + ", which cannot be read", known->remedy);
  return FileKind::Text;
}

}  // namespace lacuna
