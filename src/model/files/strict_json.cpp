// SPDX-License-Identifier: MIT
#include "strict_json.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/base/json_text.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

using nlohmann::json;

/// Follows the events of a parser and knows the path it is at; remembers the first repeated
/// key. (A callback of json::parse would see them too, but makes it quadratic in the length of
/// arrays.)
class KeyWatcher : public nlohmann::json_sax<json> {
 public:
  bool null() override { return next_element(); }
  bool boolean(bool) override { return next_element(); }
  bool number_integer(number_integer_t) override { return next_element(); }
  bool number_unsigned(number_unsigned_t) override { return next_element(); }
  bool number_float(number_float_t, const string_t&) override { return next_element(); }
  bool string(string_t&) override { return next_element(); }
  bool binary(binary_t&) override { return next_element(); }
  bool start_object(std::size_t) override { return start_level(false); }
  bool end_object() override { return end_level(); }
  bool start_array(std::size_t) override { return start_level(true); }
  bool end_array() override { return end_level(); }
  bool key(string_t& key) override {
    levels_.back().key = key;
    if (!levels_.back().keys.insert(key).second && !repeated_) repeated_ = path();
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

  /// Path of the first key that stands twice in its object.
  const std::optional<std::string>& repeated() const { return repeated_; }

 private:
  struct Level {
    bool is_array;
    std::size_t count;
    std::string key;
    std::set<std::string> keys;
  };

  bool next_element() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().count;
    return true;
  }

  bool start_level(bool is_array) {
    next_element();
    levels_.push_back({is_array, 0, {}, {}});
    return true;
  }

  bool end_level() {
    levels_.pop_back();
    return true;
  }

  std::string path() const {
    std::string text = "$";
    for (const Level& level : levels_) {
      if (level.is_array)
        text.append("[").append(std::to_string(level.count - 1)).append("]");
      else
        text.append(".").append(level.key);
    }
    return text;
  }

  std::vector<Level> levels_;
  std::optional<std::string> repeated_;
};

/// "source:line:column" of a byte; the parser gives the last one of a bad token.
std::string position_text(std::string_view text, std::size_t byte, const std::string& source) {
  return source + ":" + line_and_column(text, byte);
}

std::string syntax_problem(std::string_view text, std::size_t byte) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return "the file is empty";
  if (byte > text.size()) return "the JSON text ends too early";
  return "not valid JSON";
}

std::string type_text(const json& value) {
  return value.is_null() ? "null" : std::string("a JSON ") + value.type_name();
}

/// The path of the first key that stands twice in one object of a JSON text, "$.basis.type".
std::optional<std::string> repeated_key(std::string_view text) {
  KeyWatcher watcher;
  json::sax_parse(text, &watcher);
  return watcher.repeated();
}

}  // namespace

json parse_strict_json(std::string_view text, const std::string& source) {
  if (const auto byte = deeper_than(kDeepestJson, text))
    throw ModelError(position_text(text, *byte, source),
                     "nested deeper than " + std::to_string(kDeepestJson) + " levels",
                     "check the brackets there; what is read has a few levels");
  json parsed;
  try {
    parsed = json::parse(text);
  } catch (const json::parse_error& error) {
    throw ModelError(position_text(text, error.byte, source), syntax_problem(text, error.byte),
                     "check quotes, commas and brackets there");
  } catch (const json::exception&) {
    throw ModelError(position_text(text, overflowing_number(text).value_or(1), source),
                     "a number is out of the range of a double", "use a smaller exponent");
  }
  if (const auto path = repeated_key(text))
    throw ModelError(source + ": " + *path, "the key stands twice in its object",
                     "remove one of them");
  return parsed;
}

void JsonPlace::expect_keys(std::initializer_list<std::string_view> known) const {
  if (!value_->is_object())
    fail("an object is expected here, not " + type_text(*value_), "write {...}");
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, value] : value_->items())
    if (std::find(names.begin(), names.end(), key) == names.end())
      fail("unknown key '" + key + "'", suggestion(key, names));
}

JsonPlace JsonPlace::at(const std::string& key) const {
  std::optional<JsonPlace> member = find(key);
  if (!member) fail("the key '" + key + "' is missing", "add it");
  return *std::move(member);
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPlace(*found, source_, path_ + "." + key);
}

std::size_t JsonPlace::size() const {
  if (!value_->is_array())
    fail("an array is expected here, not " + type_text(*value_), "write [...]");
  return value_->size();
}

JsonPlace JsonPlace::at(std::size_t index) const {
  return JsonPlace((*value_)[index], source_, path_ + "[" + std::to_string(index) + "]");
}

std::string JsonPlace::text() const {
  if (!value_->is_string())
    fail("a string is expected here, not " + type_text(*value_), "put it in quotes");
  return value_->get<std::string>();
}

double JsonPlace::number() const {
  if (!value_->is_number())
    fail("a number is expected here, not " + type_text(*value_), "write it without quotes");
  return value_->get<double>();
}

bool JsonPlace::flag() const {
  if (!value_->is_boolean())
    fail("true or false is expected here, not " + type_text(*value_), "write it so");
  return value_->get<bool>();
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_->is_object())
    fail("an object is expected here, not " + type_text(*value_), "write {...}");
  std::vector<std::string> names;
  for (const auto& [key, value] : value_->items()) names.push_back(key);
  return names;
}

void JsonPlace::fail(const std::string& problem, const std::string& remedy,
                     const std::string& detail) const {
  throw ModelError(source_ + ": " + path_ + detail, problem, remedy);
}

}  // namespace lacuna
