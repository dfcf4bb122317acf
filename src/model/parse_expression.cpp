// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "formula_error.hpp"
#include "lacuna/core/names.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/model/expression.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) { return is_identifier(std::string_view(&c, 1)); }

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Recursive descent:
///   sum     = product { ("+" | "-") product }
///   product = signed { ("*" | "/") signed }
///   signed  = ("+" | "-") signed | power
///   power   = primary [ "^" signed ]
///   primary = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
class Parser {
 public:
  Parser(std::string_view text, std::span<const std::string> known)
      : text_(text), known_(known) {}

  Expression whole() {
    skip_blanks();
    if (at_end()) fail(position_, "the formula is empty", "write 1 for the constant term");
    Expression result = sum();
    if (!at_end()) fail_unexpected();
    return result;
  }

 private:
  [[noreturn]] void fail(std::size_t position, const std::string& problem,
                         const std::string& remedy) const {
    throw FormulaError(text_, position + 1, problem, remedy);
  }

  [[noreturn]] void fail_unexpected() const {
    if (at_end()) fail(position_, "the formula ends too early", "complete it");
    const char c = text_[position_];
    if (c == ')') fail(position_, "')' without '('", "balance the parentheses");
    if (c == '*') fail(position_, "'*' where a value should stand", "powers are written x^2");
    if (is_letter(c) || is_digit(c) || c == '(')
      fail(position_, "an operator is missing before '" + std::string(1, c) + "'",
           "write '*' for a product");
    fail(position_, "unexpected " + character_text(c),
         "see the formula language for what may stand there");
  }

  static std::string character_text(char c) {
    if (c > ' ' && c < '\x7f') return std::string("'") + c + "'";
    char code[16];
    std::snprintf(code, sizeof code, "byte 0x%02x",
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    return code;
  }

  bool at_end() const { return position_ >= text_.size(); }

  void skip_blanks() {
    while (!at_end() && is_blank(text_[position_])) ++position_;
  }

  /// Steps over the character, when it is the next one.
  bool take(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    skip_blanks();
    return true;
  }

  Expression make(Operation operation, std::vector<Expression> operands, std::size_t position) {
    Expression made = Expression::make(operation, std::move(operands));
    check_depth(made, position);
    return made;
  }

  void check_depth(const Expression& made, std::size_t position) const {
    if (made.depth() > kMaxFormulaDepth)
      fail(position, "more than " + std::to_string(kMaxFormulaDepth) + " operations deep",
           "split the formula into several terms");
  }

  Expression sum() {
    Expression left = product();
    for (;;) {
      const std::size_t position = position_;
      if (take('+'))
        left = make(Operation::Add, {left, product()}, position);
      else if (take('-'))
        left = make(Operation::Subtract, {left, product()}, position);
      else
        return left;
    }
  }

  Expression product() {
    Expression left = signed_factor();
    for (;;) {
      const std::size_t position = position_;
      if (take('*'))
        left = make(Operation::Multiply, {left, signed_factor()}, position);
      else if (take('/'))
        left = make(Operation::Divide, {left, signed_factor()}, position);
      else
        return left;
    }
  }

  /// All recursion passes here, so here its depth is bounded.
  Expression signed_factor() {
    const std::size_t position = position_;
    if (++nesting_ > kMaxFormulaNesting)
      fail(position, "nested deeper than " + std::to_string(kMaxFormulaNesting) + " levels",
           "split the formula into several terms");
    Expression result = take('-')   ? make(Operation::Negate, {signed_factor()}, position)
                        : take('+') ? signed_factor()
                                    : power();
    --nesting_;
    return result;
  }

  Expression power() {
    Expression base = primary();
    const std::size_t position = position_;
    if (!take('^')) return base;
    return make(Operation::Power, {std::move(base), signed_factor()}, position);
  }

  Expression primary() {
    if (at_end()) fail_unexpected();
    const char c = text_[position_];
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return named();
    const std::size_t opening = position_;
    if (!take('(')) fail_unexpected();
    Expression inside = sum();
    close(opening);
    return inside;
  }

  void close(std::size_t opening) {
    if (take(')')) return;
    if (at_end()) fail(opening, "'(' without ')'", "balance the parentheses");
    fail_unexpected();
  }

  Expression number() {
    double value = 0.0;
    const char* begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range)
      fail(position_, "the number is out of the range of a double", "use a smaller exponent");
    if (error != std::errc{}) fail_unexpected();
    position_ += static_cast<std::size_t>(end - begin);
    skip_blanks();
    return Expression::number(value);
  }

  std::string identifier() {
    const std::size_t begin = position_;
    while (!at_end() && (is_letter(text_[position_]) || is_digit(text_[position_])))
      ++position_;
    std::string name(text_.substr(begin, position_ - begin));
    skip_blanks();
    return name;
  }

  Expression named() {
    const std::size_t position = position_;
    std::string name = identifier();
    if (!at_end() && text_[position_] == '(') return call(name, position);
    if (name == "pi") return Expression::number(std::numbers::pi);
    if (function_named(name))
      fail(position, "the function '" + name + "' has no arguments", "write " + name + "(...)");
    if (!is_known(name))
      fail(position, "unknown name '" + name + "'", suggestion(name, known_));
    return Expression::variable(std::move(name));
  }

  bool is_known(const std::string& name) const {
    if (known_.empty()) return true;
    for (const std::string& candidate : known_)
      if (candidate == name) return true;
    return false;
  }

  Expression call(const std::string& name, std::size_t position) {
    const std::optional<Operation> operation = function_named(name);
    if (!operation) fail_no_function(name, position);
    std::vector<std::size_t> starts;
    std::vector<Expression> arguments = argument_list(starts);
    const std::size_t expected =
        *operation == Operation::Delay ? 2 : static_cast<std::size_t>(arity(*operation));
    if (arguments.size() != expected)
      fail(position,
           "'" + name + "' has " + std::to_string(arguments.size()) + " arguments, not " +
               std::to_string(expected),
           "give " + std::to_string(expected));
    if (*operation != Operation::Delay) return make(*operation, std::move(arguments), position);
    return delay(arguments[0], arguments[1], starts[1]);
  }

  [[noreturn]] void fail_no_function(const std::string& name, std::size_t position) const {
    if (name == "pi" || (!known_.empty() && is_known(name)))
      fail(position, "'" + name + "' is not a function",
           "write " + name + "*(...) for a product, delay(" + name + ",T) for the past");
    fail(position, "unknown function '" + name + "'", suggestion(name, function_names()));
  }

  std::vector<Expression> argument_list(std::vector<std::size_t>& starts) {
    const std::size_t opening = position_;
    take('(');
    std::vector<Expression> arguments;
    if (take(')')) return arguments;
    do {
      starts.push_back(position_);
      arguments.push_back(sum());
    } while (take(','));
    close(opening);
    return arguments;
  }

  Expression delay(const Expression& formula, const Expression& time, std::size_t position) {
    const std::optional<double> value = constant_value(time);
    if (!value && !known_.empty())
      fail(position, "the delay is not a constant", "give a number");
    if (value && (!std::isfinite(*value) || *value < 0.0))
      fail(position, "the delay " + format_number(*value) + " is not a finite number >= 0",
           "give a time in the past as a positive number");
    Expression result = lacuna::delay(formula, value ? Expression::number(*value) : time);
    check_depth(result, position);
    return result;
  }

  std::string_view text_;
  std::span<const std::string> known_;
  std::size_t position_ = 0;
  int nesting_ = 0;
};

}  // namespace

Expression parse_expression(std::string_view text, std::span<const std::string> known) {
  return Parser(text, known).whole();
}

}  // namespace lacuna
