// SPDX-License-Identifier: MIT
// "a.csv+b.csv": several files of one run.
#pragma once

#include <string>
#include <vector>

namespace lacuna {

/// The files whose names stand in a path with `+` between them; the path itself where it is the
/// name of one file. A name that holds a `+` and is there is that file. Each file may have a
/// sheet (`#`), and may be a pattern that matches one file.
/// @throws DataError where a pattern among them matches several files.
std::vector<std::string> joined_files(const std::string& path);

/// The files of paths, none of which is a pattern or joined any more (expand_patterns(),
/// joined_files()).
std::vector<std::string> single_files(const std::vector<std::string>& paths);

/// Files that match a shell-like pattern, in the order of their names; none where it is the name
/// of a file or no pattern.
std::vector<std::string> files_that_match(const std::string& pattern);

}  // namespace lacuna
