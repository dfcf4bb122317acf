// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "repository/source_tree.hpp"

namespace lacuna::repository {

/// A word of a text, in small letters. Names are split at underscores and capitals.
struct Word {
  std::string text;
  std::size_t line = 0;     ///< from 0
  bool is_of_name = false;  ///< whether the name has others beside it
};

/// Words of lines, and signs other than quotes and slashes, one by one: a phrase goes on in the
/// next line of a comment or a text, and ends at other signs.
std::vector<Word> words_of(const std::vector<std::string>& lines);

/// "PHRASE -> WORD": a phrase that is not to be used, and the word instead.
struct WordRule {
  std::vector<std::vector<std::string>> phrase;  ///< alternatives for each place
  bool only_in_names = false;
  std::string text;
};

/// Rules of lines; empty ones and comments (`#`) are none.
std::vector<WordRule> word_rules(const std::vector<std::string>& lines);

/// Whether a phrase stands at a word.
bool matches(const WordRule& rule, const std::vector<Word>& words, std::size_t at);

/// "PATH | TEXT | REASON": a use that is meant, in files whose path begins like that, in lines
/// with that text.
struct WordException {
  std::string path, text, reason;
};

std::vector<WordException> word_exceptions(const std::vector<std::string>& lines);

/// The lines in which words are looked for: all of a source; of a page what is no code.
std::vector<std::string> readable_lines(const SourceFile& file);

}  // namespace lacuna::repository
