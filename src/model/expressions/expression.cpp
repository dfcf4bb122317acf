// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/expression.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "operations.hpp"

namespace lacuna {

struct Expression::Node {
  Operation operation = Operation::Number;
  double value = 0.0;
  std::string name = {};
  std::vector<Expression> operands = {};
  int depth = 0;
  std::size_t hash = 0;
};

namespace {

std::size_t mix(std::size_t seed, std::size_t value) {
  return seed ^ (value + 0x9e3779b97f4a7c15ULL + (seed << 6) + (seed >> 2));
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

std::size_t leaf_hash(Operation operation, double value, const std::string& name) {
  const std::size_t seed = mix(static_cast<std::size_t>(operation), bits(value));
  return mix(seed, std::hash<std::string>{}(name));
}

void check_name(const std::string& name) {
  if (!is_identifier(name))
    throw ModelError("variable '" + name + "'", "the name is not an identifier",
                     "use letters, digits and underscores, a letter first");
  if (name == "nan" || name == "inf")
    throw ModelError("variable '" + name + "'", "'" + name + "' is no finite number",
                     "write a number");
  if (is_reserved_name(name) && name != "t")
    throw ModelError("variable '" + name + "'", "the name is a word of the formula language",
                     "choose another name");
}

void check_operand_count(Operation operation, std::size_t count) {
  const auto expected = static_cast<std::size_t>(arity(operation));
  if (expected > 0 && count == expected) return;
  if (expected == 0)
    throw ModelError("expression", "a leaf is not made from operands",
                     "use number(), variable() or delayed()");
  throw ModelError("expression",
                   "an operation on " + std::to_string(expected) + " operands was given " +
                       std::to_string(count),
                   "give as many operands as the operation has");
}

void check_depth(int depth) {
  if (depth <= kMaxExpressionDepth) return;
  throw ModelError("expression",
                   "more than " + std::to_string(kMaxExpressionDepth) + " operations deep",
                   "split the formula into several terms");
}

void collect_names(const Expression& expression, std::set<std::string>& names) {
  const Operation operation = expression.operation();
  if (operation == Operation::Variable || operation == Operation::Delay)
    names.insert(expression.name());
  for (const Expression& operand : expression.operands()) collect_names(operand, names);
}

}  // namespace

Expression::Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

Expression::Expression() : Expression(number(0.0)) {}

Expression::Expression(double value) : Expression(number(value)) {}

Expression Expression::number(double value) {
  if (!std::isfinite(value))
    throw ModelError("expression", "the number " + format_number(value) + " is not finite",
                     "use finite numbers");
  Node node{.operation = Operation::Number, .value = value};
  node.hash = leaf_hash(node.operation, value, node.name);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::variable(std::string name) {
  check_name(name);
  Node node{.operation = Operation::Variable, .name = std::move(name)};
  node.hash = leaf_hash(node.operation, 0.0, node.name);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::delayed(std::string name, double delay) {
  check_name(name);
  if (!(delay >= 0.0) || !std::isfinite(delay))
    throw ModelError("delay(" + name + "," + format_number(delay) + ")",
                     "the delay is not a finite number >= 0", "give a time in the past");
  if (delay == 0.0) return variable(std::move(name));
  if (name == "t") return variable(std::move(name)) - number(delay);
  Node node{.operation = Operation::Delay, .value = delay, .name = std::move(name)};
  node.hash = leaf_hash(node.operation, delay, node.name);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::delayed(std::string name, const Expression& delay) {
  if (const std::optional<double> value = constant_value(delay))
    return delayed(std::move(name), *value);
  check_name(name);
  if (name == "t") return variable(std::move(name)) - delay;
  Node node{.operation = Operation::Delay, .name = std::move(name), .operands = {delay}};
  node.hash = mix(leaf_hash(node.operation, 0.0, node.name), delay.hash());
  node.depth = delay.depth() + 1;
  check_depth(node.depth);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::make(Operation operation, std::vector<Expression> operands) {
  check_operand_count(operation, operands.size());
  if (operation == Operation::Negate && operands[0].operation() == Operation::Number)
    return number(-operands[0].value());
  Node node{.operation = operation, .operands = std::move(operands)};
  node.hash = static_cast<std::size_t>(operation);
  for (const Expression& operand : node.operands) {
    node.hash = mix(node.hash, operand.hash());
    node.depth = std::max(node.depth, operand.depth() + 1);
  }
  check_depth(node.depth);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Operation Expression::operation() const noexcept { return node_->operation; }

double Expression::value() const noexcept { return node_->value; }

const std::string& Expression::name() const noexcept { return node_->name; }

std::span<const Expression> Expression::operands() const noexcept { return node_->operands; }

int Expression::depth() const noexcept { return node_->depth; }

std::size_t Expression::hash() const noexcept { return node_->hash; }

std::set<std::string> Expression::variables() const {
  std::set<std::string> names;
  collect_names(*this, names);
  return names;
}

bool operator==(const Expression& a, const Expression& b) {
  if (a.node_ == b.node_) return true;
  const Expression::Node& p = *a.node_;
  const Expression::Node& q = *b.node_;
  return p.hash == q.hash && p.operation == q.operation && bits(p.value) == bits(q.value) &&
         p.name == q.name && p.operands == q.operands;
}

Expression operator+(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Add, {a, b});
}

Expression operator-(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Subtract, {a, b});
}

Expression operator*(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Multiply, {a, b});
}

Expression operator/(const Expression& a, const Expression& b) {
  return Expression::make(Operation::Divide, {a, b});
}

Expression operator-(const Expression& a) { return Expression::make(Operation::Negate, {a}); }

}  // namespace lacuna
