// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// A decision: levels of objects and lists that an input may have. What is written here has at
/// most eight, a stage in a stage in a stage five.
inline constexpr std::size_t kDeepestJson = 32;

/// Parses JSON text: every file of JSON that somebody gives is read here.
/// @throws ModelError naming source, line and column (the end of the token that does not fit)
/// of a
///   syntax error or of more levels than kDeepestJson, or source and JSON path of a key that
///   stands twice in one object.
nlohmann::json parse_strict_json(std::string_view text, const std::string& source);

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
