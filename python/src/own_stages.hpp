// SPDX-License-Identifier: MIT
// Parts written in Python: functions that take the place of a C++ hook. The public methods of
// their plug points check what they give as they check any part.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <string>

#include "call.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/regressor.hpp"

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
        function_(std::make_shared<const Function>(std::move(function))),
        callbacks_(std::make_shared<Callbacks>()) {}

  /// The same, ended by an interrupt of the call that has these.
  Written in(std::shared_ptr<Callbacks> callbacks) const {
    Written same = *this;
    same.callbacks_ = std::move(callbacks);
    return same;
  }

  const StageInfo& info() const { return info_; }

  /// What the function gives; only with the interpreter's lock.
  template <class... Arguments>
  nb::object operator()(const Arguments&... arguments) const {
    return callbacks_->run([&] { return function_->get()(arguments...); });
  }

 private:
  std::shared_ptr<const std::string> name_;  // info_ refers to it
  StageInfo info_;
  std::shared_ptr<const Function> function_;
  std::shared_ptr<Callbacks> callbacks_;
};

/// Terms from names: f(states, inputs) -> formulas.
class WrittenBasis final : public Basis {
 public:
  explicit WrittenBasis(Written written) : written_(std::move(written)) {}
  WrittenBasis in(const std::shared_ptr<Callbacks>& callbacks) const {
    return WrittenBasis(written_.in(callbacks));
  }
  const StageInfo& info() const override { return written_.info(); }
  void visit_options(OptionVisitor&) const override {}

 private:
  std::vector<Term> do_terms(const Variables& variables) const override;
  Written written_;
};

/// Coefficients from a least-squares problem: f(theta, y) -> one number for each column, 0 for
/// a term that goes.
class WrittenRegressor final : public Regressor {
 public:
  explicit WrittenRegressor(Written written) : written_(std::move(written)) {}
  WrittenRegressor in(const std::shared_ptr<Callbacks>& callbacks) const {
    return WrittenRegressor(written_.in(callbacks));
  }
  const StageInfo& info() const override { return written_.info(); }
  void visit_options(OptionVisitor&) const override {}

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
  Written written_;
};

/// Forms that an equation may lack: f(scope) -> dictionaries with form, argument, shapes,
/// starts.
class WrittenEffect final : public Effect {
 public:
  WrittenEffect(Written written, std::string cause)
      : written_(std::move(written)),
        cause_(std::make_shared<const std::string>(std::move(cause))) {}
  WrittenEffect in(const std::shared_ptr<Callbacks>& callbacks) const {
    return {written_.in(callbacks), *cause_};
  }
  const StageInfo& info() const override { return written_.info(); }
  void visit_options(OptionVisitor&) const override {}

 private:
  std::string_view do_typical_cause() const override { return *cause_; }
  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override;
  Written written_;
  std::shared_ptr<const std::string> cause_;
};

}  // namespace lacuna::python
