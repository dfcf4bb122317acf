// SPDX-License-Identifier: MIT
// What pages call by a name, and whether the code has it.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace lacuna::repository {

/// What the tree has names for.
struct NamesOfTree {
  std::set<std::string> words;  ///< of sources outside comments, and stems of files
  std::set<std::string> paths;  ///< files, folders and sources without extension, from the root
  std::set<std::string> files;  ///< names of files
  std::vector<std::string> lines;  ///< of sources, without comments
};

/// The names of this source tree, without those that are made up in tests of this reader.
NamesOfTree names_of_tree();

/// A line of a source without its comment, which begins with the mark outside of quotes.
std::string without_comment(const std::string& line, const std::string& mark);

/// Names in a span of code on a page: a path, a file, or options and identifiers. Words of
/// plain language and names of single letters are none.
std::vector<std::string> names_in(const std::string& span);

/// Whether the tree has a name that a page of a folder mentions: a path from the root, from
/// that folder or from where sources lie, a file of that name, a word of the code, or a text of
/// it that only looks like a path ("lacuna.fit/1", "rad/s").
bool is_known(const NamesOfTree& tree, const std::string& name, const std::string& folder);

}  // namespace lacuna::repository
