// SPDX-License-Identifier: MIT
#include "file_kinds.hpp"

#include <array>

namespace lacuna {
namespace {

struct Kind {
  std::string_view begin;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::string_view kColumns = "save the columns as .csv or NumPy's .npy";

constexpr std::array<Kind, 13> kKinds{
    {{"MATLAB ", "a damaged MATLAB file", "save it again, or the columns as .csv"},
     {"\xD0\xCF\x11\xE0", "an old Excel workbook (.xls)", "save the sheet as .csv"},
     {"TDSm", "a LabVIEW TDMS file", "export it as .lvm or .csv"},
     {"PAR1", "a Parquet file", kColumns},
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

/// A zip archive by what is in it.
KnownFile zip_kind(std::string_view bytes) {
  const auto has = [&](std::string_view name) {
    return bytes.find(name) != std::string_view::npos;
  };
  if (has("xl/workbook")) return {"an Excel workbook (.xlsx)", "save the sheet as .csv"};
  if (has("opendocument.spreadsheet"))
    return {"a LibreOffice spreadsheet (.ods)", "save the sheet as .csv"};
  return {"a zip archive", "unpack it and give the file with the numbers"};
}

}  // namespace

std::optional<KnownFile> known_file(std::string_view bytes) {
  for (const Kind& kind : kKinds)
    if (bytes.substr(0, kind.begin.size()) == kind.begin)
      return KnownFile{std::string(kind.what), std::string(kind.remedy)};
  if (bytes.substr(0, 4) == "PK\x03\x04") return zip_kind(bytes);
  return std::nullopt;
}

}  // namespace lacuna
