// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// What a language takes as the name of a variable.
struct NameRules {
  std::set<std::string, std::less<>> words =
      {};                                       ///< not to be used; all small where case_blind
  std::vector<std::string_view> prefixes = {};  ///< no name begins so
  bool case_blind = false;                      ///< x and X are one name
  bool underscores = false;                     ///< may begin with one and have two in a row
};

/// The words of a list with blanks between them.
std::set<std::string, std::less<>> words_of(std::string_view list);

/// What each name of a model is called over there.
using ForeignNames = std::map<std::string, std::string, std::less<>>;

/// A name over there for each name: its own where the language takes it and no name before it
/// is the same there, else one that is near: letters, digits and underscores, a letter first,
/// at most 63 characters, an underscore or a number behind it. No two are the same.
ForeignNames foreign_names(const std::vector<std::string>& names, const NameRules& rules);

}  // namespace lacuna
