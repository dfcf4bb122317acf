// SPDX-License-Identifier: MIT
// The parts that pages show, put through the suites that are installed for parts of one's own.
#include <lacuna/testing.hpp>

#include "basis.hpp"
#include "regressor.hpp"

namespace lacuna::contract {
namespace {

INSTANTIATE_TEST_SUITE_P(Page, RegressorContract,
                         ::testing::Values(Stage<Regressor>(page::Ridge{})),
                         name_of_stage<Regressor>);
INSTANTIATE_TEST_SUITE_P(Page, BasisContract, ::testing::Values(Stage<Basis>(page::Friction{})),
                         name_of_stage<Basis>);

}  // namespace
}  // namespace lacuna::contract
