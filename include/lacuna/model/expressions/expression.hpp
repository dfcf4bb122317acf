// SPDX-License-Identifier: MIT
// Expressions and the functions in them.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// Kinds of nodes an expression is made of.
enum class Operation {
  Number,    ///< a constant
  Variable,  ///< a state, an input or t
  Delay,     ///< a variable as it was some time ago: delay(x,T)
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,
  Negate,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Tanh,
  Exp,
  Log,
  Sqrt,
  Abs,
  Sign,
  Step,  ///< 0 for x < 0, 1 from 0 on
  Min,
  Max,
  Clip,  ///< clip(x,lo,hi)
};

/// Deepest formula the parser takes, in operations from the whole to a leaf.
inline constexpr int kMaxFormulaDepth = 400;

/// Deepest parentheses, signs and powers of powers the parser takes.
inline constexpr int kMaxFormulaNesting = 200;

/// Deepest expression that can be made at all; leaves room for derivatives of any formula.
inline constexpr int kMaxExpressionDepth = 2400;

/// A formula in named variables: an immutable value, cheap to copy.
///
/// The language: numbers, `pi`, `+ - * / ^` (`^` binds tightest and to the right, then the
/// sign), parentheses, `sin cos tan asin acos atan tanh exp log sqrt abs sign min max step(x)`
/// `clip(x,lo,hi)`, `delay(x,T)` with T >= 0. A delay of a formula is stored as the formula of
/// its delayed variables, so that only variables are ever delayed. T may be a formula of
/// parameters that have no number yet; it is bound by substitute() before anything is computed.
///
/// What was written is kept: nothing is reordered; only a sign in front of a number is folded,
/// a delay of 0 is the variable itself, and time delayed by T is t-T.
/// `parse(to_string(e)) == e` holds for every expression that is not nested deeper than the
/// parser allows (kMaxFormulaDepth).
class Expression {
 public:
  /// The constant 0.
  Expression();

  /// A constant, so that 2 * x is a formula. @throws ModelError when it is not finite.
  Expression(double value);  // NOLINT(google-explicit-constructor): a number is a formula

  /// A constant. @throws ModelError when it is not finite.
  static Expression number(double value);

  /// A variable. @throws ModelError when the name is not an identifier or is a reserved word.
  static Expression variable(std::string name);

  /// Any operation on its operands, folded only where the class comment says so.
  /// @throws ModelError when the number of operands does not fit the operation, or when the
  ///   expression gets deeper than kMaxExpressionDepth.
  static Expression make(Operation operation, std::vector<Expression> operands);

  /// A variable as it was `delay` time units ago.
  /// @throws ModelError for a delay that is negative or not finite, and as variable() does.
  static Expression delayed(std::string name, double delay);

  /// The same with a delay that may be a formula of parameters, whose names are variables() of
  /// the whole until they are bound.
  static Expression delayed(std::string name, const Expression& delay);

  Operation operation() const noexcept;      ///< of the outermost node
  double value() const noexcept;             ///< of a Number; the time of a bound Delay
  const std::string& name() const noexcept;  ///< of a Variable or a Delay

  /// Of an operation, one for each of its arguments; the time of a Delay that is not bound to a
  /// number is its only operand.
  std::span<const Expression> operands() const noexcept;

  /// Names of all variables, delayed ones too.
  std::set<std::string> variables() const;

  /// Operations on the longest way from the whole to a leaf; 0 for a leaf.
  int depth() const noexcept;

  /// Equal expressions have equal hashes.
  std::size_t hash() const noexcept;

  /// Canonical text: no blanks, shortest numbers, parentheses only where they are needed and
  /// around a signed operand behind + - * /: "x^2*y", "sin(th)", "-x*y", "2*x^-1", "x*(-y)".
  std::string to_string() const;

  /// Same structure, same names, same numbers (to the bit: 0 and -0 differ).
  friend bool operator==(const Expression& a, const Expression& b);

 private:
  struct Node;
  explicit Expression(std::shared_ptr<const Node> node);
  std::shared_ptr<const Node> node_;
};

/// Reads a formula.
/// @param known when not empty, the only names that may stand for variables; delays have to be
///   constant then, as there are no parameters.
/// @throws ModelError naming the column (from 1): an unknown name or function, wrong number of
///   arguments, unbalanced parentheses, a number out of range, too deep a nesting.
Expression parse_expression(std::string_view text, std::span<const std::string> known = {});

/// Reads a formula as the summands of its outermost sum, of which there may be any number: of
/// "x - 2*y" they are x and -(2*y). @throws ModelError as parse_expression().
std::vector<Expression> parse_summands(std::string_view text,
                                       std::span<const std::string> known = {});

/// The exact partial derivative, with plain simplifications (0*x, 1*x, x+0, constant folding).
/// d|x|/dx = sign(x); the derivative of sign and step is 0 (it exists almost everywhere);
/// min, max and clip select a branch with step. A delayed variable counts as another variable.
/// @throws ModelError for a parameter on which a delay depends: that takes the rate of the
/// past.
Expression differentiate(const Expression& expression, std::string_view variable);

/// The formula with expressions in place of variables, all at once: what is put in is not
/// looked at again. A delayed variable becomes the delayed expression, a delay whose time
/// becomes a number is bound.
/// @throws ModelError for a delay that becomes negative, and as Expression::make().
Expression substitute(const Expression& expression,
                      const std::map<std::string, Expression>& replacements);

/// The formula as it was `time` ago: every variable in it delayed.
/// @throws ModelError as Expression::delayed().
Expression delay(const Expression& expression, const Expression& time);

/// Whether an operation stands anywhere in a formula.
bool contains(const Expression& expression, Operation operation);

/// Whether an expression is a number.
inline bool is_number(const Expression& e) { return e.operation() == Operation::Number; }
/// Whether an expression is that number.
inline bool is_number(const Expression& e, double value) {
  return is_number(e) && e.value() == value;
}

/// The operations, without any simplification: `a + b` is make(Operation::Add, {a, b}).
Expression operator+(const Expression& a, const Expression& b);
Expression operator-(const Expression& a, const Expression& b);
Expression operator*(const Expression& a, const Expression& b);
Expression operator/(const Expression& a, const Expression& b);
Expression operator-(const Expression& a);

/// Sine of an angle in rad.
Expression sin(const Expression& x);

/// Cosine of an angle in rad.
Expression cos(const Expression& x);

/// Tangent of an angle in rad.
Expression tan(const Expression& x);

/// Inverse sine, rad.
Expression asin(const Expression& x);

/// Inverse cosine, rad.
Expression acos(const Expression& x);

/// Inverse tangent, rad.
Expression atan(const Expression& x);

/// Hyperbolic tangent.
Expression tanh(const Expression& x);

/// Exponential function.
Expression exp(const Expression& x);

/// Natural logarithm.
Expression log(const Expression& x);

/// Square root.
Expression sqrt(const Expression& x);

/// Absolute value |x|.
Expression abs(const Expression& x);

/// -1, 0 or 1.
Expression sign(const Expression& x);

/// 0 for x < 0, 1 from 0 on.
Expression step(const Expression& x);

/// base^exponent.
Expression pow(const Expression& base, const Expression& exponent);

/// The smaller of two.
Expression min(const Expression& a, const Expression& b);

/// The larger of two.
Expression max(const Expression& a, const Expression& b);

/// x, but no less than `low` and no more than `high`.
Expression clip(const Expression& x, const Expression& low, const Expression& high);

}  // namespace lacuna
