// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lacuna {

/// Text as it stands in HTML and XML, as content and in quoted attributes: & < > " ' become
/// character references; what is not UTF-8 and control characters become letters (printable()).
std::string escape_markup(std::string_view text);

/// A piece of HTML or SVG: a value that text from outside enters only through escape_markup().
class Markup {
 public:
  Markup() = default;

  /// Text, escaped.
  static Markup text(std::string_view text);

  /// Markup that the program has written itself; nothing from files or from the user.
  static Markup own(std::string markup);

  Markup& operator+=(const Markup& other);
  friend Markup operator+(Markup a, const Markup& b) { return a += b; }

  const std::string& string() const noexcept { return markup_; }
  bool empty() const noexcept { return markup_.empty(); }

 private:
  std::string markup_;
};

/// Names and values of attributes; values are escaped.
using Attributes = std::vector<std::pair<std::string_view, std::string>>;

/// `<name attributes>content</name>`; name and names of attributes are the program's own.
Markup element(std::string_view name, const Attributes& attributes, const Markup& content);
Markup element(std::string_view name, const Markup& content);

/// An element without content, as XML has it: `<name attributes/>`.
Markup empty_element(std::string_view name, const Attributes& attributes);

}  // namespace lacuna
