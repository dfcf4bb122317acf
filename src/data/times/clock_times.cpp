// SPDX-License-Identifier: MIT
// Times as clocks and calendars say them: "2026-11-22T10:00:00.5", "10:00:00.5".
#include "clock_times.hpp"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "data/formats/dialects.hpp"
#include "data/records/text_field.hpp"

namespace lacuna {
namespace {

constexpr Stamp kMinute = 60 * kStampOfOne;
constexpr Stamp kDay = 1440 * kMinute;
constexpr int kMinutesOfDay = 1440;

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
std::int64_t days_of(int year, int month, int day) {
  year -= month <= 2 ? 1 : 0;
  const int era = year / 400, of_era = year - 400 * era;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const int days = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
  return std::int64_t{era} * 146097 + days - 730425;
}

int days_in(int year, int month) {
  const auto next = month == 12 ? days_of(year + 1, 1, 1) : days_of(year, month + 1, 1);
  return static_cast<int>(next - days_of(year, month, 1));
}

void add_date(int year, int month, int day, ClockTime& clock) {
  clock.has_day = true;
  if (month < 1 || month > 12)
    clock.problem = "there is no month " + std::to_string(month);
  else if (day < 1 || day > days_in(year, month))
    clock.problem = "month " + std::to_string(month) + " of " + std::to_string(year) + " has " +
                    std::to_string(days_in(year, month)) + " days";
  else
    clock.day = days_of(year, month, day);
}

/// Takes "2026-11-22", "2026/11/22" or "22.11.2026" off the begin.
bool take_date(std::string_view& text, ClockTime& clock) {
  std::string_view rest = text;
  const auto first = digits(rest, 1, 4);
  if (!first || rest.empty()) return false;
  const char separator = rest.front();
  const bool german = separator == '.';
  if (!german && separator != '-' && separator != '/') return false;
  rest.remove_prefix(1);
  const auto month = digits(rest, 1, 2);
  if (!month || !take(rest, separator)) return false;
  const auto last = german ? digits(rest, 4, 4) : digits(rest, 1, 2);
  if (!last) return false;
  const int year = german ? *last : *first, day = german ? *first : *last;
  if (year < 1000) return false;
  text = rest;
  add_date(year, *month, day, clock);
  return true;
}

/// "Z", "UTC", "+02", "+0200" or "+02:00" to the end.
bool read_zone(std::string_view text, ClockTime& clock) {
  constexpr int kLargestZone = 14 * 60;  // of the world
  text = strip(text);
  if (text.empty()) return true;
  const std::string word = lower_case(text);
  if (word == "z" || word == "utc" || word == "gmt") {
    clock.zone = 0;
    return true;
  }
  const bool west = take(text, '-');
  if (!west && !take(text, '+')) return false;
  const auto hours = digits(text, 2, 2);
  take(text, ':');
  const auto minutes = text.empty() ? std::optional(0) : digits(text, 2, 2);
  if (!hours || !minutes || !text.empty()) return false;
  const int zone = 60 * *hours + *minutes;
  if (zone > kLargestZone || *minutes > 59) clock.problem = "there is no such zone";
  clock.zone = west ? -zone : zone;
  return true;
}

/// Takes "00.5" off the begin.
std::optional<Stamp> take_seconds(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.,"), text.size());
  const auto seconds = read_stamp(text.substr(0, end));
  text.remove_prefix(end);
  return seconds;
}

/// Leap seconds are behind 23:59:59 in UTC; zones differ by quarters of an hour.
bool may_leap(int minutes_of_day, const std::optional<int>& zone) {
  const int minute = minutes_of_day - zone.value_or(0);
  if (!zone) return minutes_of_day % 15 == 14;
  return (minute + 2 * kMinutesOfDay) % kMinutesOfDay == kMinutesOfDay - 1;
}

/// Reads "10:00:00.5" or "10:00" to the end, with a zone behind it.
bool read_time_of_day(std::string_view text, ClockTime& clock) {
  const auto hours = digits(text, 1, 2);
  if (!hours || !take(text, ':')) return false;
  const auto minutes = digits(text, 2, 2);
  if (!minutes) return false;
  Stamp seconds = 0;
  if (take(text, ':')) {
    const auto number = take_seconds(text);
    if (!number) return false;
    seconds = *number;
  }
  if (!read_zone(text, clock)) return false;
  clock.has_time = true;
  clock.is_leap = seconds >= kMinute;
  clock.time = (60 * *hours + *minutes) * kMinute + seconds;
  if (*hours > 24 || (*hours == 24 && clock.time > kDay))
    clock.problem = "a day ends at 24:00";
  else if (*minutes > 59)
    clock.problem = "there is no minute " + std::to_string(*minutes);
  else if (seconds >= kMinute + kStampOfOne)
    clock.problem = "a minute has no second " + stamp_text(seconds);
  else if (clock.is_leap && !may_leap(60 * *hours + *minutes, clock.zone))
    clock.problem = "there are leap seconds at 23:59:60 UTC only";
  return true;
}

}  // namespace

Stamp ClockTime::seconds() const { return day * kDay + time - zone.value_or(0) * kMinute; }

std::optional<ClockTime> read_clock(std::string_view text) {
  ClockTime clock;
  std::string_view rest = strip(text);
  if (!take_date(rest, clock)) {
    if (!read_time_of_day(rest, clock)) return std::nullopt;
    return clock;
  }
  if (rest.empty()) return clock;
  if (rest.front() != 'T' && rest.front() != ' ') return std::nullopt;
  if (!read_time_of_day(strip(rest.substr(1)), clock)) return std::nullopt;
  return clock;
}

namespace dialects {
namespace {

using Fields = std::vector<std::string_view>;

/// How a line of data begins: a clock in the first field, a date and a clock in two, a zone in
/// a third.
struct ClockLine {
  char delimiter = ',';
  std::size_t parts = 1;
  std::size_t others = 0;  ///< fields behind them
};

std::string clock_text(const Fields& fields, std::size_t parts) {
  std::string text(fields[0]);
  for (std::size_t i = 1; i < parts && i < fields.size(); ++i)
    text += " " + std::string(fields[i]);
  return text;
}

bool is_data(const std::vector<std::string_view>& fields, std::size_t from) {
  for (std::size_t i = from; i < fields.size(); ++i)
    if (read_field(fields[i]).kind == TextField::Kind::Text) return false;
  return fields.size() > from;
}

/// How many fields at the begin are a time: a date and a time in two, a zone behind them
/// ("+0200", "UTC"; not "+02", which may be a number) in a third; 0 where there is none.
std::size_t parts_of_clock(const Fields& fields) {
  const auto first = read_clock(fields[0]);
  if (!first || first->has_time) return first ? 1 : 0;
  const auto both = fields.size() > 1 ? read_clock(clock_text(fields, 2)) : std::nullopt;
  if (!both || both->zone) return both ? 2 : 0;
  constexpr std::size_t kShortest = 3, kWithMinutes = 5;
  const std::size_t size = fields.size() > 2 ? fields[2].size() : 0;
  const bool may_be_zone = size >= kWithMinutes || (size == kShortest && fields[2][0] > '9');
  const auto zoned = may_be_zone ? read_clock(clock_text(fields, 3)) : std::nullopt;
  return zoned && zoned->zone && zoned->problem.empty() ? 3 : 2;
}

std::optional<ClockLine> clock_line(std::string_view line) {
  for (const char delimiter : {',', ';', '\t', ' '}) {
    if (line.find(delimiter) == std::string_view::npos) continue;
    const Fields fields = fields_of(line, delimiter);
    const std::size_t parts = fields.size() > 1 ? parts_of_clock(fields) : 0;
    if (parts > 0 && is_data(fields, parts))
      return ClockLine{delimiter, parts, fields.size() - parts};
  }
  return std::nullopt;
}

/// A zone in a field of its own is one in every line; else it is a number like "-1200".
ClockLine checked(ClockLine kind, Lines lines) {
  constexpr int kMostLooked = 60;
  for (int i = 0; i < kMostLooked && kind.parts == 3; ++i) {
    const auto line = lines.next();
    if (!line) break;
    const Fields fields = fields_of(*line, kind.delimiter);
    if (fields.size() > 3 && parts_of_clock(fields) < 3)
      return {kind.delimiter, 2, kind.others + 1};
  }
  return kind;
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

/// Seconds since the first time. Midnight adds a day where there is no date; a leap second that
/// is in the record is counted.
class Elapsed {
 public:
  Stamp operator()(const ClockTime& clock) {
    const Stamp now = clock.seconds();
    if (!first_) first_ = last_ = now;
    if (!clock.has_day && now < last_ - kDay / 2) added_ += kDay;
    last_ = now;
    if (clock.is_leap)
      leap_ends_ = now - (now % kStampOfOne + kStampOfOne) % kStampOfOne;
    else if (leap_ends_ && now >= *leap_ends_) {
      added_ += kStampOfOne;
      leap_ends_.reset();
    }
    return now + added_ - *first_;
  }

 private:
  std::optional<Stamp> first_;
  Stamp last_ = 0, added_ = 0;
  std::optional<Stamp> leap_ends_;  ///< as the number of the second behind it
};

std::string header_of(std::string_view line, const ClockLine& kind) {
  const Fields names = fields_of(line, kind.delimiter);
  const std::size_t taken = names.size() > kind.others ? names.size() - kind.others : 1;
  std::vector<std::string> heads{"t [s]"};
  heads.insert(heads.end(), names.begin() + static_cast<std::ptrdiff_t>(taken), names.end());
  return joined_line(heads);
}

std::string row_of(const Fields& fields, const ClockLine& kind, std::string time) {
  std::vector<std::string> row{std::move(time)};
  for (std::size_t i = kind.parts; i < fields.size(); ++i) row.emplace_back(fields[i]);
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
    if (line_++ < before_) {
      text += line_ - 1 == header_ ? header_of(line, kind_) : "\n";
      return;
    }
    const Fields fields = fields_of(line, kind_.delimiter);
    const std::string_view content = strip(line);
    if (content.empty() || content.front() == '#' || fields.size() <= kind_.parts) {
      text.append(line) += '\n';  // the reader says what is wrong with it
      return;
    }
    const std::string written = clock_text(fields, kind_.parts);
    const auto clock = read_clock(written);
    if (clock) check(*clock, written);
    text += row_of(fields, kind_, clock ? stamp_text(elapsed_(*clock)) : written);
  }

 private:
  /// @throws LineProblem
  void check(const ClockTime& clock, const std::string& written) {
    const auto fail = [&](const std::string& problem, const std::string& remedy) {
      throw LineProblem{line_, 1, "the time '" + written + "': " + problem, remedy};
    };
    if (!clock.problem.empty()) fail(clock.problem, "write a time that there is");
    if (!usual_) usual_ = clock;
    if (clock.has_day != usual_->has_day)
      fail("it has " + std::string(clock.has_day ? "a" : "no") + " date, others have " +
               (clock.has_day ? "none" : "one"),
           "write all times with their date");
    if (clock.zone.has_value() != usual_->zone.has_value())
      fail("it has " + std::string(clock.zone ? "a" : "no") + " zone, others have " +
               (clock.zone ? "none" : "one"),
           "write all times with their zone, or none of them");
  }

  ClockLine kind_;
  std::size_t before_, header_;
  std::size_t line_ = 0;            ///< of the file, from 1
  std::optional<ClockTime> usual_;  ///< the first one: all are written as it is
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
                         ClockLog(checked(*kind, lines), i, header), "", "", kind->delimiter};
    if (is_numbers(*line)) return std::nullopt;
    if (!strip(*line).empty()) header = i;
  }
  return std::nullopt;
}

}  // namespace dialects
}  // namespace lacuna
