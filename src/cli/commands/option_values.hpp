// SPDX-License-Identifier: MIT
// What values an option takes, with sentences for those that it does not.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace lacuna::cli {

/// A number in a range with its ends; NaN is in none.
CLI::Validator from_to(double low, double high);

/// A number that is neither infinite nor NaN.
CLI::Validator finite();

/// A number above 0 that is finite.
CLI::Validator above_zero();

/// One of these words.
CLI::Validator one_of(std::vector<std::string> words);

/// One of these words, in the place of which its number is read.
CLI::Validator number_of(std::map<std::string, int> words);

/// The same of a map to enumerators.
template <class Enum>
CLI::Validator value_of(const std::map<std::string, Enum>& values) {
  std::map<std::string, int> numbers;
  for (const auto& [word, value] : values) numbers.emplace(word, static_cast<int>(value));
  return number_of(std::move(numbers));
}

/// What is wrong with the arguments, in a sentence of its own, with what to do about it.
/// @param root that was parsed.
std::string sentence_of(const CLI::ParseError& error, CLI::App& root);

}  // namespace lacuna::cli
