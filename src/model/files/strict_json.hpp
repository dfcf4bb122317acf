// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// Parses JSON text.
/// @throws ModelError naming source, line and column (the end of the token that does not fit)
/// of
///   a syntax error, or source and JSON path of a key that stands twice in one object.
nlohmann::json parse_strict_json(std::string_view text, const std::string& source);

/// The path of the first key that stands twice in one object of a JSON text, "$.basis.type".
std::optional<std::string> repeated_key(std::string_view json);

/// A place in a JSON document: its value and the path to it, for messages.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string source)
      : JsonPlace(value, std::move(source), "$") {}

  /// @throws ModelError unless it is an object with no keys but these.
  void expect_keys(std::initializer_list<std::string_view> known) const;

  /// The member. @throws ModelError when it is missing.
  JsonPlace at(const std::string& key) const;

  /// The member, if there is one.
  std::optional<JsonPlace> find(const std::string& key) const;

  /// Number of elements. @throws ModelError unless it is an array.
  std::size_t size() const;

  /// An element of an array.
  JsonPlace at(std::size_t index) const;

  /// @throws ModelError unless it is a string.
  std::string text() const;

  /// @throws ModelError unless it is a finite number.
  double number() const;

  /// @throws ModelError unless it is true or false.
  bool flag() const;

  /// Keys of an object. @throws ModelError unless it is one.
  std::vector<std::string> keys() const;

  /// "$.states[0].name".
  const std::string& path() const noexcept { return path_; }

  /// Throws a ModelError about this place; `detail` is added to the path: ", column 3".
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy,
                         const std::string& detail = {}) const;

 private:
  JsonPlace(const nlohmann::json& value, std::string source, std::string path)
      : value_(&value), source_(std::move(source)), path_(std::move(path)) {}

  const nlohmann::json* value_;
  std::string source_;
  std::string path_;
};

}  // namespace lacuna
