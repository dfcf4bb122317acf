// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/program.hpp"

#include <algorithm>
#include <string>

#include "core/numerics/column_kernels.hpp"
#include "lacuna/core/base/error.hpp"
#include "operations.hpp"
#include "program_builder.hpp"

namespace lacuna {
namespace {

/// Rows of a block: a register of a block is 1 KiB, so dozens of them stay in the first cache.
constexpr Index kBlockRows = 128;

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

/// Runs equal instructions on blocks of rows; the inner loops are what the compiler vectorises.
template <class Instruction>
struct BlockRun {
  std::span<const Instruction> instructions;
  const double* const* sources;
  double* const* targets;
  Index rows;

  template <class F>
  void unary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = sources[i.a];
      double* __restrict out = targets[i.target];
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row]);
    }
  }
  template <class F>
  void binary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = sources[i.a];
      const double* b = sources[i.b];
      double* __restrict out = targets[i.target];
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row], b[row]);
    }
  }
  /// What most of a library is made of.
  void products() const {
    for (const Instruction& i : instructions)
      multiply(sources[i.a], sources[i.b], rows, targets[i.target]);
  }
  template <class F>
  void ternary(F f) const {
    for (const Instruction& i : instructions) {
      const double* a = sources[i.a];
      const double* b = sources[i.b];
      const double* c = sources[i.c];
      double* __restrict out = targets[i.target];
      for (Index row = 0; row < rows; ++row) out[row] = f(a[row], b[row], c[row]);
    }
  }
};

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
  for (const Run& run : runs_) {
    const BlockRun<Instruction> block{all.subspan(run.begin, run.end - run.begin),
                                      workspace.sources.data(), workspace.targets.data(), rows};
    if (run.operation == Operation::Multiply)
      block.products();
    else
      with_function(run.operation, block);
  }
  for (const Output& output : copied_)
    std::copy_n(workspace.sources[static_cast<std::size_t>(output.source)], rows,
                out.col(output.column).data() + first);
}

}  // namespace lacuna
