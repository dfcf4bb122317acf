// SPDX-License-Identifier: MIT
#include "contract/contract.hpp"

namespace lacuna::contract {
namespace {

INSTANTIATE_TEST_SUITE_P(Registry, RegressorContract,
                         ::testing::ValuesIn(stages_of<Regressor>()), name_of_stage<Regressor>);

}  // namespace
}  // namespace lacuna::contract
