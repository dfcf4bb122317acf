// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/formulation.hpp"
#include "regression/formulations/projection.hpp"

namespace lacuna {

/// Options of WeakForm.
struct WeakFormOptions {
  static constexpr StageInfo kInfo{
      "weak", "Rows are smooth test functions of compact support, no derivative is taken",
      "Messenger & Bortz, J. Comput. Phys. 443 (2021) 110525"};

  std::optional<double> radius = {};
  std::optional<int> order = {};

  void describe(OptionVisitor& v) {
    v.field(
        {"radius", "time units",
         "Half the support of a test function; chosen from the spectrum of the data when not "
         "given.",
         0.0},
        radius);
    v.field(
        {"order", "",
         "p of the test function (1 - (t/radius)^2)^p; chosen from the noise when not given.",
         2, 60},
        order);
  }
};

/// The weak form: for test functions phi_i that tile every record
///
///   sum_j h_kj int phi_i tau_j(t, x, u) dt ~ - int phi_i' x_k dt,   k = 1..m,
///
/// (6) of Messenger & Bortz 2021, whitened by the covariance that white noise gives the
/// right-hand side, so that noise sigma_k of a state is white noise sigma_k of its target.
/// Grids may be non-uniform. Where the dataset brings derivatives the target is int phi_i
/// dx_k/dt dt.
class WeakForm final : public Configured<Formulation, WeakFormOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
};

/// The test function for a record: its order p is the least that makes phi vanish at the ends
/// of the support to a hundredth of the noise, its radius such that the spectrum of phi, nearly
/// Gaussian of deviation sqrt(2 p + 3) / radius, passes the signal up to the frequency at which
/// it sinks into the noise.
/// @param options values that are given are kept.
/// @throws DataError as check_dataset().
TestFunction choose_test_function(const Dataset& data, const WeakFormOptions& options = {},
                                  int threads = 1);

/// Distance of neighbouring test functions at which their rows hold nearly all information:
/// radius / sqrt(order), about 1.4 deviations of phi.
double test_function_spacing(const TestFunction& function);

}  // namespace lacuna
