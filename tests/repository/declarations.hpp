// SPDX-License-Identifier: MIT
// What a C++ source declares: a reader for the rules of this folder. It knows as much of the
// language as they need: namespaces, classes, functions and members, not what is inside bodies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::repository {

/// A function as it stands in a source: declared, or with its body.
struct FunctionText {
  std::string owner;      ///< its class with the classes around it ("A::B"), or empty
  std::string name;       ///< without its class
  std::size_t first = 0;  ///< line where it begins, from 1
  std::size_t last = 0;   ///< line of its ";" or of the "}" of its body
  int parameters = 0;
  std::vector<std::string> types = {};  ///< of the parameters, as they are written
  bool has_body = false;
  bool is_public = true;     ///< not below "private:" or "protected:", nor is its class
  bool is_static = false;    ///< a member that needs no object
  bool is_template = false;  ///< or a member of a class template
  bool is_deleted = false;

  std::size_t lines() const { return last - first + 1; }
};

/// A member that is data and can change.
struct MemberText {
  std::string name;
  std::size_t line = 0;
};

/// A class, struct or union with its body.
struct ClassText {
  std::string name;  ///< with the classes around it: "A::B"
  std::size_t line = 0;
  bool is_public = true;                 ///< not below "private:" or "protected:"
  bool is_template = false;              ///< or in a class template
  std::vector<MemberText> members = {};  ///< those that are public
};

/// What a source declares, in its order.
struct Declarations {
  std::vector<FunctionText> functions;
  std::vector<ClassText> classes;
};

/// Reads a source that compiles. Local classes and lambdas belong to the function around them.
Declarations read_declarations(const std::vector<std::string>& lines);

/// The source as one text, with blanks in place of comments, literals and directives.
std::string code_of(const std::vector<std::string>& lines);

/// The place of the bracket that closes the one at `at`; kinds are not told apart.
/// @throws std::runtime_error where none does.
std::size_t closing(const std::string& text, std::size_t at);

}  // namespace lacuna::repository
