// SPDX-License-Identifier: MIT
#include "ode_line.hpp"

#include <algorithm>
#include <array>

#include "core/base/utf8.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/names.hpp"
#include "lacuna/core/base/text.hpp"

namespace lacuna {
namespace {

/// Words that may stand behind a value.
constexpr std::array<std::string_view, 4> kBehindValues = {"fixed", "in", "deviation",
                                                           "per_record"};

bool is_word_character(char c) { return is_identifier(std::string{'x', c}); }

}  // namespace

OdeLine::OdeLine(std::string_view text, std::size_t number, const std::string& source)
    : text_(text), number_(number), source_(source) {}

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
  if (is_reserved_name(name))
    fail("the name '" + name + "' is a word of the formula language", "choose another");
  position_ += name.size();
  return name;
}

void OdeLine::expect(char c) {
  skip_blanks();
  if (position_ == text_.size() || text_[position_] != c)
    fail(std::string("'") + c + "' is missing here",
         "see the examples in docs/file-formats.md");
  ++position_;
}

std::string OdeLine::unit() {
  skip_blanks();
  if (position_ == text_.size() || text_[position_] != '[') return "";
  const std::size_t end = text_.find(']', position_);
  if (end == std::string_view::npos) fail("the unit has no end", "write e.g. [V]");
  const std::string_view unit = trim(text_.substr(position_ + 1, end - position_ - 1));
  if (printable(unit) != unit) fail("the unit has control characters", "remove them");
  position_ = end + 1;
  return std::string(unit);
}

std::string_view OdeLine::formula_until(std::size_t end) {
  const std::string_view formula = trim(text_.substr(position_, end - position_));
  if (formula.empty()) fail("there is no formula here", "write one, e.g. -0.5*x + u");
  position_ = end;
  return formula;
}

std::string_view OdeLine::formula() { return formula_until(text_.size()); }

std::string_view OdeLine::value() {
  const std::size_t begin = position_;
  std::size_t end = begin;
  for (; end < text_.size() && text_[end] != '['; ++end) {
    position_ = end;
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

std::string OdeLine::place_of(std::string_view part) const {
  return place_at(static_cast<std::size_t>(part.data() - text_.data()));
}

void OdeLine::fail(const std::string& problem, const std::string& remedy) const {
  throw ModelError(place(), problem, remedy);
}

}  // namespace lacuna
