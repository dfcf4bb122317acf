// SPDX-License-Identifier: MIT
#include "report/plot/markup.hpp"

#include "core/base/utf8.hpp"

namespace lacuna {
namespace {

std::string opened(std::string_view name, const Attributes& attributes) {
  std::string text = "<" + std::string(name);
  for (const auto& [key, value] : attributes)
    text += " " + std::string(key) + "=\"" + escape_markup(value) + "\"";
  return text;
}

}  // namespace

std::string escape_markup(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

Markup Markup::text(std::string_view text) { return own(escape_markup(text)); }

Markup Markup::own(std::string markup) {
  Markup result;
  result.markup_ = std::move(markup);
  return result;
}

Markup& Markup::operator+=(const Markup& other) {
  markup_ += other.markup_;
  return *this;
}

Markup element(std::string_view name, const Attributes& attributes, const Markup& content) {
  return Markup::own(opened(name, attributes) + ">" + content.string() + "</" +
                     std::string(name) + ">");
}

Markup element(std::string_view name, const Markup& content) {
  return element(name, {}, content);
}

Markup empty_element(std::string_view name, const Attributes& attributes) {
  return Markup::own(opened(name, attributes) + "/>");
}

}  // namespace lacuna
