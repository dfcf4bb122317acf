// SPDX-License-Identifier: MIT
#include "repository/declarations.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <stdexcept>

namespace lacuna::repository {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string trimmed(std::string text) {
  while (!text.empty() && is_space(text.back())) text.pop_back();
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  return {first, text.end()};
}

/// Where the comment, literal or directive that begins at `at` ends; `at` where none begins.
std::size_t end_of_blank(const std::string& text, std::size_t at) {
  const auto past = [&](const std::string& mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string::npos ? text.size() : found + mark.size();
  };
  if (text.compare(at, 2, "//") == 0) return std::min(text.size(), past("\n", at) - 1);
  if (text.compare(at, 2, "/*") == 0) return past("*/", at + 2);
  if (text.compare(at, 2, "R\"") == 0 && (at == 0 || !is_word(text[at - 1]))) {
    const std::size_t open = text.find('(', at);
    return past(")" + text.substr(at + 2, open - at - 2) + "\"", open);
  }
  const bool separates_digits = text[at] == '\'' && at > 0 && is_word(text[at - 1]);
  const bool quoted = (text[at] == '"' || text[at] == '\'') && !separates_digits;
  if (quoted) {
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != text[at]) end += text[end] == '\\' ? 2 : 1;
    return end + 1;
  }
  if (text[at] == '#') {
    std::size_t end = text.find('\n', at);
    while (end != std::string::npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
    return std::min(text.size(), end);
  }
  return at;
}

}  // namespace

std::string code_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(end_of_blank(text, at), text.size());
    for (std::size_t i = at; i < end; ++i)
      if (text[i] != '\n') text[i] = ' ';
    at = std::max(end, at + 1);
  }
  return text;
}

std::size_t closing(const std::string& text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    if (std::string("([{").find(text[i]) != std::string::npos) ++depth;
    if (std::string(")]}").find(text[i]) != std::string::npos && --depth == 0) return i;
  }
  throw std::runtime_error("a bracket is not closed: " + text.substr(at, 40));
}

namespace {

/// The place of the ">" that closes the "<" at `at`.
std::size_t closing_angle(const std::string& text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    if (text[i] == '(' || text[i] == '{') i = closing(text, i);
    if (text[i] == '<') ++depth;
    if (text[i] == '>' && text[i - 1] != '-' && --depth == 0) return i;
  }
  throw std::runtime_error("an angle bracket is not closed: " + text.substr(at, 40));
}

bool follows_operator(const std::string& text, std::size_t at) {
  while (at > 0 && !is_word(text[at - 1]) && text[at - 1] != ')') --at;
  return at >= 8 && text.compare(at - 8, 8, "operator") == 0;
}

/// A declaration without what its brackets hold: "()" for each pair of parentheses outside of
/// template arguments, nothing for other brackets and for initialisers.
struct Flat {
  std::string text;
  std::vector<std::string> groups;  ///< what the parentheses held
};

Flat flatten(const std::string& head) {
  Flat flat;
  for (std::size_t at = 0; at < head.size(); ++at) {
    const char c = head[at];
    const bool of_operator = follows_operator(head, at);
    if (c == '(') {
      const std::size_t end = closing(head, at);
      flat.text += "()";
      flat.groups.push_back(head.substr(at + 1, end - at - 1));
      at = end;
    } else if ((c == '[' && !of_operator) || c == '{') {
      at = closing(head, at);
    } else if (c == '<' && !of_operator) {
      at = closing_angle(head, at);
    } else if (c == '=' && !of_operator) {
      while (at + 1 < head.size() && head[at + 1] != ',')
        at = std::string("([{").find(head[at + 1]) != std::string::npos ? closing(head, at + 1)
                                                                        : at + 1;
    } else {
      flat.text += c;
    }
  }
  return flat;
}

/// The pieces between commas that stand in no brackets, without initialisers.
std::vector<std::string> pieces_of(const std::string& list) {
  std::vector<std::string> pieces(1);
  bool is_value = false;
  for (std::size_t at = 0; at < list.size(); ++at) {
    std::size_t end = at;
    if (std::string("([{").find(list[at]) != std::string::npos) end = closing(list, at);
    if (list[at] == '<' && !is_value) end = closing_angle(list, at);
    if (list[at] == ',') pieces.emplace_back();
    is_value = list[at] == '=' || (is_value && list[at] != ',');
    if (list[at] != ',' && !is_value) pieces.back() += list.substr(at, end - at + 1);
    at = end;
  }
  return pieces;
}

/// "const Matrix&" of the parameter "const Matrix& a = {}".
std::string type_of(const std::string& parameter) {
  static const std::regex blanks(R"(\s+)");
  static const std::regex named(R"((.*[\s&*>])\w+)");
  const std::string text = std::regex_replace(trimmed(parameter), blanks, " ");
  std::smatch match;
  return trimmed(std::regex_match(text, match, named) ? match[1].str() : text);
}

std::vector<std::string> types_of(const std::string& group) {
  if (const std::string text = trimmed(group); text.empty() || text == "void") return {};
  std::vector<std::string> types;
  for (const std::string& piece : pieces_of(group)) types.push_back(type_of(piece));
  return types;
}

/// The name in front of the parameters of a declaration, and their types.
struct Signature {
  std::string name;
  std::vector<std::string> types = {};
};

/// The signature of a function's declaration; an empty name for anything else.
Signature signature_of(const Flat& flat) {
  static const std::regex pattern(R"(((?:\w+\s*::\s*)*(?:operator[^(]*|~?\w+))\s*\(\))");
  static const std::set<std::string> others = {"decltype", "alignas", "explicit", "noexcept"};
  for (std::sregex_iterator match(flat.text.begin(), flat.text.end(), pattern), none;
       match != none; ++match) {
    const std::string name = (*match)[1];
    if (others.contains(name)) continue;
    const auto end = static_cast<std::size_t>(match->position() + match->length());
    std::size_t group = 0;
    for (std::size_t at = flat.text.find("()"); at + 2 < end; at = flat.text.find("()", at + 2))
      ++group;
    if (name == "operator" || name.ends_with("::operator")) ++group;  // operator()
    return {name, types_of(flat.groups.at(group))};
  }
  return {};
}

std::string first_word(const std::string& head) {
  return {head.begin(), std::find_if_not(head.begin(), head.end(), is_word)};
}

bool is_class(const std::string& head) {
  const std::string word = first_word(head);
  return word == "class" || word == "struct" || word == "union";
}

/// Names of the members that a declaration in a class adds and that can change.
std::vector<std::string> mutable_members(const std::string& head) {
  static const std::set<std::string> others = {"using", "typedef", "friend", "static",   "enum",
                                               "class", "struct",  "union",  "template", ""};
  const Flat flat = flatten(head);
  if (others.contains(first_word(head)) || !flat.groups.empty()) return {};
  const bool is_pointer = flat.text.find('*') != std::string::npos;
  if (flat.text.find('&') != std::string::npos) return {};
  if (first_word(head) == "const" && !is_pointer) return {};
  std::vector<std::string> names;
  for (const std::string& piece : pieces_of(flat.text)) {
    const std::string text = trimmed(piece);
    const auto begin = std::find_if_not(text.rbegin(), text.rend(), is_word);
    names.emplace_back(begin.base(), text.end());
  }
  return names;
}

/// Whether the "{" at the end of a function's head begins the value of a member: " : x_".
bool initialises_member(const std::string& head) {
  static const std::regex list(R"(\)\s*(noexcept\s*)?:[^:])");
  const std::string text = flatten(head).text;
  if (!std::regex_search(text, list)) return false;
  const char last = trimmed(head).back();
  return is_word(last) || last == '>';
}

/// A namespace, or a class with its name.
struct Scope {
  std::string owner;
  bool is_class = false;
  bool is_public = true;
  std::size_t place = 0;     ///< of the class among those read
  bool is_reachable = true;  ///< the class itself is public
  bool is_template = false;
};

class Reader {
 public:
  explicit Reader(const std::vector<std::string>& lines) : text_(code_of(lines)) {}

  Declarations run() {
    read_scope(0, text_.size(), {});
    return std::move(found_);
  }

 private:
  void read_scope(std::size_t begin, std::size_t end, Scope scope) {
    std::size_t start = begin;  // of the declaration that is being read
    for (std::size_t at = begin; at < end; ++at) {
      const char c = text_[at];
      const std::string head = std::string(";<:{").find(c) != std::string::npos
                                   ? trimmed(text_.substr(start, at - start))
                                   : "";
      if (c == ';') {
        declare(head, start, at, scope);
        start = at + 1;
        is_template_ = false;
      } else if (c == '<' && head == "template") {
        at = closing_angle(text_, at);
        start = at + 1;
        is_template_ = true;
      } else if (c == ':' && (head == "public" || head == "private" || head == "protected")) {
        scope.is_public = head == "public";
        start = at + 1;
      } else if (c == '(' || c == '[') {
        at = closing(text_, at);
      } else if (c == '=' && !follows_operator(text_, at)) {
        while (text_[at + 1] != ';')
          at = std::string("([{").find(text_[at + 1]) != std::string::npos
                   ? closing(text_, at + 1)
                   : at + 1;
      } else if (c == '{') {
        const std::size_t close = closing(text_, at);
        if (open(head, start, at, scope)) {
          start = close + 1;
          is_template_ = false;
        }
        at = close;
      }
    }
  }

  /// What the "{" at `at` begins; false if the declaration goes on behind it.
  bool open(const std::string& head, std::size_t start, std::size_t at, const Scope& scope) {
    const std::size_t close = closing(text_, at);
    const std::string word = first_word(head);
    const bool is_template = is_template_ || scope.is_template;
    if (word == "namespace") {
      read_scope(at + 1, close, {});
      return true;
    }
    if (is_class(head)) {
      Scope inner = add_class(head, start, scope);
      inner.is_template = found_.classes.back().is_template = is_template;
      is_template_ = false;
      read_scope(at + 1, close, inner);
      return false;
    }
    if (word == "enum" || initialises_member(head)) return false;
    if (signature_of(flatten(head)).name.empty()) return false;
    FunctionText& function = add_function(head, start, close, scope);
    function.has_body = true;
    function.is_template = is_template;
    return true;
  }

  void declare(const std::string& head, std::size_t start, std::size_t at, const Scope& scope) {
    static const std::set<std::string> others = {"using", "typedef", "friend", "static_assert"};
    if (others.contains(first_word(head))) return;
    if (scope.is_class) add_members(mutable_members(head), at, scope);
    if (!signature_of(flatten(head)).name.empty()) add_function(head, start, at, scope);
  }

  void add_members(const std::vector<std::string>& names, std::size_t at, const Scope& scope) {
    ClassText& type = found_.classes[scope.place];
    if (!scope.is_public) return;
    for (const std::string& name : names) type.members.push_back({name, line_at(at)});
  }

  Scope add_class(const std::string& head, std::size_t start, const Scope& scope) {
    static const std::regex pattern(R"(^(?:class|struct|union)\s+((?:\w+::)*\w+))");
    const std::string text = flatten(head).text;
    std::smatch match;
    std::regex_search(text, match, pattern);
    const std::string name = (scope.owner.empty() ? "" : scope.owner + "::") + match[1].str();
    const bool is_reachable = scope.is_public && scope.is_reachable;
    found_.classes.push_back({.name = name, .line = line_at(start), .is_public = is_reachable});
    return {name, true, first_word(head) != "class", found_.classes.size() - 1, is_reachable};
  }

  FunctionText& add_function(const std::string& head, std::size_t start, std::size_t end,
                             const Scope& scope) {
    const Signature signature = signature_of(flatten(head));
    const std::size_t colon = signature.name.rfind("::");
    const bool is_qualified = colon != std::string::npos;
    FunctionText function;
    function.owner = is_qualified ? signature.name.substr(0, colon) : scope.owner;
    function.name = is_qualified ? signature.name.substr(colon + 2) : signature.name;
    function.first = line_at(start);
    function.last = line_at(end);
    static const std::regex deleted(R"(=\s*delete\s*$)");
    function.types = signature.types;
    function.parameters = static_cast<int>(signature.types.size());
    function.is_public = scope.is_public && scope.is_reachable;
    function.is_static = first_word(head) == "static";
    function.is_template = is_template_ || scope.is_template;
    function.is_deleted = std::regex_search(head, deleted);
    found_.functions.push_back(function);
    return found_.functions.back();
  }

  /// The line of the first word at or behind a place.
  std::size_t line_at(std::size_t place) const {
    while (place + 1 < text_.size() && is_space(text_[place])) ++place;
    return 1 + static_cast<std::size_t>(
                   std::count(text_.begin(), text_.begin() + static_cast<long>(place), '\n'));
  }

  const std::string text_;
  Declarations found_;
  bool is_template_ = false;  ///< the declaration that is being read is one
};

}  // namespace

Declarations read_declarations(const std::vector<std::string>& lines) {
  return Reader(lines).run();
}

}  // namespace lacuna::repository
