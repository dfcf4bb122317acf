// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace lacuna::cli {

/// Questions to a person, each with the answer that is taken where none is given.
class Questions {
 public:
  /// @param out where they are shown. @param answers a line each; nothing: all are answered by
  /// what they propose. Both outlive the object.
  Questions(std::ostream& out, std::istream* answers);

  /// "question [proposed]: " @return the line without spaces at its ends; `proposed` for an empty
  /// line and behind the last one.
  std::string ask(const std::string& question, const std::string& proposed);

  /// The same until the answer is one of the choices, or begins just one of them.
  std::string choose(const std::string& question, const std::vector<std::string>& choices,
                     const std::string& proposed);

  /// A line between two questions, set in by two spaces.
  void remark(const std::string& text);

 private:
  std::ostream& out_;
  std::istream* answers_;
};

}  // namespace lacuna::cli
