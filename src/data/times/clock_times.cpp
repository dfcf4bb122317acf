// SPDX-License-Identifier: MIT
// Times as clocks and calendars say them: "2026-11-22T10:00:00.5", "10:00:00.5 PM".
#include "clock_times.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

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

/// The month of a name of three letters or more, in English or German; 0 where it is none.
int month_called(std::string_view name) {
  constexpr std::array<std::string_view, 12> kMonths{
      "jan", "feb", "mar m\u00e4r mrz", "apr", "may mai", "jun",
      "jul", "aug", "sep",              "oct okt", "nov",    "dec dez"};
  constexpr std::size_t kLetters = 3;
  const std::string word = lower_case(name.substr(0, kLetters));
  if (name.size() < kLetters) return 0;
  for (std::size_t i = 0; i < kMonths.size(); ++i)
    if (kMonths[i].find(word) != std::string_view::npos) return static_cast<int>(i) + 1;
  return 0;
}

/// Takes the letters off the begin.
std::string_view take_letters(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && (std::isalpha(static_cast<unsigned char>(text[count])) != 0 ||
                                 static_cast<unsigned char>(text[count]) >= 0x80U))
    ++count;
  const std::string_view letters = text.substr(0, count);
  text.remove_prefix(count);
  return letters;
}

/// A year of four digits or, of this century, of two.
std::optional<int> take_year(std::string_view& text, bool may_be_short) {
  std::string_view rest = text;
  const auto year = digits(rest, 2, 4);
  const std::size_t count = text.size() - rest.size();
  if (!year || count == 3 || (count == 2 && !may_be_short)) return std::nullopt;
  text = rest;
  return count == 2 ? 2000 + *year : *year;
}

/// Takes "05-Dec-2023" or "5 Dec 2023" off the begin.
bool take_named_date(std::string_view& text, ClockTime& clock) {
  std::string_view rest = text;
  const auto day = digits(rest, 1, 2);
  if (!day || rest.empty()) return false;
  const char separator = rest.front();
  if (separator != '-' && separator != ' ' && separator != '/') return false;
  rest.remove_prefix(1);
  const int month = month_called(take_letters(rest));
  if (month == 0 || !take(rest, separator)) return false;
  const auto year = take_year(rest, true);
  if (!year) return false;
  text = rest;
  add_date(*year, month, *day, clock);
  return true;
}

/// Takes "2026-11-22", "2026/11/22", "22.11.2026", and in the given order "11/22/2026" off the
/// begin. A year of two digits stands behind dots and slashes only.
bool take_date(std::string_view& text, DateOrder order, ClockTime& clock) {
  std::string_view rest = text;
  const auto first = digits(rest, 1, 4);
  if (!first || rest.empty()) return false;
  const std::size_t width = text.size() - rest.size();
  const char separator = rest.front();
  if (separator != '-' && separator != '/' && separator != '.') return false;
  rest.remove_prefix(1);
  const auto second = digits(rest, 1, 2);
  if (!second || !take(rest, separator)) return false;
  const bool year_first = width == 4 && separator != '.';
  if (!year_first && width > 2) return false;
  const auto last = year_first ? digits(rest, 1, 2) : take_year(rest, separator != '-');
  if (!last || (year_first ? *first : *last) < 1000) return false;
  text = rest;
  const bool days_lead = separator == '.' || order == DateOrder::DayFirst;
  if (year_first)
    add_date(*first, *second, *last, clock);
  else
    add_date(*last, days_lead ? *second : *first, days_lead ? *first : *second, clock);
  return true;
}

/// Minutes east of UTC of zones by their names (those of Europe and North America, which no
/// other zone in use there is called).
std::optional<int> zone_called(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, int>, 18> kZones{
      {{"z", 0},      {"utc", 0},     {"gmt", 0},     {"wet", 0},     {"west", 60},
       {"cet", 60},   {"cest", 120},  {"mez", 60},    {"mesz", 120},  {"eet", 120},
       {"eest", 180}, {"est", -300},  {"edt", -240},  {"mst", -420},  {"mdt", -360},
       {"pst", -480}, {"pdt", -420},  {"jst", 540}}};
  for (const auto& [name, minutes] : kZones)
    if (word == name) return minutes;
  return std::nullopt;
}

/// "Z", "UTC", "CET", "+02", "+0200", "+02:00" or "GMT+1" to the end.
bool read_zone(std::string_view text, ClockTime& clock) {
  constexpr int kLargestZone = 14 * 60;  // of the world
  text = strip(text);
  if (text.empty()) return true;
  const std::string word = lower_case(text);
  if (const auto zone = zone_called(word)) {
    clock.zone = zone;
    return true;
  }
  const bool named = word.starts_with("gmt") || word.starts_with("utc");
  if (named) text.remove_prefix(3);
  const bool west = take(text, '-');
  if (!west && !take(text, '+')) return false;
  const auto hours = digits(text, named ? 1 : 2, 2);
  take(text, ':');
  const auto minutes = text.empty() ? std::optional(0) : digits(text, 2, 2);
  if (!hours || !minutes || !text.empty()) return false;
  const int zone = 60 * *hours + *minutes;
  if (zone > kLargestZone || *minutes > 59) clock.problem = "there is no such zone";
  clock.zone = west ? -zone : zone;
  return true;
}

/// Takes "AM", "p.m." off the begin: 0 or 12 hours to be added.
std::optional<int> take_half_of_day(std::string_view& text) {
  constexpr std::array<std::pair<std::string_view, int>, 4> kHalves{
      {{"am", 0}, {"pm", 12}, {"a.m.", 0}, {"p.m.", 12}}};
  const std::string lower = lower_case(strip(text));
  for (const auto& [name, hours] : kHalves) {
    if (!lower.starts_with(name)) continue;
    text = strip(text).substr(name.size());
    return hours;
  }
  return std::nullopt;
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

/// Takes thousandths behind a colon ("10:00:00:250") off the begin.
Stamp take_thousandths(std::string_view& text) {
  constexpr std::size_t kDigits = 3;
  std::string_view rest = text;
  if (!take(rest, ':')) return 0;
  const auto number = digits(rest, kDigits, kDigits);
  if (!number) return 0;
  text = rest;
  return *number * (kStampOfOne / 1000);
}

/// Hours of the day of a clock that has twelve; 12 AM is midnight.
int hours_of_day(int hours, int half, ClockTime& clock) {
  if (hours < 1 || hours > 12) clock.problem = "a clock with AM and PM has hours 1 to 12";
  return hours % 12 + half;
}

/// Reads "10:00:00.5", "10:00" or "10:00:00 PM" to the end, with a zone behind it.
bool read_time_of_day(std::string_view text, ClockTime& clock) {
  auto hours = digits(text, 1, 2);
  if (!hours || !take(text, ':')) return false;
  const auto minutes = digits(text, 2, 2);
  if (!minutes) return false;
  Stamp seconds = 0;
  if (take(text, ':')) {
    const auto number = take_seconds(text);
    if (!number) return false;
    seconds = *number + take_thousandths(text);
  }
  if (const auto half = take_half_of_day(text)) {
    hours = hours_of_day(*hours, *half, clock);
    clock.has_half = true;
  }
  if (!read_zone(text, clock)) return false;
  clock.has_time = true;
  clock.is_leap = seconds >= kMinute;
  clock.time = (60 * *hours + *minutes) * kMinute + seconds;
  if (!clock.problem.empty()) return true;
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

std::optional<ClockTime> read_clock(std::string_view text, DateOrder order) {
  ClockTime clock;
  std::string_view rest = strip(text);
  if (!take_date(rest, order, clock) && !take_named_date(rest, clock)) {
    if (!read_time_of_day(rest, clock)) return std::nullopt;
    return clock;
  }
  if (rest.empty()) return clock;
  if (rest.front() != 'T' && rest.front() != ' ') return std::nullopt;
  if (!read_time_of_day(strip(rest.substr(1)), clock)) return std::nullopt;
  return clock;
}

Stamp ElapsedTimes::operator()(const ClockTime& clock) {
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

}  // namespace lacuna
