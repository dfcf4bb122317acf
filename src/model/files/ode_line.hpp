// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// The rest to read of one line of a text model.
class OdeLine {
 public:
  /// @param text the whole line; @param number from 1.
  /// @throws ModelError for a character that is not seen, in its comment too.
  OdeLine(std::string_view text, std::size_t number, const std::string& source);

  bool at_end();

  /// The next word if it is this one.
  bool take(std::string_view word);

  /// The next word if it is this one and begins a statement: "time = x" is an output.
  bool take_keyword(std::string_view word);

  /// The next identifier. @throws ModelError when there is none.
  std::string identifier(const std::string& what);

  /// The next character. @throws ModelError when it is another one.
  void expect(char c);

  /// "[V]", if it is there: "V".
  std::string unit();

  /// A unit up to the end, which may be in brackets: "s", "[s]".
  std::string time_unit();

  /// A formula up to the end.
  std::string_view formula();

  /// A formula up to a character. @throws ModelError where it is missing.
  std::string_view formula_before(char c);

  /// The next number, which ends at a blank; nothing where there is none.
  std::optional<double> number();

  /// A formula up to a unit, the law of a noise, or the end.
  std::string_view formula_before_unit();

  /// A formula up to a unit, a word that may stand behind a value, or the end.
  std::string_view value();

  /// Where the next character stands: "m.ode:3:14".
  std::string place() const { return place_at(position_); }
  std::string place_of(std::string_view part) const;

  std::size_t line_number() const { return number_; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  void skip_blanks();
  bool is_next(char c) const { return position_ < text_.size() && text_[position_] == c; }
  std::string checked_unit(std::string_view text) const;
  std::size_t position_in(std::string_view part) const;
  std::string_view formula_until(std::size_t end);
  std::size_t begin_of_noise() const;
  std::string place_at(std::size_t position) const;

  std::string_view text_;
  std::size_t number_;
  const std::string& source_;
  std::size_t position_ = 0;
};

}  // namespace lacuna
