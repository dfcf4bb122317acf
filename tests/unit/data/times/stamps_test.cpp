// SPDX-License-Identifier: MIT
#include "data/times/stamps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"

namespace lacuna {
namespace {

constexpr Stamp kMicro = kStampOfOne / 1'000'000;

std::vector<Stamp> evenly(Stamp first, Stamp step, int count = 20) {
  std::vector<Stamp> times;
  for (int i = 0; i < count; ++i) times.push_back(first + i * step);
  return times;
}

TEST(Stamps, AreTheDigitsThatAreWritten) {
  EXPECT_EQ(read_stamp("1700000000.123456"), 1700000000123456 * kMicro);
  EXPECT_EQ(read_stamp("1700000000,123456"), 1700000000123456 * kMicro);
  EXPECT_EQ(read_stamp("+1.7e9"), 1700000000 * kStampOfOne);
  EXPECT_EQ(read_stamp("-0.000000000000000001"), Stamp{-1});
  EXPECT_EQ(read_stamp("1.5E-18"), Stamp{2}) << "half away from zero";
  EXPECT_EQ(read_stamp("1.700000000123456789e+09"), read_stamp("1700000000.123456789"));
  EXPECT_EQ(read_stamp("18446744073709551615"),
            stamp_of(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_EQ(read_stamp("000000000000000000000000000000000000000000007"), stamp_of(7));
  EXPECT_EQ(read_stamp("0.3333333333333333333333333333333333333333333333"), kStampOfOne / 3);
}

TEST(Stamps, OtherTextIsNone) {
  for (const char* text : {"", "-", ".", "e5", "nan", "inf", "1.2.3", "1,2,3", "12:30", "1e",
                           "1e+-3", "0x10", "1 2", "18446744073709551616", "1e300", "1e99999"})
    EXPECT_FALSE(read_stamp(text)) << text;
  EXPECT_EQ(read_stamp("0e300"), Stamp{0});
}

TEST(Stamps, TheirTextReadsBack) {
  EXPECT_EQ(stamp_text(*read_stamp("1700000000.000001")), "1700000000.000001");
  EXPECT_EQ(stamp_text(*read_stamp("-0.5")), "-0.5");
  EXPECT_EQ(stamp_text(0), "0");
  EXPECT_EQ(stamp_text(stamp_of(100)), "100");
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    Stamp stamp = static_cast<std::int64_t>(random.below(~std::uint64_t{0}));
    stamp *= static_cast<std::int64_t>(random.below(~std::uint64_t{0}) >> 5U);
    EXPECT_EQ(read_stamp(stamp_text(stamp)), stamp) << stamp_text(stamp);
  }
}

TEST(Stamps, BecomeTheNearestDouble) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Stamp stamp = static_cast<Stamp>(random.below(~std::uint64_t{0})) *
                        static_cast<std::int64_t>(random.below(~std::uint64_t{0}) >> 4U);
    const std::string text = stamp_text(stamp / 16);
    EXPECT_EQ(value_of(stamp / 16), *parse_number(text)) << text;
  }
  EXPECT_EQ(value_of(kMicro), 1e-6);
  EXPECT_EQ(value_of(stamp_of(100)), 100.0);
}

TEST(Stamps, ADoubleHasANearestStamp) {
  EXPECT_EQ(nearest_stamp(0.5), kStampOfOne / 2);
  EXPECT_EQ(nearest_stamp(-3.0), stamp_of(-3));
  EXPECT_EQ(nearest_stamp(0.1), kStampOfOne / 10 + 6) << "0.10000000000000000555";
  EXPECT_EQ(nearest_stamp(1.7e18), stamp_of(std::int64_t{1'700'000'000'000'000'000}));
  EXPECT_EQ(nearest_stamp(1e-40), Stamp{0});
  EXPECT_EQ(nearest_stamp(0.0), Stamp{0});
}

TEST(Stamps, TimesThatDoublesHoldKeepTheirOrigin) {
  EXPECT_FALSE(origin_of({}));
  EXPECT_FALSE(origin_of(evenly(0, kMicro)));
  EXPECT_FALSE(origin_of(evenly(*read_stamp("5.01"), kStampOfOne / 100)));
  EXPECT_FALSE(origin_of(evenly(stamp_of(100'000), kStampOfOne / 1000))) << "a day at 1 kHz";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000), kStampOfOne))) << "1970, seconds";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000'000), kStampOfOne))) << "milliseconds";
  EXPECT_FALSE(origin_of(evenly(stamp_of(1'700'000'000'000'000), kStampOfOne)))
      << "whole microseconds are below 2^53";
}

TEST(Stamps, OthersAreCountedFromTheFirst) {
  const Stamp nanoseconds = stamp_of(std::int64_t{1'700'000'000'123'456'789});
  EXPECT_EQ(origin_of(evenly(nanoseconds, stamp_of(100))), nanoseconds);
  EXPECT_EQ(origin_of(evenly(nanoseconds, stamp_of(86'400'000'000'000))), nanoseconds);
  const Stamp written = *read_stamp("1700000000.123456");
  EXPECT_EQ(origin_of(evenly(written, kMicro)), written) << "rounded to a quarter of the step";
  const Stamp digits = *read_stamp("1700000000.123456789");
  EXPECT_EQ(origin_of(evenly(digits, 3600 * kStampOfOne)), digits) << "digits are lost";
}

}  // namespace
}  // namespace lacuna
