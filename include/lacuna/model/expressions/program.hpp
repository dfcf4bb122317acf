// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// The variables of a model in their fixed order: states, inputs, then time `t`.
struct Variables {
  std::vector<std::string> states;  ///< m
  std::vector<std::string> inputs;  ///< p

  /// Number of slots: m + p + 1.
  Index count() const noexcept { return static_cast<Index>(states.size() + inputs.size()) + 1; }

  /// All names in slot order; the last is "t".
  std::vector<std::string> names() const;

  bool operator==(const Variables&) const = default;
};

/// Variables that are found by their names, however many there are.
class VariableIndex {
 public:
  explicit VariableIndex(const Variables& variables);  ///< m + p + 1 names

  /// The slot of a name, the first where it stands twice; nothing where it is no variable.
  std::optional<Index> find(const std::string& name) const;

  /// All names in slot order; the last is "t".
  const std::vector<std::string>& names() const noexcept { return names_; }

  /// Number m of the states, which have the first slots.
  Index states() const noexcept { return states_; }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, Index> slots_;
  Index states_;
};

/// A variable as it was a fixed time ago.
struct DelayedVariable {
  Index slot = 0;      ///< which variable
  double delay = 0.0;  ///< time units, >= 0
  /// Whether all outputs of the program are affine in its delayed variables, so that the mean
  /// and the first moments of one over a step say all that it does there.
  bool affine = false;

  /// The same past of the same variable, whatever is made of it.
  bool operator==(const DelayedVariable& other) const {
    return slot == other.slot && delay == other.delay;
  }
};

/// Expressions compiled to one straight-line program in which every common subexpression is
/// computed once (x^2*y is x^2 times y, x^2 is x times x).
///
/// Arguments are slots: the variables in order, then one slot for each entry of `delays()`.
/// The program is immutable; each thread brings its own workspace.
class Program {
 public:
  /// Scratch memory of one thread; grows as needed, may be used with any program.
  struct Workspace {
    std::vector<double> registers;
    std::vector<const double*> sources;
    std::vector<double*> targets;
  };

  /// A set of slots: one bit each, the last bit for all that are beyond.
  using SlotSet = std::uint64_t;

  /// The set of one slot.
  static constexpr SlotSet slot_set(Index slot) noexcept {
    constexpr Index kLastBit = 63;
    return SlotSet{1} << (slot >= 0 && slot < kLastBit ? slot : kLastBit);
  }

  /// Rows of a block: a register of a block is 1 KiB, so dozens of them stay in the first cache.
  static constexpr Index kBlockRows = 128;

  /// What a program computes at a few points with all that it computes it from, so that little
  /// is to be done where little has changed. For the program it was made with.
  class Block {
   public:
    /// Room for so many points. @throws ArgumentError for less than 0 or more than kBlockRows.
    Block(const Program& program, Index rows);

    Index rows() const noexcept { return rows_; }  ///< points

   private:
    friend class Program;
    double* at(int place) noexcept { return registers_.data() + place * rows_; }
    const double* at(int place) const noexcept { return registers_.data() + place * rows_; }

    std::vector<double> registers_;
    Index rows_;
    bool evaluated_ = false;
  };

  /// One value for each of the outputs.
  /// @throws ModelError naming a variable that is not in `variables`.
  Program(std::span<const Expression> outputs, const Variables& variables);

  Index slots() const noexcept { return slot_count_; }  ///< variables and delayed variables
  Index outputs() const noexcept { return static_cast<Index>(outputs_.size()); }  ///< values

  /// Instructions that one evaluation takes.
  Index operations() const noexcept { return static_cast<Index>(instructions_.size()); }

  /// Distinct delayed variables, in the order in which the outputs name them.
  const std::vector<DelayedVariable>& delays() const noexcept { return delays_; }

  /// All outputs for one state. `slots` has slots() entries, `out` has outputs() entries.
  void evaluate(const double* slots, double* out, Workspace& workspace) const;

  /// All outputs for many rows at once.
  /// Rows go through in blocks that stay in cache; each instruction is one loop over the block.
  /// @param slots rows x slots(); @param out rows x outputs(), other memory than `slots`.
  /// @throws ArgumentError when shapes do not fit.
  void evaluate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> out,
                Workspace& workspace) const;

  /// All outputs at the points of a block, which keeps them.
  /// @param slots block.rows() x slots(). @throws ArgumentError when shapes do not fit.
  void evaluate(const Eigen::Ref<const Matrix>& slots, Block& block) const;

  /// evaluate(), to the bit, where no slots but `changed` differ from those with which the block
  /// was evaluated last: only what depends on these is computed.
  /// @param slots block.rows() x slots().
  /// @throws ArgumentError when shapes do not fit or the block has not been evaluated.
  void evaluate_changed(const Eigen::Ref<const Matrix>& slots, SlotSet changed,
                        Block& block) const;

  /// The block.rows() values of an output, as the last evaluation left them.
  const double* output(Index number, const Block& block) const {
    return block.at(outputs_[static_cast<std::size_t>(number)]);
  }

 private:
  friend class ProgramBuilder;

  /// Registers: the slots, the constants, then one for each instruction's result.
  struct Instruction {
    int target, a, b, c;
  };

  /// Instructions [begin, end) that all do the same operation.
  struct Run {
    Operation operation;
    std::size_t begin, end;
  };

  /// An output column and the register it shows.
  struct Output {
    Index column;
    int source;
  };

  void prepare(Workspace& workspace, Index rows) const;
  void evaluate_block(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix>& out,
                      Index first, Index rows, Workspace& workspace) const;

  std::vector<Instruction> instructions_;
  std::vector<SlotSet> depends_;  ///< slots that the result of each instruction depends on
  std::vector<Run> runs_;
  std::vector<double> constants_;
  std::vector<DelayedVariable> delays_;
  std::vector<int> outputs_;
  std::vector<Output> written_;  ///< outputs that are computed in place
  std::vector<Output> copied_;   ///< outputs that are slots, constants or shown twice
  Index slot_count_ = 0;
  std::size_t register_count_ = 0;
};

}  // namespace lacuna
