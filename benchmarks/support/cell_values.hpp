// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

namespace lacuna::benchmarks {

/// A struct that lists what it holds:
///     auto fields() { return std::tie(exact, error, seconds); }
template <class T>
concept HasFields = requires(T& value) {
  value.fields();
};

/// std::vector, std::array, Vector.
template <class T>
concept IsList = !std::same_as<T, std::string> && requires(T & value) {
  value.begin();
  value.size();
};

template <class T>
concept IsOptional = requires(T& value) {
  value.has_value();
  value.emplace();
};

/// The values of a finished cell as JSON; read_value() gives the same back to the bit. Numbers,
/// text, enumerations, optional values, lists of these, and structs of these with fields().
template <class T>
nlohmann::json json_of(T& value) {
  using Json = nlohmann::json;
  if constexpr (HasFields<T>) {
    const auto listed = [](auto&... field) { return Json::array({json_of(field)...}); };
    return std::apply(listed, value.fields());
  } else if constexpr (IsOptional<T>) {
    return value ? json_of(*value) : Json();
  } else if constexpr (IsList<T>) {
    Json list = Json::array();
    for (auto& entry : value) list.push_back(json_of(entry));
    return list;
  } else if constexpr (std::same_as<T, double>) {
    // JSON has no word for these.
    return std::isfinite(value) ? Json(value) : Json(std::to_string(value));
  } else {
    return Json(value);
  }
}

/// @throws nlohmann::json::exception where something else stands there.
template <class T>
void read_value(const nlohmann::json& json, T& value) {
  if constexpr (HasFields<T>) {
    std::size_t place = 0;
    const auto read = [&](auto&... field) { (read_value(json.at(place++), field), ...); };
    std::apply(read, value.fields());
  } else if constexpr (IsOptional<T>) {
    value.reset();
    if (!json.is_null()) read_value(json, value.emplace());
  } else if constexpr (IsList<T>) {
    if constexpr (requires { value.resize(json.size()); }) value.resize(json.size());
    std::size_t place = 0;
    for (auto& entry : value) read_value(json.at(place++), entry);
  } else if constexpr (std::same_as<T, double>) {
    value = json.is_string() ? std::strtod(json.get_ref<const std::string&>().c_str(), nullptr)
                             : json.get<double>();
  } else {
    value = json.get<T>();
  }
}

}  // namespace lacuna::benchmarks
