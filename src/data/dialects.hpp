// SPDX-License-Identifier: MIT
// Texts of instruments and programs that are no plain tables, as plain tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// A text as a table with a header line.
struct PlainText {
  std::string text;
  std::string note;             ///< what the file was taken for
  std::string run_column = {};  ///< name of a column that numbers runs, where there are several
  std::string shift = {};       ///< lines of the text that are in front of those of the file
};

/// The text as a plain table where it is one of:
/// - Rigol: `X,CH1,Start,Increment` with a step instead of times;
/// - Tektronix TDS: preamble and samples side by side;
/// - LabVIEW measurement (.lvm);
/// - LTspice export of a stepped run, ngspice: `print`, `wrdata`, raw file as text;
/// - times of day or dates in the first column.
/// Nothing for every other text.
std::optional<PlainText> plain_text(std::string_view text);

namespace dialects {

std::optional<PlainText> rigol(std::string_view text);
std::optional<PlainText> tektronix(std::string_view text);
std::optional<PlainText> labview(std::string_view text);
std::optional<PlainText> stepped_ltspice(std::string_view text);
std::optional<PlainText> ngspice_print(std::string_view text);
std::optional<PlainText> ngspice_wrdata(std::string_view text);
std::optional<PlainText> ngspice_raw(std::string_view text);
std::optional<PlainText> clock_times(std::string_view text);

}  // namespace dialects

/// Walks over the lines of a text, without their ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The next line; nothing behind the last one.
  std::optional<std::string_view> next();

 private:
  std::string_view rest_;
};

/// Fields of a line between delimiters, trimmed.
std::vector<std::string_view> fields_of(std::string_view line, char delimiter);

/// Fields with commas between them and a line end.
std::string joined_line(const std::vector<std::string>& fields);

}  // namespace lacuna
