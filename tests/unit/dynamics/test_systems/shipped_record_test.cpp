// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/shipped_record.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <memory>

#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/formats/write.hpp"

namespace lacuna {
namespace {

const std::string kFile = LACUNA_SOURCE_DIR "/data/tl072_record.csv.gz";

std::string unpacked(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  std::string text;
  std::vector<char> part(65536);
  for (int count = 1; file && count > 0;) {
    count = gzread(file.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
  return text;
}

TEST(ShippedRecord, IsRemadeByteForByte) {
  const std::string made = format_csv(tl072_record(), tl072_record_comment());
  EXPECT_TRUE(made == unpacked(kFile)) << "remake it: make_tl072_record " << kFile;
}

TEST(ShippedRecord, IsWhatItSays) {
  const Dataset record = tl072_record();
  const Trajectory& run = record.trajectories[0];
  EXPECT_EQ(run.samples(), 10000);
  EXPECT_NEAR(*uniform_step(run), 0.1, 1e-12);
  const Matrix levels = run.states * (65536.0 / 20.0);
  EXPECT_EQ(levels, Matrix(levels.array().round()));
  const auto extent = run.states.colwise().maxCoeff() - run.states.colwise().minCoeff();
  EXPECT_NEAR(extent[0], 4.260, 0.02);
  EXPECT_NEAR(extent[1], 3.932, 0.02);
  EXPECT_NEAR(extent[2], 3.912, 0.04);
}

// Differences of order 6 remove the signal; what is left is the noise, 1 mV and a level's own.
TEST(ShippedRecord, HasTheNoiseItSays) {
  const Vector x = tl072_record().trajectories[0].states.col(0);
  const Index n = x.size() - 6;
  const Vector difference = x.segment(0, n) - 6.0 * x.segment(1, n) + 15.0 * x.segment(2, n) -
                            20.0 * x.segment(3, n) + 15.0 * x.segment(4, n) -
                            6.0 * x.segment(5, n) + x.segment(6, n);
  Vector magnitude = difference.cwiseAbs() / std::sqrt(924.0);
  std::sort(magnitude.begin(), magnitude.end());
  EXPECT_NEAR(magnitude[n / 2] / 0.6745, 1e-3, 1e-4);
}

}  // namespace
}  // namespace lacuna
