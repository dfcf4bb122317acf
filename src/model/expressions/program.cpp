// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/program.hpp"

#include <algorithm>
#include <string>

#include "core/base/check.hpp"
#include "core/numerics/column_kernels.hpp"
#include "lacuna/core/base/error.hpp"
#include "operations.hpp"
#include "program_builder.hpp"

namespace lacuna {
namespace {

/// Runs equal instructions on single values.
template <class Instruction>
struct ScalarRun {
  std::span<const Instruction> instructions;
  double* r;

  template <class F>
  void unary(F f) const {
    for (const Instruction& i : instructions) r[i.target] = f(r[i.a]);
  }
  template <class F>
  void binary(F f) const {
    for (const Instruction& i : instructions) r[i.target] = f(r[i.a], r[i.b]);
  }
  template <class F>
  void ternary(F f) const {
    for (const Instruction& i : instructions) r[i.target] = f(r[i.a], r[i.b], r[i.c]);
  }
};

/// Registers wherever they are.
struct PlacedRegisters {
  const double* const* sources;
  double* const* targets;

  const double* source(int place) const { return sources[place]; }
  double* target(int place) const { return targets[place]; }
};

/// Registers one behind the other.
struct StackedRegisters {
  double* first;
  Index rows;

  const double* source(int place) const { return first + place * rows; }
  double* target(int place) const { return first + place * rows; }
};

/// Runs equal instructions on blocks of rows; the inner loops are what the compiler vectorises.
template <class Instruction, class Registers>
struct BlockRun {
  std::span<const Instruction> instructions;
  Registers registers;
  Index rows;

  template <class F>
  void unary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = registers.source(i.a);
      double* __restrict out = registers.target(i.target);
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row]);
    }
  }
  template <class F>
  void binary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = registers.source(i.a);
      const double* b = registers.source(i.b);
      double* __restrict out = registers.target(i.target);
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row], b[row]);
    }
  }
  /// What most of a library is made of.
  void products() const {
    for (const Instruction& i : instructions)
      multiply(registers.source(i.a), registers.source(i.b), rows, registers.target(i.target));
  }
  template <class F>
  void ternary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = registers.source(i.a);
      const double* b = registers.source(i.b);
      const double* c = registers.source(i.c);
      double* __restrict out = registers.target(i.target);
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row], b[row], c[row]);
    }
  }
};

template <class Instruction, class Registers>
void run_equal(Operation operation, const BlockRun<Instruction, Registers>& block) {
  if (operation == Operation::Multiply)
    block.products();
  else
    with_function(operation, block);
}

void check_shapes(const Program& program, const Eigen::Ref<const Matrix>& slots,
                  const Eigen::Ref<Matrix>& out) {
  if (slots.cols() == program.slots() && out.cols() == program.outputs() &&
      slots.rows() == out.rows())
    return;
  const auto shape = [](Index rows, Index cols) {
    return std::to_string(rows) + " x " + std::to_string(cols);
  };
  throw ArgumentError("Program::evaluate",
                      "slots are " + shape(slots.rows(), slots.cols()) + ", outputs are " +
                          shape(out.rows(), out.cols()),
                      "give rows x " + std::to_string(program.slots()) + " and rows x " +
                          std::to_string(program.outputs()));
}

}  // namespace

std::vector<std::string> Variables::names() const {
  std::vector<std::string> names = states;
  names.insert(names.end(), inputs.begin(), inputs.end());
  names.emplace_back("t");
  return names;
}

VariableIndex::VariableIndex(const Variables& variables)
    : names_(variables.names()), states_(static_cast<Index>(variables.states.size())) {
  slots_.reserve(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i)
    slots_.emplace(names_[i], static_cast<Index>(i));
}

std::optional<Index> VariableIndex::find(const std::string& name) const {
  const auto found = slots_.find(name);
  if (found == slots_.end()) return std::nullopt;
  return found->second;
}

Program::Program(std::span<const Expression> outputs, const Variables& variables) {
  ProgramBuilder::build(*this, outputs, variables);
}

void Program::evaluate(const double* slots, double* out, Workspace& workspace) const {
  if (workspace.registers.size() < register_count_) workspace.registers.resize(register_count_);
  double* r = workspace.registers.data();
  std::copy_n(slots, slot_count_, r);
  std::copy(constants_.begin(), constants_.end(), r + slot_count_);
  const std::span<const Instruction> all(instructions_);
  for (const Run& run : runs_)
    with_function(run.operation,
                  ScalarRun<Instruction>{all.subspan(run.begin, run.end - run.begin), r});
  for (const int source : outputs_) *out++ = r[source];
}

void Program::evaluate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> out,
                       Workspace& workspace) const {
  check_shapes(*this, slots, out);
  const Index rows = slots.rows();
  prepare(workspace, std::min(rows, kBlockRows));
  for (Index first = 0; first < rows; first += kBlockRows)
    evaluate_block(slots, out, first, std::min(kBlockRows, rows - first), workspace);
}

Program::Block::Block(const Program& program, Index rows) : rows_(rows) {
  check_argument(rows >= 0 && rows <= kBlockRows, "Program::Block",
                 "there are less than 0 points or more than a block has");
  registers_.resize(program.register_count_ * static_cast<std::size_t>(rows));
  int place = static_cast<int>(program.slot_count_);
  for (const double constant : program.constants_) std::fill_n(at(place++), rows, constant);
}

void Program::evaluate(const Eigen::Ref<const Matrix>& slots, Block& block) const {
  // Every instruction depends on a slot: what numbers alone give is a number of the program.
  constexpr SlotSet kAll = ~SlotSet{0};
  block.evaluated_ = true;
  evaluate_changed(slots, kAll, block);
}

void Program::evaluate_changed(const Eigen::Ref<const Matrix>& slots, SlotSet changed,
                               Block& block) const {
  check_argument(slots.cols() == slot_count_ && slots.rows() == block.rows_,
                 "Program::evaluate", "the slots are not those of the points of the block");
  check_argument(block.evaluated_, "Program::evaluate_changed",
                 "the block has not been evaluated", "evaluate() it first");
  for (Index slot = 0; slot < slot_count_; ++slot)
    if ((slot_set(slot) & changed) != 0)
      std::copy_n(slots.col(slot).data(), block.rows_, block.at(static_cast<int>(slot)));
  const StackedRegisters registers{block.registers_.data(), block.rows_};
  const std::span<const Instruction> all(instructions_);
  for (const Run& same : runs_)
    for (std::size_t begin = same.begin, end = begin; begin < same.end; begin = end) {
      const bool wanted = (depends_[begin] & changed) != 0;
      while (end < same.end && ((depends_[end] & changed) != 0) == wanted) ++end;
      if (wanted)
        run_equal(same.operation, BlockRun<Instruction, StackedRegisters>{
                                      all.subspan(begin, end - begin), registers, block.rows_});
    }
}

/// Gives every register its block; slots and written outputs get theirs block by block.
void Program::prepare(Workspace& workspace, Index rows) const {
  const auto slot_count = static_cast<std::size_t>(slot_count_);
  const auto block = static_cast<std::size_t>(rows);
  const std::size_t size = (register_count_ - slot_count) * block;
  if (workspace.registers.size() < size) workspace.registers.resize(size);
  workspace.sources.assign(register_count_, nullptr);
  workspace.targets.assign(register_count_, nullptr);
  double* memory = workspace.registers.data();
  for (const double constant : constants_)
    std::fill_n(memory, block, constant), memory += block;
  memory = workspace.registers.data();
  for (std::size_t i = slot_count; i < register_count_; ++i, memory += block)
    workspace.sources[i] = workspace.targets[i] = memory;
}

void Program::evaluate_block(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix>& out,
                             Index first, Index rows, Workspace& workspace) const {
  for (Index slot = 0; slot < slot_count_; ++slot)
    workspace.sources[static_cast<std::size_t>(slot)] = slots.col(slot).data() + first;
  for (const Output& output : written_) {
    const auto source = static_cast<std::size_t>(output.source);
    workspace.sources[source] = workspace.targets[source] =
        out.col(output.column).data() + first;
  }
  const std::span<const Instruction> all(instructions_);
  const PlacedRegisters registers{workspace.sources.data(), workspace.targets.data()};
  for (const Run& same : runs_)
    run_equal(same.operation, BlockRun<Instruction, PlacedRegisters>{
                                  all.subspan(same.begin, same.end - same.begin), registers,
                                  rows});
  for (const Output& output : copied_)
    std::copy_n(workspace.sources[static_cast<std::size_t>(output.source)], rows,
                out.col(output.column).data() + first);
}

}  // namespace lacuna
