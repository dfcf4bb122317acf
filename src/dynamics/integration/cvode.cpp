// SPDX-License-Identifier: MIT
#include "dynamics/integration/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// What SUNDIALS is given to evaluate: the right-hand side of the present advance().
struct Rates {
  const RightHandSide* rhs = nullptr;
  Index dimension = 0;
  std::exception_ptr thrown = {};  ///< by the right-hand side: none passes through C
};

/// SUNDIALS' callback; 1 asks it to try a shorter step, for rates that are not finite; below 0
/// it gives up.
int evaluate(realtype t, N_Vector x, N_Vector dxdt, void* data) {
  auto& rates = *static_cast<Rates*>(data);
  double* values = N_VGetArrayPointer(dxdt);
  try {
    (*rates.rhs)(t, N_VGetArrayPointer(x), values);
  } catch (...) {
    rates.thrown = std::current_exception();
    return -1;
  }
  const bool finite = std::all_of(values, values + rates.dimension,
                                  [](double value) { return std::isfinite(value); });
  return finite ? 0 : 1;
}

void say_nothing(int, const char*, const char*, char*, void*) {}

/// A pointer of SUNDIALS with what frees it. @throws std::bad_alloc for none.
template <class Type, class Free>
std::unique_ptr<Type, Free> owned(Type* pointer, Free free) {
  if (pointer == nullptr) throw std::bad_alloc();
  return {pointer, free};
}

SUNContext new_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return context;
}

class CvodeStepper final : public Stepper {
 public:
  CvodeStepper(Index dimension, const CvodeOptions& options)
      : rates_{.dimension = dimension}, options_(options) {}

  IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) override {
    rates_.rhs = &rhs;
    const Eigen::Map<Vector> start(x, rates_.dimension);
    Eigen::Map<Vector> state(N_VGetArrayPointer(state_.get()), rates_.dimension);
    const bool goes_on = begun_ && t0 == time_ && start == state;
    if (!goes_on) begin(t0, x);
    int flag = step_to(t1);
    if (flag < 0 && goes_on) {  // an input has jumped: what was before it foretells nothing
      begin(t0, x);
      flag = step_to(t1);
    }
    const bool is_good = state.allFinite();
    if (is_good) {
      std::copy(state.begin(), state.end(), x);
      t0 = time_;
    }
    if (flag >= 0 && is_good) return IntegrationStatus::Completed;
    begun_ = false;
    const bool ran_away = !is_good || !(state.cwiseAbs().maxCoeff() <= bound_);
    return ran_away ? IntegrationStatus::Diverged : IntegrationStatus::StepTooSmall;
  }

 private:
  int step_to(double t1) {
    CVodeSetStopTime(memory_.get(), t1);
    const int flag = CVode(memory_.get(), t1, state_.get(), &time_, CV_NORMAL);
    if (rates_.thrown) {
      begun_ = false;
      std::rethrow_exception(std::exchange(rates_.thrown, nullptr));
    }
    return flag;
  }

  /// Starts at a state with a step of its own, as at the begin and where a caller moved x.
  void begin(double t, const double* x) {
    std::copy(x, x + rates_.dimension, N_VGetArrayPointer(state_.get()));
    if (bound_ == 0.0) {
      bound_ = divergence_bound(x, rates_.dimension);
      set_up(t);
    } else {
      CVodeReInit(memory_.get(), t, state_.get());
    }
    time_ = t;
    begun_ = true;
  }

  void set_up(double t) {
    void* const memory = memory_.get();
    CVodeInit(memory, evaluate, t, state_.get());
    CVodeSetErrHandlerFn(memory, say_nothing, nullptr);
    CVodeSetMaxHnilWarns(memory, -1);
    CVodeSetUserData(memory, &rates_);
    CVodeSStolerances(memory, options_.relative_tolerance, options_.absolute_tolerance);
    CVodeSetLinearSolver(memory, solver_.get(), jacobian_.get());
    CVodeSetMaxNumSteps(memory, options_.max_steps);
    if (options_.max_step) CVodeSetMaxStep(memory, *options_.max_step);
  }

  static void free_context(SUNContext context) { SUNContext_Free(&context); }
  static void free_memory(void* memory) { CVodeFree(&memory); }

  Rates rates_;
  CvodeOptions options_;
  std::unique_ptr<std::remove_pointer_t<SUNContext>, decltype(&free_context)> context_ =
      owned(new_context(), &free_context);
  std::unique_ptr<std::remove_pointer_t<N_Vector>, decltype(&N_VDestroy)> state_ =
      owned(N_VNew_Serial(rates_.dimension, context_.get()), &N_VDestroy);
  std::unique_ptr<std::remove_pointer_t<SUNMatrix>, decltype(&SUNMatDestroy)> jacobian_ =
      owned(SUNDenseMatrix(rates_.dimension, rates_.dimension, context_.get()), &SUNMatDestroy);
  std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, decltype(&SUNLinSolFree)> solver_ =
      owned(SUNLinSol_Dense(state_.get(), jacobian_.get(), context_.get()), &SUNLinSolFree);
  std::unique_ptr<void, decltype(&free_memory)> memory_ =
      owned(CVodeCreate(CV_BDF, context_.get()), &free_memory);
  double bound_ = 0.0;
  double time_ = 0.0;
  bool begun_ = false;
};

}  // namespace

std::string Cvode::unavailable() { return ""; }

std::unique_ptr<Stepper> Cvode::make_stepper(Index dimension) const {
  constexpr Index kMostStates = Index{1} << 13;  // a fact of memory: half a GiB of Jacobian
  check_argument(dimension >= 1 && dimension <= kMostStates, "integrator cvode",
                 "it takes 1 to 8192 states", "use dopri5 for more");
  return std::make_unique<CvodeStepper>(dimension, options());
}

}  // namespace lacuna
