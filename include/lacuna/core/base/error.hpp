// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace lacuna {

/// What a user can mend: says where it went wrong, what is wrong and what to do about it.
///
/// `what()` is one line: "where: problem; remedy", parts that are empty are left out.
/// Outcomes that the numbers decide (no convergence, no model) are values in results,
/// never exceptions.
class Error : public std::runtime_error {
 public:
  Error(std::string where, std::string problem, std::string remedy);  ///< parts may be empty

  /// The place: "record.csv:12:3", "$.regressor.threshold", "term 'x*q', column 3".
  const std::string& where() const noexcept { return where_; }

  /// What is wrong there.
  const std::string& problem() const noexcept { return problem_; }

  /// What to do about it.
  const std::string& remedy() const noexcept { return remedy_; }

 private:
  std::string where_;
  std::string problem_;
  std::string remedy_;
};

/// Data that cannot be used: common causes are a ragged line, text in a column, time that goes
/// backwards, too few rows, a constant column.
class DataError : public Error {
 public:
  using Error::Error;
};

/// An option or a configuration that cannot be used: an unknown name, a value out of range.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// An expression or a model that cannot be used: an unknown variable, unbalanced parentheses.
class ModelError : public Error {
 public:
  using Error::Error;
};

/// A call with arguments that do not fit together: wrong shapes, an index out of range.
class ArgumentError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read or written.
class FileError : public Error {
 public:
  using Error::Error;
};

/// Thrown inside the library when the run context's stop token asks for an end.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// Thrown inside the library when the run context's deadline has passed. Whoever has an answer
/// by then catches it and notes what is missing; to all others it is an end like any.
class OutOfTime : public Cancelled {
 public:
  const char* what() const noexcept override { return "out of time"; }
};

}  // namespace lacuna
