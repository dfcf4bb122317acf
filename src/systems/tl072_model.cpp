// SPDX-License-Identifier: MIT
#include "tl072_model.hpp"

#include "model_builder.hpp"

namespace lacuna {
namespace {

struct Row {
  const char* term;
  double coefficients[3];  // of dx, dy, dz
};

// clang-format off
constexpr Row kTable3[] = {
    {"1", {0.019849, -0.0024084, 0.062474}},
    {"x", {0.017621, 1.0191, -0.007625}},
    {"y", {-0.9903, 0.17204, 0.0046164}},
    {"z", {-1.457, -0.068364, -5.6767}},
    {"x^2", {0.0010702, 0.0004429, 0.00036258}},
    {"x*y", {-0.0017098, -0.00040747, -0.0018867}},
    {"x*z", {0.1873, 0.039947, 4.2853}},
    {"y^2", {-0.00083531, 0.00053668, -0.0029468}},
    {"y*z", {0.048575, 0.021055, -0.48176}},
    {"z^2", {-0.0042236, 5.637e-05, -0.39533}},
    {"x^3", {0.0016788, -0.00405, 0.0002334}},
    {"x^2*y", {0.001738, -0.0048882, -0.00080567}},
    {"x^2*z", {0.069154, -0.0091399, 0.17589}},
    {"x*y^2", {-0.0028329, -0.0037991, -0.00093897}},
    {"x*y*z", {0.024123, -0.0098508, 0.13015}},
    {"x*z^2", {-0.013913, -0.00082434, -0.007106}},
    {"y^3", {0.0026073, 0.00025179, -0.0012808}},
    {"y^2*z", {0.0084769, -0.010925, 0.036443}},
    {"y*z^2", {0.029241, -0.0034983, 0.09409}},
    {"z^3", {0.0067338, -4.1591e-05, 0.022279}},
};
// clang-format on

}  // namespace

OdeModel tl072_model() {
  std::vector<std::vector<TextTerm>> equations(3);
  for (const Row& row : kTable3)
    for (std::size_t k = 0; k < 3; ++k) equations[k].push_back({row.term, row.coefficients[k]});
  return build_model({{"x", "V"}, {"y", "V"}, {"z", "V"}}, equations, "tau");
}

}  // namespace lacuna
