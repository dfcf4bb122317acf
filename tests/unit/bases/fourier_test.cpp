// SPDX-License-Identifier: MIT
#include "lacuna/bases/fourier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

using testing::ElementsAre;

const Variables kDriven{{"x"}, {"u"}};

TEST(Fourier, ListsHarmonicsOfEachVariable) {
  EXPECT_THAT(Fourier{}.library(kDriven).names(),
              ElementsAre("1", "x", "sin(x)", "cos(x)", "sin(2*x)", "cos(2*x)"));
}

TEST(Fourier, WaveNumberScalesTheArgument) {
  const Fourier basis{{.harmonics = 2, .wave_number = 0.5, .with_linear = false}};
  EXPECT_THAT(basis.library(kDriven).names(),
              ElementsAre("sin(0.5*x)", "cos(0.5*x)", "sin(x)", "cos(x)"));
}

TEST(Fourier, InputsOnRequest) {
  const Fourier basis{{.harmonics = 1, .with_inputs = true}};
  EXPECT_THAT(basis.library(kDriven).names(),
              ElementsAre("1", "x", "u", "sin(x)", "cos(x)", "sin(u)", "cos(u)"));
}

TEST(Fourier, ZeroWaveNumberIsRefused) {
  EXPECT_THROW(Fourier{{.wave_number = 0.0}}.library(kDriven), ConfigError);
}

}  // namespace
}  // namespace lacuna
