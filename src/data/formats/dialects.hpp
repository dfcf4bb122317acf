// SPDX-License-Identifier: MIT
// Texts of instruments and programs that are no plain tables, as plain tables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// What is wrong with a line, thrown by a dialect that cannot say in which file.
struct LineProblem {
  std::size_t line = 0;    ///< from 1
  std::size_t column = 1;  ///< from 1
  std::string problem, remedy;
};

/// How a text becomes a plain table, line by line.
struct TextDialect {
  std::string note;  ///< what the file is taken for

  /// Appends one line of the table, an empty one where there is none, for one line of the file;
  /// is called for all of them in their order. Throws LineProblem.
  std::function<void(std::string_view line, std::string& text)> translate;

  std::string run_column = {};  ///< name of a column that numbers runs, where there are several
  std::string header = {};      ///< line of names that is in front of those of the file

  /// Between the columns of the file, where the first one is made and the others are taken
  /// over.
  char delimiter = '\0';

  bool makes_first = true;  ///< the first column is made, from a step or a clock
  std::vector<std::size_t> places = {};  ///< of the columns in the file, from 0, if others

  /// What the clock shows at the time 0 (Table::clock_start).
  std::optional<double> clock_start = {};

  /// Columns of times, each of the channels behind it (channel_clocks.hpp); empty where there
  /// is one time for all.
  std::vector<Index> clocks = {};
};

/// How a text is to be taken where it is one of:
/// - Rigol: `X,CH1,Start,Increment` with a step instead of times;
/// - Tektronix TDS: preamble and samples side by side;
/// - LabVIEW measurement (.lvm);
/// - LTspice export of a stepped run, ngspice: `print`, `wrdata`, raw file as text.
/// Nothing for every other text.
/// @param begin whole lines with which it begins, or all of it.
std::optional<TextDialect> dialect_of(std::string_view begin);

/// The lines of a table that a dialect makes of lines, which have to come in their order.
/// @param source name for messages.
/// @throws DataError naming it with line and column.
std::string translated(TextDialect& dialect, std::string_view lines, const std::string& source);

namespace dialects {

std::optional<TextDialect> rigol(std::string_view begin);
std::optional<TextDialect> tektronix(std::string_view begin);
std::optional<TextDialect> labview(std::string_view begin);
std::optional<TextDialect> stepped_ltspice(std::string_view begin);
std::optional<TextDialect> ngspice_print(std::string_view begin);
std::optional<TextDialect> ngspice_wrdata(std::string_view begin);
std::optional<TextDialect> ngspice_raw(std::string_view begin);

/// What is no file of these: clock times, text, units and labels in cells (data/logs).
std::optional<TextDialect> log_of_device(std::string_view begin);

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
