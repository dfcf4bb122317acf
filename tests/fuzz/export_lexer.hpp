// SPDX-License-Identifier: MIT
// Exports as their languages take them apart: comments, strings, words. Knows nothing of how
// they are written.
#pragma once

#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::fuzz {

struct ForeignLanguage {
  std::string_view comment;         ///< begins one that goes to the end of the line
  std::string_view quotes;          ///< begin and end strings
  bool has_blocks = false;          ///< comments from /* to */
  bool comments_are_lines = false;  ///< `comment` counts at the begin of a line only
  bool has_commands = false;        ///< \word is one
  std::set<std::string> words;      ///< that exports have beside the names of the table
};

inline const ForeignLanguage& foreign_language(const std::string& format) {
  static const std::set<std::string> functions = {"sin",  "cos",  "tan", "asin", "acos",
                                                  "atan", "tanh", "exp", "log",  "sqrt"};
  const auto with = [](std::set<std::string> words) {
    words.insert(functions.begin(), functions.end());
    return words;
  };
  const auto c = [&](std::set<std::string> more) {
    more.merge(
        with({"include",    "math",       "h",    "static",      "inline",      "double",
              "const",      "return",     "void", "lacuna_rate", "lacuna_sign", "lacuna_step",
              "lacuna_min", "lacuna_max", "t",    "state_",      "input_",      "rate_",
              "v",          "w",          "fabs", "pow",         "int",         "for",
              "k",          "lacuna_i",   "part", "stage",       "step_",       "at_",
              "output_",    "jacobian_",  "lacuna_output",       "lacuna_initial",
              "lacuna_jacobian",          "lacuna_advance",      "lacuna_parameters"}));
    return ForeignLanguage{"//", "\"'", true, false, false, std::move(more)};
  };
  static const std::vector<std::pair<std::string, ForeignLanguage>> languages = {
      {"c", c({})},
      {"cpp", c({"array", "cmath", "std"})},
      {"python",
       {"#", "\"'", false, false, false, {"import",  "numpy",   "as",      "np",
                                          "def",     "rate",    "t",       "state",
                                          "inputs",  "float64", "asarray", "dtype",
                                          "float",   "return",  "array",   "sin",
                                          "cos",     "tan",     "arcsin",  "arccos",
                                          "arctan",  "tanh",    "exp",     "log",
                                          "sqrt",    "abs",     "sign",    "heaviside",
                                          "minimum", "maximum", "output",  "initial",
                                          "parameters"}}},
      {"matlab",
       {"%", "\"'", false, false, false,
        with({"function", "rate", "lacuna_rate", "lacuna_real", "lacuna_step", "lacuna_min",
              "lacuna_max", "t", "state", "input", "end", "v", "w", "if", "elseif", "imag",
              "NaN", "abs", "sign", "output", "initial", "parameter", "zeros"})}},
      {"modelica",
       {"//", "\"", true, false, false,
        with({"model", "LacunaModel", "input", "Real", "unit", "equation", "der", "end", "time",
              "delay", "if", "then", "else", "abs", "sign", "min", "max", "output", "parameter",
              "start", "fixed", "true"})}},
      {"spice",
       {"*", "", false, true, false,
        with({"subckt", "lacuna_model", "ends", "I", "v", "time", "ln", "sgn", "abs", "min",
              "max", "pow", "pwr", "V", "ic"})}},
      {"latex",
       {"%",
        "",
        false,
        false,
        true,
        {"\\begin", "\\end",          "align",    "\\dot",    "\\mathit", "\\quad", "\\left",
         "\\right", "\\frac",         "\\sqrt",   "\\cdot",   "\\ln",     "\\exp",  "\\sin",
         "\\cos",   "\\tan",          "\\arcsin", "\\arccos", "\\arctan", "\\tanh", "\\min",
         "\\max",   "\\operatorname", "sign",     "step",     "clip",     "t"}}}};
  for (const auto& [name, language] : languages)
    if (name == format) return language;
  return languages.front().second;
}

/// What is left without comments, blanks, empty lines and what is in strings: words and single
/// marks, line feeds among them.
inline std::vector<std::string> tokens_of(std::string_view text,
                                          const ForeignLanguage& language) {
  std::vector<std::string> tokens;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t i = 0; i < text.size();) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (text.substr(i).starts_with(language.comment) &&
        (begins_line || !language.comments_are_lines)) {
      i = std::min(text.find('\n', i), text.size());
    } else if (language.has_blocks && text.substr(i).starts_with("/*")) {
      i = std::min(text.find("*/", i), text.size() - 2) + 2;
    } else if (language.quotes.find(text[i]) != std::string_view::npos) {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
      tokens.emplace_back("string");
      i = end + 1;
    } else {
      std::size_t end = i + 1;
      if (language.has_commands && text[i] == '\\') {
        while (end < text.size() && std::isalpha(static_cast<unsigned char>(text[end]))) ++end;
      } else if (is_word(text[i])) {
        while (end < text.size() && is_word(text[end])) ++end;
      }
      const bool is_empty_line = text[i] == '\n' && (tokens.empty() || tokens.back() == "\n");
      if (text[i] != ' ' && !is_empty_line) tokens.emplace_back(text.substr(i, end - i));
      i = end;
    }
  }
  return tokens;
}

}  // namespace lacuna::fuzz
