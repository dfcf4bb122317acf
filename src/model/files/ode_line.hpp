// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lacuna {

/// What is left to read of one line of a text model.
class OdeLine {
 public:
  /// @param text without comment; @param number from 1.
  OdeLine(std::string_view text, std::size_t number, const std::string& source);

  bool at_end();

  /// The next word if it is this one.
  bool take(std::string_view word);

  /// The next identifier. @throws ModelError when there is none.
  std::string identifier(const std::string& what);

  /// The next character. @throws ModelError when it is another one.
  void expect(char c);

  /// "[V]", if it is there: "V".
  std::string unit();

  /// A formula up to the end.
  std::string_view formula();

  /// A formula up to a unit, a word that may stand behind a value, or the end.
  std::string_view value();

  /// Where the next character stands: "m.ode:3:14".
  std::string place() const { return place_at(position_); }
  std::string place_of(std::string_view part) const;

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  void skip_blanks();
  std::string_view formula_until(std::size_t end);
  std::string place_at(std::size_t position) const;

  std::string_view text_;
  std::size_t number_;
  const std::string& source_;
  std::size_t position_ = 0;
};

}  // namespace lacuna
