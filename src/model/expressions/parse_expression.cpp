// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "formula_error.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) { return is_identifier(std::string_view(&c, 1)); }

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string character_text(char c) {
  if (c > ' ' && c < '\x7f') return std::string("'") + c + "'";
  char code[16];
  std::snprintf(code, sizeof code, "byte 0x%02x",
                static_cast<unsigned>(static_cast<unsigned char>(c)));
  return code;
}

/// A formula, the names it may use and the place up to which it has been read.
class Cursor {
 public:
  Cursor(std::string_view text, std::span<const std::string> known)
      : text_(text), known_(known) {
    skip_blanks();
  }

  std::size_t position() const { return position_; }
  bool at_end() const { return position_ >= text_.size(); }
  char next() const { return text_[position_]; }  ///< @pre not at_end()
  bool is_next(char c) const { return !at_end() && next() == c; }

  /// Steps over the character, when it is the next one, and blanks behind it.
  bool take(char c) {
    if (!is_next(c)) return false;
    step_over(1);
    return true;
  }

  std::string_view rest() const { return text_.substr(position_); }

  /// Steps over characters and blanks behind them.
  void step_over(std::size_t characters) {
    position_ += characters;
    skip_blanks();
  }

  /// Names that the formula may use; none: any.
  std::span<const std::string> known() const { return known_; }

  /// Bounds how deep what is read is nested.
  void enter() {
    if (++nesting_ > kMaxFormulaNesting)
      fail(position_, "nested deeper than " + std::to_string(kMaxFormulaNesting) + " levels",
           "split the formula into several terms");
  }
  void leave() { --nesting_; }

  [[noreturn]] void fail(std::size_t position, const std::string& problem,
                         const std::string& remedy) const {
    throw FormulaError(text_, position + 1, problem, remedy);
  }

 private:
  void skip_blanks() {
    while (!at_end() && is_blank(next())) ++position_;
  }

  const std::string_view text_;
  const std::span<const std::string> known_;
  std::size_t position_ = 0;
  int nesting_ = 0;
};

[[noreturn]] void fail_unexpected(const Cursor& at) {
  const std::size_t position = at.position();
  if (at.at_end()) at.fail(position, "the formula ends too early", "complete it");
  const char c = at.next();
  if (c == ')') at.fail(position, "')' without '('", "balance the parentheses");
  if (c == '*') at.fail(position, "'*' where a value should stand", "powers are written x^2");
  if (is_letter(c) || is_digit(c) || c == '(')
    at.fail(position, "an operator is missing before '" + std::string(1, c) + "'",
            "write '*' for a product");
  at.fail(position, "unexpected " + character_text(c),
          "see the formula language for what may stand there");
}

void check_depth(const Cursor& at, const Expression& made, std::size_t position) {
  if (made.depth() > kMaxFormulaDepth)
    at.fail(position, "more than " + std::to_string(kMaxFormulaDepth) + " operations deep",
            "split the formula into several terms");
}

/// @param position of the operation, for errors.
Expression make(const Cursor& at, Operation operation, std::vector<Expression> operands,
                std::size_t position) {
  Expression made = Expression::make(operation, std::move(operands));
  check_depth(at, made, position);
  return made;
}

// Recursive descent, a function for each line; each leaves the cursor behind what it has read:
//   sum     = product { ("+" | "-") product }
//   product = signed { ("*" | "/") signed }
//   signed  = ("+" | "-") signed | power
//   power   = primary [ "^" signed ]
//   primary = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
Expression sum(Cursor& at);
Expression power(Cursor& at);
Expression primary(Cursor& at);

/// All recursion passes here, so here its depth is bounded.
Expression signed_factor(Cursor& at) {
  const std::size_t position = at.position();
  at.enter();
  Expression result = at.take('-') ? make(at, Operation::Negate, {signed_factor(at)}, position)
                      : at.take('+') ? signed_factor(at)
                                     : power(at);
  at.leave();
  return result;
}

Expression power(Cursor& at) {
  Expression base = primary(at);
  const std::size_t position = at.position();
  if (!at.take('^')) return base;
  return make(at, Operation::Power, {std::move(base), signed_factor(at)}, position);
}

Expression product(Cursor& at) {
  Expression left = signed_factor(at);
  for (;;) {
    const std::size_t position = at.position();
    if (at.take('*'))
      left = make(at, Operation::Multiply, {left, signed_factor(at)}, position);
    else if (at.take('/'))
      left = make(at, Operation::Divide, {left, signed_factor(at)}, position);
    else
      return left;
  }
}

Expression sum(Cursor& at) {
  Expression left = product(at);
  for (;;) {
    const std::size_t position = at.position();
    if (at.take('+'))
      left = make(at, Operation::Add, {left, product(at)}, position);
    else if (at.take('-'))
      left = make(at, Operation::Subtract, {left, product(at)}, position);
    else
      return left;
  }
}

Expression number(Cursor& at) {
  double value = 0.0;
  const std::string_view text = at.rest();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    at.fail(at.position(), "the number is out of the range of a double",
            "use a smaller exponent");
  if (error != std::errc{}) fail_unexpected(at);
  at.step_over(static_cast<std::size_t>(end - text.data()));
  return Expression::number(value);
}

std::string identifier(Cursor& at) {
  const std::string_view text = at.rest();
  std::size_t length = 0;
  while (length < text.size() && (is_letter(text[length]) || is_digit(text[length]))) ++length;
  at.step_over(length);
  return std::string(text.substr(0, length));
}

void close(Cursor& at, std::size_t opening) {
  if (at.take(')')) return;
  if (at.at_end()) at.fail(opening, "'(' without ')'", "balance the parentheses");
  fail_unexpected(at);
}

bool is_known(const std::string& name, std::span<const std::string> known) {
  return known.empty() || std::find(known.begin(), known.end(), name) != known.end();
}

[[noreturn]] void fail_no_function(const Cursor& at, const std::string& name,
                                   std::size_t position) {
  if (name == "pi" || (!at.known().empty() && is_known(name, at.known())))
    at.fail(position, "'" + name + "' is not a function",
            "write " + name + "*(...) for a product, delay(" + name + ",T) for the past");
  at.fail(position, "unknown function '" + name + "'", suggestion(name, function_names()));
}

/// An argument of a function and where it begins.
struct Argument {
  Expression value;
  std::size_t position;
};

std::vector<Argument> argument_list(Cursor& at) {
  const std::size_t opening = at.position();
  at.take('(');
  std::vector<Argument> arguments;
  if (at.take(')')) return arguments;
  do {
    const std::size_t position = at.position();
    arguments.push_back({sum(at), position});
  } while (at.take(','));
  close(at, opening);
  return arguments;
}

Expression delayed(const Cursor& at, const Expression& formula, const Argument& time) {
  const std::optional<double> value = constant_value(time.value);
  if (!value && !at.known().empty())
    at.fail(time.position, "the delay is not a constant", "give a number");
  if (value && (!std::isfinite(*value) || *value < 0.0))
    at.fail(time.position,
            "the delay " + format_number(*value) + " is not a finite number >= 0",
            "give a time in the past as a positive number");
  Expression result = delay(formula, value ? Expression::number(*value) : time.value);
  check_depth(at, result, time.position);
  return result;
}

Expression call(Cursor& at, const std::string& name, std::size_t position) {
  const std::optional<Operation> operation = function_named(name);
  if (!operation) fail_no_function(at, name, position);
  const std::vector<Argument> arguments = argument_list(at);
  const std::size_t expected =
      *operation == Operation::Delay ? 2 : static_cast<std::size_t>(arity(*operation));
  if (arguments.size() != expected)
    at.fail(position,
            "'" + name + "' has " + std::to_string(arguments.size()) + " arguments, not " +
                std::to_string(expected),
            "give " + std::to_string(expected));
  if (*operation == Operation::Delay) return delayed(at, arguments[0].value, arguments[1]);
  std::vector<Expression> operands;
  for (const Argument& argument : arguments) operands.push_back(argument.value);
  return make(at, *operation, std::move(operands), position);
}

Expression named(Cursor& at) {
  const std::size_t position = at.position();
  std::string name = identifier(at);
  if (at.is_next('(')) return call(at, name, position);
  if (name == "pi") return Expression::number(std::numbers::pi);
  if (function_named(name))
    at.fail(position, "the function '" + name + "' has no arguments",
            "write " + name + "(...)");
  if (!is_known(name, at.known()))
    at.fail(position, "unknown name '" + name + "'", suggestion(name, at.known()));
  return Expression::variable(std::move(name));
}

Expression primary(Cursor& at) {
  if (at.at_end()) fail_unexpected(at);
  const char c = at.next();
  if (is_digit(c) || c == '.') return number(at);
  if (is_letter(c)) return named(at);
  const std::size_t opening = at.position();
  if (!at.take('(')) fail_unexpected(at);
  Expression inside = sum(at);
  close(at, opening);
  return inside;
}

Cursor begin_of(std::string_view text, std::span<const std::string> known) {
  Cursor at(text, known);
  if (at.at_end())
    at.fail(at.position(), "the formula is empty", "write 1 for the constant term");
  return at;
}

}  // namespace

Expression parse_expression(std::string_view text, std::span<const std::string> known) {
  Cursor at = begin_of(text, known);
  Expression result = sum(at);
  if (!at.at_end()) fail_unexpected(at);
  return result;
}

std::vector<Expression> parse_summands(std::string_view text,
                                       std::span<const std::string> known) {
  Cursor at = begin_of(text, known);
  std::vector<Expression> summands{product(at)};
  while (!at.at_end()) {
    const std::size_t position = at.position();
    if (at.take('+'))
      summands.push_back(product(at));
    else if (at.take('-'))
      summands.push_back(make(at, Operation::Negate, {product(at)}, position));
    else
      fail_unexpected(at);
  }
  return summands;
}

}  // namespace lacuna
