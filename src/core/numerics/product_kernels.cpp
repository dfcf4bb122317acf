// SPDX-License-Identifier: MIT
#include "core/numerics/product_kernels.hpp"

namespace Eigen::internal {
LACUNA_PRODUCT_KERNELS(template);
}  // namespace Eigen::internal
