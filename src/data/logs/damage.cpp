// SPDX-License-Identifier: MIT
#include "data/logs/damage.hpp"

#include <algorithm>
#include <array>

#include "core/base/utf8.hpp"
#include "data/records/text_field.hpp"

namespace lacuna {
namespace {

/// Words with which spreadsheets and loggers begin a row of statistics.
bool names_a_summary(std::string_view field) {
  constexpr std::array<std::string_view, 40> kWords{
      "mean",     "mean value", "average",    "avg",        "min",      "max",
      "minimum",  "maximum",    "sum",        "total",      "std",      "stdev",
      "std dev",  "stddev",     "median",     "count",      "range",    "variance",
      "rms",      "mittelwert", "mittel",     "mw",         "durchschnitt",
      "summe",    "gesamt",     "anzahl",     "stabw",      "standardabweichung",
      "varianz",  "spannweite", "moyenne",    "somme",      "ecart type",
      "promedio", "suma",       "media",      "somma",      "gemiddelde",
      "totaal",   "end of file"};
  std::string word = lower_case(strip(field));
  while (!word.empty() && (word.back() == ':' || word.back() == '.' || word.back() == '='))
    word.pop_back();
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

bool has_stray_bytes(std::string_view line) {
  return std::any_of(line.begin(), line.end(), is_stray_byte) || !is_utf8(line);
}

std::string_view first_field(std::string_view line) {
  line = strip(line);
  while (!line.empty() && std::string_view(",;\t \"").find(line.front()) != std::string_view::npos)
    line.remove_prefix(1);
  return line.substr(0, line.find_first_of(",;\t\""));
}

std::string place_of(const BadLine& line, const std::string& source) {
  return source + ":" + std::to_string(line.number) + ": ";
}

std::string count_text(std::size_t count, const char* what) {
  return std::to_string(count) + (count == 1 ? " line " : " lines ") + what;
}

/// Lines of one kind are left out where there are few among the samples.
void note_few(const std::vector<BadLine>& lines, BadLine::Kind kind, double most,
              const char* what, const std::string& source, std::vector<std::string>& notes) {
  const auto is_kind = [&](const BadLine& line) { return line.kind == kind; };
  const auto count =
      static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), is_kind));
  if (count == 0) return;
  const BadLine& first = *std::find_if(lines.begin(), lines.end(), is_kind);
  if (static_cast<double>(count) > most) throw DataError(first.error);
  notes.push_back(place_of(first, source) + count_text(count, what) + ", left out, here '" +
                  printable(to_utf8(first.text)) + "'");
}

}  // namespace

bool is_stray_byte(char byte) {
  const auto code = static_cast<unsigned char>(byte);
  return (code < 0x20U && byte != '\t' && byte != '\r' && byte != '\n') || code == 0x7FU;
}

bool is_summary(std::string_view line) { return names_a_summary(first_field(line)); }

BadLine::Kind kind_of_bad_line(std::string_view line, bool has_end, bool is_short) {
  if (is_summary(line)) return BadLine::Kind::Summary;
  if (has_stray_bytes(line)) return BadLine::Kind::Stray;
  return !has_end && is_short ? BadLine::Kind::Cut : BadLine::Kind::Other;
}

std::vector<std::string> notes_of_damage(const std::vector<BadLine>& lines, std::size_t samples,
                                         std::size_t last_sample, const std::string& source) {
  // A decision: bytes that no text has are damage for certain; a serial line that loses one line
  // in ten still gives a record. With half or twice of it the same files of loggers are read.
  constexpr double kStray = 0.1;
  const auto all = static_cast<double>(samples);
  std::vector<BadLine> damaged = lines;
  std::vector<std::string> notes;
  const auto summary = std::find_if(lines.begin(), lines.end(), [&](const BadLine& line) {
    return line.kind == BadLine::Kind::Summary && line.number > last_sample;
  });
  if (summary != lines.end()) {
    notes.push_back(place_of(*summary, source) + "the record ends in front of '" +
                    printable(to_utf8(summary->text)) + "', " +
                    count_text(static_cast<std::size_t>(lines.end() - summary),
                               "of a summary left out"));
    damaged.erase(damaged.begin() + (summary - lines.begin()), damaged.end());
  }
  for (BadLine& line : damaged)
    if (line.kind == BadLine::Kind::Summary) line.kind = BadLine::Kind::Other;
  note_few(damaged, BadLine::Kind::Stray, kStray * all, "with bytes that no text has", source,
           notes);
  note_few(damaged, BadLine::Kind::Cut, 1.0, "cut off at the end", source, notes);
  // Where bytes are damaged, parts of lines are lost too; elsewhere a bad line is an error.
  const bool is_serial = std::any_of(damaged.begin(), damaged.end(), [](const BadLine& line) {
    return line.kind == BadLine::Kind::Stray;
  });
  note_few(damaged, BadLine::Kind::Other, is_serial ? kStray * all : 0.0,
           "that cannot be read", source, notes);
  return notes;
}

}  // namespace lacuna
