// SPDX-License-Identifier: MIT
// Parts written in Python: functions that take the place of a C++ hook. The public methods of
// their plug points check what they give as they check any part.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "call.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna::python {

namespace nb = nanobind;

/// A function of Python that threads without the interpreter's lock may hold.
class Function {
 public:
  explicit Function(nb::object function) : function_(std::move(function)) {}
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;
  ~Function() {
    const nb::gil_scoped_acquire acquire;
    function_.reset();
  }

  /// Only with the interpreter's lock.
  const nb::object& get() const { return function_; }

 private:
  nb::object function_;
};

/// Name and function of a part written in Python, and the call that it is used by.
class Written {
 public:
  Written(std::string name, nb::object function)
      : name_(std::make_shared<const std::string>(std::move(name))),
        info_{*name_, "Written in Python", ""},
        own_(std::make_shared<const Function>(std::move(function))),
        function_(own_),
        callbacks_(std::make_shared<Callbacks>()) {}

  /// Belongs to the call that has these: they keep the function until the call has ended, so
  /// that an answer, which has the part too, does not; an interrupt of the call ends the
  /// function.
  void join(std::shared_ptr<Callbacks> callbacks) {
    callbacks_ = std::move(callbacks);
    callbacks_->keep(std::exchange(own_, nullptr));
  }

  const StageInfo& info() const { return info_; }

  /// What the function gives; only with the interpreter's lock.
  template <class... Arguments>
  nb::object operator()(const Arguments&... arguments) const {
    const auto function = function_.lock();
    if (!function) throw std::runtime_error(*name_ + ": its call has ended");
    return callbacks_->run([&] { return function->get()(arguments...); });
  }

  /// The function where no call has it too: Python's garbage collector looks for cycles in it.
  PyObject* collectable() const { return own_.use_count() == 1 ? own_->get().ptr() : nullptr; }
  void clear() { own_.reset(); }

 private:
  std::shared_ptr<const std::string> name_;  // info_ refers to it
  StageInfo info_;
  std::shared_ptr<const Function> own_;
  std::weak_ptr<const Function> function_;
  std::shared_ptr<Callbacks> callbacks_;
};

/// A part whose hooks call a function of Python.
template <class Interface>
class WrittenPart : public Interface {
 public:
  explicit WrittenPart(Written written) : written_(std::move(written)) {}
  const StageInfo& info() const override { return written_.info(); }
  void visit_options(OptionVisitor&) const override {}

  Written& written() { return written_; }
  const Written& written() const { return written_; }

 private:
  Written written_;
};

/// Terms from names: f(states, inputs) -> formulas.
class WrittenBasis final : public WrittenPart<Basis> {
 public:
  using WrittenPart::WrittenPart;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override;
};

/// Coefficients from a least-squares problem: f(theta, y) -> one number for each column, 0 for
/// a term that goes.
class WrittenRegressor final : public WrittenPart<Regressor> {
 public:
  using WrittenPart::WrittenPart;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

/// Forms that an equation may lack: f(scope) -> dictionaries with form, argument, shapes,
/// starts.
class WrittenEffect final : public WrittenPart<Effect> {
 public:
  WrittenEffect(Written written, std::string cause)
      : WrittenPart(std::move(written)),
        cause_(std::make_shared<const std::string>(std::move(cause))) {}

 private:
  std::string_view do_typical_cause() const override { return *cause_; }
  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override;
  std::shared_ptr<const std::string> cause_;
};

}  // namespace lacuna::python
