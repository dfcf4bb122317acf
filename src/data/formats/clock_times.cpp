// SPDX-License-Identifier: MIT
// Times as clocks and calendars say them: "2026-11-22T10:00:00.5", "10:00:00.5".
#include "clock_times.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "dialects.hpp"
#include "lacuna/core/base/text.hpp"
#include "lacuna/data/formats/text_field.hpp"

namespace lacuna {
namespace {

constexpr double kDay = 86400.0;

/// The whole number of so many digits at the begin, which is taken off.
std::optional<int> digits(std::string_view& text, std::size_t least, std::size_t most) {
  std::size_t count = 0;
  while (count < text.size() && count < most && text[count] >= '0' && text[count] <= '9')
    ++count;
  if (count < least) return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + count, value);
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

/// Days since 1 January 2000 (proleptic Gregorian calendar; Hinnant, days_from_civil).
double days_of(int year, int month, int day) {
  year -= month <= 2 ? 1 : 0;
  const int era = year / 400, of_era = year - 400 * era;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const int days = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
  return static_cast<double>(era) * 146097.0 + days - 730425.0;
}

/// "2026-11-22", "2026/11/22" or "22.11.2026" at the begin, which is taken off.
std::optional<double> take_date(std::string_view& text) {
  std::string_view rest = text;
  auto first = digits(rest, 1, 4);
  if (!first || rest.empty()) return std::nullopt;
  const char separator = rest.front();
  const bool german = separator == '.';
  if (!german && separator != '-' && separator != '/') return std::nullopt;
  rest.remove_prefix(1);
  const auto month = digits(rest, 1, 2);
  if (!month || !take(rest, separator)) return std::nullopt;
  auto last = german ? digits(rest, 4, 4) : digits(rest, 1, 2);
  if (!last || *month < 1 || *month > 12) return std::nullopt;
  if (german) std::swap(first, last);
  if (*first < 1000 || *last < 1 || *last > 31) return std::nullopt;
  text = rest;
  return days_of(*first, *month, *last);
}

/// "10:00:00.5" or "10:00" to the end, with a zone behind it, in seconds.
std::optional<double> time_of_day(std::string_view text) {
  const auto hours = digits(text, 1, 2);
  if (!hours || !take(text, ':')) return std::nullopt;
  const auto minutes = digits(text, 2, 2);
  if (!minutes || *hours > 24 || *minutes > 59) return std::nullopt;
  double seconds = 0.0;
  if (take(text, ':')) {
    std::string number;
    while (!text.empty() && (std::isdigit(static_cast<unsigned char>(text.front())) != 0 ||
                             text.front() == '.' || text.front() == ',')) {
      number += text.front() == ',' ? '.' : text.front();
      text.remove_prefix(1);
    }
    const auto value = parse_number(number);
    if (!value || *value >= 61.0) return std::nullopt;
    seconds = *value;
  }
  // A zone shifts all times of a record alike.
  if (!text.empty() && text.front() != 'Z' && text.front() != '+' && text.front() != '-')
    return std::nullopt;
  return 3600.0 * *hours + 60.0 * *minutes + seconds;
}

}  // namespace

std::optional<ClockTime> read_clock(std::string_view text) {
  text = strip(text);
  std::string_view rest = text;
  const auto day = take_date(rest);
  if (!day) {
    const auto time = time_of_day(text);
    return time ? std::optional(ClockTime{0.0, *time, false, true}) : std::nullopt;
  }
  if (rest.empty()) return ClockTime{*day, 0.0, true, false};
  if (rest.front() != 'T' && rest.front() != ' ') return std::nullopt;
  const auto time = time_of_day(strip(rest.substr(1)));
  if (!time) return std::nullopt;
  return ClockTime{*day, *time, true, true};
}

namespace dialects {
namespace {

/// How a line of data begins: a clock in the first field, or a date and a clock in two.
struct ClockLine {
  char delimiter = ',';
  bool in_two = false;
};

std::optional<ClockTime> clock_of(const std::vector<std::string_view>& fields, bool in_two) {
  auto clock = read_clock(fields[0]);
  if (!in_two || !clock || fields.size() < 2) return clock;
  const auto time = read_clock(fields[1]);
  if (!time || time->has_day) return std::nullopt;
  return ClockTime{clock->day, time->seconds, true, true};
}

bool is_data(const std::vector<std::string_view>& fields, std::size_t from) {
  for (std::size_t i = from; i < fields.size(); ++i)
    if (read_field(fields[i]).kind == TextField::Kind::Text) return false;
  return fields.size() > from;
}

std::optional<ClockLine> clock_line(std::string_view line) {
  for (const char delimiter : {',', ';', '\t', ' '}) {
    if (line.find(delimiter) == std::string_view::npos) continue;
    const auto fields = fields_of(line, delimiter);
    if (fields.size() < 2) continue;
    const auto clock = read_clock(fields[0]);
    if (!clock) continue;
    if (clock->has_time && is_data(fields, 1)) return ClockLine{delimiter, false};
    if (!clock->has_time && clock_of(fields, true) && is_data(fields, 2))
      return ClockLine{delimiter, true};
  }
  return std::nullopt;
}

/// Numbers alone, several in the line.
bool is_numbers(std::string_view line) {
  for (const char delimiter : {',', ';', '\t', ' '}) {
    const auto fields = fields_of(line, delimiter);
    if (fields.size() > 1 && read_field(fields[0]).kind == TextField::Kind::Number &&
        is_data(fields, 1))
      return true;
  }
  return false;
}

/// Times since the first one; midnight adds a day where there is no date.
class Elapsed {
 public:
  double operator()(const ClockTime& clock) {
    if (!first_) first_ = clock;
    if (!clock.has_day && clock.seconds < last_ - kDay / 2.0) midnights_ += 1.0;
    last_ = clock.seconds;
    // Whole days first, so that fractions of seconds keep their digits.
    return (clock.day - first_->day + midnights_) * kDay + (clock.seconds - first_->seconds);
  }

 private:
  std::optional<ClockTime> first_;
  double last_ = 0.0, midnights_ = 0.0;
};

std::string header_of(std::string_view line, const ClockLine& kind) {
  std::vector<std::string> names;
  for (const std::string_view field : fields_of(line, kind.delimiter))
    names.emplace_back(field);
  if (kind.in_two && names.size() > 1) names.erase(names.begin());
  names[0] = "t [s]";
  return joined_line(names);
}

std::string row_of(const std::vector<std::string_view>& fields, const ClockLine& kind,
                   double time) {
  std::vector<std::string> row{format_number(std::round(time * 1e9) / 1e9)};
  for (std::size_t i = kind.in_two ? 2 : 1; i < fields.size(); ++i) row.emplace_back(fields[i]);
  return joined_line(row);
}

/// Takes the lines of a log: some of a preamble, one of them the header, then samples.
class ClockLog {
 public:
  /// @param before lines in front of the first sample.
  /// @param header which of them has the names, from 0; none where there are not so many.
  ClockLog(ClockLine kind, std::size_t before, std::size_t header)
      : kind_(kind), before_(before), header_(header) {}

  void operator()(std::string_view line, std::string& text) {
    if (line_ < before_) {
      text += line_ == header_ ? header_of(line, kind_) : "\n";
      ++line_;
      return;
    }
    const auto fields = fields_of(line, kind_.delimiter);
    const auto clock = fields.empty() ? std::nullopt : clock_of(fields, kind_.in_two);
    if (clock)
      text += row_of(fields, kind_, elapsed_(*clock));
    else
      text.append(line) += '\n';
  }

 private:
  ClockLine kind_;
  std::size_t before_, header_;
  std::size_t line_ = 0;  ///< of the preamble
  Elapsed elapsed_;
};

}  // namespace

std::optional<TextDialect> clock_times(std::string_view begin) {
  constexpr std::size_t kLooked = 60;  // lines of a preamble
  Lines lines(begin);
  std::size_t header = kLooked;
  for (std::size_t i = 0; i < kLooked; ++i) {
    const auto line = lines.next();
    if (!line) return std::nullopt;
    if (const auto kind = clock_line(*line))
      return TextDialect{"times of a clock are seconds since the first one",
                         ClockLog(*kind, i, header)};
    if (is_numbers(*line)) return std::nullopt;
    if (!strip(*line).empty()) header = i;
  }
  return std::nullopt;
}

}  // namespace dialects
}  // namespace lacuna
