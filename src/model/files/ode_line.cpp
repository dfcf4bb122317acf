// SPDX-License-Identifier: MIT
#include "ode_line.hpp"

#include <algorithm>
#include <array>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

/// Words that may stand behind a value.
constexpr std::array<std::string_view, 6> kBehindValues = {
    "fixed", "in", "deviation", "per_record", "at", "varies"};
/// What no value goes on with, whether a blank stands in front of it or not.
constexpr std::array<std::string_view, 2> kDeviations = {"+-", "*/"};

bool is_word_character(char c) {
  const std::array<char, 2> word{'x', c};
  return is_identifier({word.data(), word.size()});
}

/// The line up to the first `#` that is not inside the brackets of a unit: "conc [#/cm3]".
std::string_view without_comment(std::string_view line) {
  bool in_unit = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '[' || line[i] == ']') in_unit = line[i] == '[';
    if (line[i] == '#' && !in_unit) return line.substr(0, i);
  }
  return line;
}

}  // namespace

OdeLine::OdeLine(std::string_view text, std::size_t number, const std::string& source)
    : text_(text), number_(number), source_(source) {
  if (const auto fault = comment_fault(text))
    throw ModelError(place_at(fault->at), fault->problem, fault->remedy);
  text_ = without_comment(text);
}

void OdeLine::skip_blanks() {
  while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t'))
    ++position_;
}

bool OdeLine::at_end() {
  skip_blanks();
  return position_ == text_.size();
}

bool OdeLine::take(std::string_view word) {
  skip_blanks();
  if (text_.substr(position_, word.size()) != word) return false;
  const std::size_t end = position_ + word.size();
  if (end < text_.size() && is_word_character(word.back()) && is_word_character(text_[end]))
    return false;
  position_ = end;
  return true;
}

std::string OdeLine::identifier(const std::string& what) {
  skip_blanks();
  const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(position_);
  const std::string name(begin, std::find_if_not(begin, text_.end(), is_word_character));
  if (!is_identifier(name))
    fail("there is no " + what + " here",
         "use letters, digits and underscores, a letter first");
  if (const auto fault = name_fault(name)) fail(fault->problem, fault->remedy);
  position_ += name.size();
  return name;
}

void OdeLine::expect(char c) {
  skip_blanks();
  if (!is_next(c))
    fail(std::string("'") + c + "' is missing here",
         "see the examples in docs/file-formats.md");
  ++position_;
}

bool OdeLine::take_keyword(std::string_view word) {
  const std::size_t begin = position_;
  if (!take(word)) return false;
  const std::size_t end = position_;
  skip_blanks();
  const bool is_name = is_next('=');
  position_ = is_name ? begin : end;
  return !is_name;
}

std::string OdeLine::checked_unit(std::string_view text) const {
  const std::string_view unit = trim(text);
  if (const auto fault = unit_fault(unit))
    throw ModelError(place_at(position_in(unit) + fault->at), fault->problem, fault->remedy);
  return std::string(unit);
}

std::string OdeLine::unit() {
  skip_blanks();
  if (!is_next('[')) return {};
  const std::size_t end = text_.find(']', position_);
  if (end == std::string_view::npos) fail("the unit has no end", "write e.g. [V]");
  std::string unit = checked_unit(text_.substr(position_ + 1, end - position_ - 1));
  position_ = end + 1;
  return unit;
}

std::string OdeLine::time_unit() {
  skip_blanks();
  if (is_next('[')) return unit();
  std::string unit = checked_unit(text_.substr(position_));
  position_ = text_.size();
  return unit;
}

std::string_view OdeLine::formula_until(std::size_t end) {
  const std::string_view formula = trim(text_.substr(position_, end - position_));
  if (formula.empty()) fail("there is no formula here", "write one, e.g. -0.5*x + u");
  position_ = end;
  return formula;
}

std::string_view OdeLine::formula() { return formula_until(text_.size()); }

std::string_view OdeLine::formula_before(char c) {
  const std::size_t end = text_.find(c, position_);
  if (end == std::string_view::npos)
    fail(std::string("'") + c + "' is missing behind this",
         "see the examples in docs/file-formats.md");
  return formula_until(end);
}

std::optional<double> OdeLine::number() {
  skip_blanks();
  const std::size_t end = std::min(text_.find_first_of(" \t", position_), text_.size());
  const std::optional<double> number = parse_number(text_.substr(position_, end - position_));
  if (number) position_ = end;
  return number;
}

/// Where " noise LAW" begins; a variable may be called noise as well.
std::size_t OdeLine::begin_of_noise() const {
  constexpr std::string_view kNoise = " noise ";
  for (std::size_t at = text_.find(kNoise, position_); at != std::string_view::npos;
       at = text_.find(kNoise, at + 1)) {
    const std::string_view behind = trim(text_.substr(at + kNoise.size()));
    const auto end = std::find_if_not(behind.begin(), behind.end(), is_word_character);
    if (noise_form_named({behind.begin(), end})) return at;
  }
  return text_.size();
}

std::string_view OdeLine::formula_before_unit() {
  return formula_until(std::min({text_.find('[', position_), begin_of_noise(), text_.size()}));
}

std::string_view OdeLine::value() {
  const std::size_t begin = position_;
  std::size_t end = begin;
  for (; end < text_.size() && text_[end] != '['; ++end) {
    position_ = end;
    if (std::find(kDeviations.begin(), kDeviations.end(), text_.substr(end, 2)) !=
        kDeviations.end())
      break;
    const bool starts_word = end == begin || !is_word_character(text_[end - 1]);
    if (starts_word && text_[end] != ' ' &&
        std::any_of(kBehindValues.begin(), kBehindValues.end(),
                    [&](std::string_view word) { return take(word); }))
      break;
  }
  position_ = begin;
  return formula_until(end);
}

std::string OdeLine::place_at(std::size_t position) const {
  return source_ + ":" + std::to_string(number_) + ":" + std::to_string(position + 1);
}

std::size_t OdeLine::position_in(std::string_view part) const {
  return static_cast<std::size_t>(part.data() - text_.data());
}

std::string OdeLine::place_of(std::string_view part) const {
  return place_at(position_in(part));
}

void OdeLine::fail(const std::string& problem, const std::string& remedy) const {
  throw ModelError(place(), problem, remedy);
}

}  // namespace lacuna
