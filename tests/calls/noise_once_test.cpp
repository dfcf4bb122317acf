// SPDX-License-Identifier: MIT
// What a record shows of its noise is found once in a command and handed on. The linker puts
// the counters in front of the library's functions (tests/CMakeLists.txt); the library itself
// counts nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "support/run_command.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

void append(const Eigen::Ref<const Vector>& numbers, std::string& text) {
  const Vector whole = numbers;
  text.append(reinterpret_cast<const char*>(whole.data()),
              sizeof(double) * static_cast<std::size_t>(whole.size()));
}

/// How often the samples of a state, with their times and marks, were looked at.
class Calls {
 public:
  void add(const Dataset& data, Index state) {
    std::string samples = data.states[static_cast<std::size_t>(state)].name + '\n';
    for (const Trajectory& record : data.trajectories) {
      append(record.time, samples);
      append(record.states.col(state), samples);
      for (Index i = 0; i < record.samples(); ++i)
        samples += static_cast<char>('0' + static_cast<int>(mark_of(record.marks, i, state)));
    }
    const std::lock_guard lock(mutex_);
    ++counts_[samples];
  }

  int most() const {
    int most = 0;
    for (const auto& [samples, count] : counts_) most = std::max(most, count);
    return most;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, int> counts_;
};

Calls* analyses = nullptr;  ///< while a command runs

void count(const Dataset& data) {
  for (Index k = 0; k < data.state_count() && analyses != nullptr; ++k) analyses->add(data, k);
}

}  // namespace

#define LACUNA_PUT_BEFORE(result, name, symbol, ...)         \
  result real_##name(__VA_ARGS__) __asm__("__real_" symbol); \
  result counted_##name(__VA_ARGS__) __asm__("__wrap_" symbol);

LACUNA_PUT_BEFORE(std::vector<StateNoise>, analyse_noise,
                  "_ZN6lacuna13analyse_noiseERKNS_7DatasetEi", const Dataset&, int)
LACUNA_PUT_BEFORE(StateNoise, analyse_noise_of, "_ZN6lacuna16analyse_noise_ofERKNS_7DatasetEl",
                  const Dataset&, Index)
LACUNA_PUT_BEFORE(Vector, estimate_noise, "_ZN6lacuna14estimate_noiseERKNS_7DatasetEi",
                  const Dataset&, int)

std::vector<StateNoise> counted_analyse_noise(const Dataset& data, int threads) {
  count(data);
  return real_analyse_noise(data, threads);
}

StateNoise counted_analyse_noise_of(const Dataset& data, Index state) {
  if (analyses != nullptr) analyses->add(data, state);
  return real_analyse_noise_of(data, state);
}

Vector counted_estimate_noise(const Dataset& data, int threads) {
  count(data);
  return real_estimate_noise(data, threads);
}

namespace {

const std::string kData = LACUNA_SOURCE_DIR "/data/";
const std::string kPendulum = kData + "pendulum_scope_1.csv.gz";
constexpr const char* kScope = "th=CH1,w=CH2,u=CH3";

/// The most often that any samples were looked at while a command ran.
int most_in(std::vector<std::string> command) {
  Calls calls;
  analyses = &calls;
  const CommandResult run = run_command(std::move(command));
  analyses = nullptr;
  EXPECT_EQ(run.status, 0) << run.err;
  return calls.most();
}

TEST(NoiseIsFoundOnce, InDiagnose) {
  EXPECT_EQ(
      most_in({"diagnose", "--model", kData + "pendulum.ode", "--map", kScope, kPendulum}), 1);
}

TEST(NoiseIsFoundOnce, InDiagnoseOfWhatIsHeldOut) {
  EXPECT_EQ(most_in({"diagnose", kPendulum, "--model", kData + "pendulum.ode", "--map", kScope,
                     "--holdout", kData + "pendulum_scope_2.csv.gz"}),
            1);
}

TEST(NoiseIsFoundOnce, InDiagnoseWithAHiddenState) {
  TemporaryFolder folder;
  const std::string model =
      folder.write("m.ode", "input u\ndx/dt = -x + z\ndz/dt = u - 0.5*z\n");
  std::string samples = "t,u,x\n";
  double x = 0.0, z = 0.0;
  for (int i = 0; i < 800; ++i) {
    const double u = std::sin(0.05 * i) + std::cos(0.013 * i);
    samples += std::to_string(0.05 * i) + "," + std::to_string(u) + "," +
               std::to_string(x + 1e-3 * std::sin(917.0 * i * i)) + "\n";
    for (int s = 0; s < 10; ++s) {
      x += 0.005 * (-x + z);
      z += 0.005 * (u - 0.5 * z);
    }
  }
  EXPECT_EQ(most_in({"diagnose", "--model", model, folder.write("r.csv", samples)}), 1);
}

TEST(NoiseIsFoundOnce, InIdentify) {
  EXPECT_EQ(most_in({"identify", kData + "tl072_record.csv.gz"}), 1);
}

TEST(NoiseIsFoundOnce, InIdentifyWithRecordsHeldOut) {
  EXPECT_EQ(most_in({"identify", kPendulum, "--map", kScope, "--states", "th,w", "--inputs",
                     "u", "--holdout", kData + "pendulum_scope_2.csv.gz"}),
            1);
}

TEST(NoiseIsFoundOnce, InFit) {
  EXPECT_EQ(most_in({"fit", kData + "pendulum.ode", kPendulum, "--map", kScope}), 1);
}

TEST(NoiseIsFoundOnce, InSync) {
  EXPECT_EQ(most_in({"sync", "rossler-adjusted", kData + "tl072_record.csv.gz"}), 1);
}

TEST(NoiseIsFoundOnce, InCheck) {
  EXPECT_EQ(most_in({"check", kData + "tl072_record.csv.gz"}), 1);
}

TEST(NoiseIsFoundOnce, AndTwiceIsNoticed) {
  Calls calls;
  analyses = &calls;
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories = {
      {"", Vector::LinSpaced(30, 0.0, 1.0), Matrix::Random(30, 1), Matrix(30, 0), Matrix()}};
  estimate_noise(data);
  const int once = calls.most();
  analyse_noise(data);
  analyses = nullptr;
  EXPECT_EQ(once, 1);
  EXPECT_EQ(calls.most(), 2);
}

TEST(NoiseIsFoundOnce, InCompare) {
  EXPECT_LE(most_in({"compare", "rossler-adjusted", kData + "tl072_record.csv.gz"}), 1)
      << "attractors are compared whatever their noise is";
}

}  // namespace
}  // namespace lacuna::testing
