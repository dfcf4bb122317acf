// SPDX-License-Identifier: MIT
// Times beyond doubles, in every format, in memory and in pieces: differences from the first
// one are the doubles nearest to those of whole numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/long_records.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"
#if HAS_HDF5
#include "support/written_hdf5.hpp"
#endif

namespace lacuna {
namespace {

using testing::bytes_of;
using ::testing::HasSubstr;
using testing::npy_file;
using testing::TemporaryFolder;

/// Nanoseconds of a record, and a signal.
struct Stamped {
  std::vector<std::uint64_t> times;
  std::vector<std::uint64_t> signal;  ///< bits of doubles

  std::size_t size() const { return times.size(); }
};

/// An even record with a little jitter.
Stamped record_of(std::uint64_t origin, std::uint64_t step, std::size_t count, Random& random) {
  Stamped record;
  for (std::size_t i = 0; i < count; ++i) {
    record.times.push_back(origin);
    record.signal.push_back(std::bit_cast<std::uint64_t>(random.normal()));
    origin += step + random.below(step / 8 + 1);
  }
  return record;
}

/// "1700000000.123456789" of nanoseconds.
std::string seconds_text(std::uint64_t nanoseconds) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  std::string decimals = std::to_string(nanoseconds % kSecond);
  decimals.insert(0, 9 - decimals.size(), '0');
  return std::to_string(nanoseconds / kSecond) + "." + decimals;
}

template <class Text>
std::string csv(const Stamped& record, const std::string& header, const Text& text_of) {
  std::string text = header + "\n";
  for (std::size_t i = 0; i < record.size(); ++i)
    text += text_of(record.times[i]) + "," +
            format_number(std::bit_cast<double>(record.signal[i])) + "\n";
  return text;
}

std::string integers_csv(const Stamped& record) {
  return csv(record, "t [ns],x", [](std::uint64_t time) { return std::to_string(time); });
}

std::string structured_npy(const Stamped& record) {
  std::string data;
  for (std::size_t i = 0; i < record.size(); ++i)
    data += bytes_of({record.signal[i]}) + bytes_of({record.times[i]}, 8, true);
  return npy_file("[('x', '<f8'), ('t', '>u8')]", "(" + std::to_string(record.size()) + ",)",
                  data);
}

/// Times and whole numbers in one matrix.
std::string matrix_npy(const Stamped& record, bool has_sign, bool fortran) {
  std::vector<std::uint64_t> words;
  const std::size_t n = record.size();
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const std::size_t row = fortran ? i % n : i / 2, column = fortran ? i / n : i % 2;
    words.push_back(column == 0 ? record.times[row] : row % 7);
  }
  return npy_file(has_sign ? "'<i8'" : "'<u8'", "(" + std::to_string(n) + ", 2)",
                  bytes_of(words), fortran);
}

std::string npz(const Stamped& record, bool has_sign) {
  const std::string shape = "(" + std::to_string(record.size()) + ",)";
  return testing::zip_archive(
      {{"t.npy", npy_file(has_sign ? "'<i8'" : "'<u8'", shape, bytes_of(record.times))},
       {"x.npy", npy_file("'<f8'", shape, bytes_of(record.signal))}});
}

/// The times that have to come out: counted as whole numbers, rounded once.
Vector expected_times(const Stamped& record, double unit) {
  Vector times(static_cast<Index>(record.size()));
  for (std::size_t i = 0; i < record.size(); ++i)
    // Up to 2^53 nanoseconds both numbers are exact, so that their quotient is rounded once.
    times[static_cast<Index>(i)] =
        static_cast<double>(record.times[i] - record.times[0]) / unit;
  return times;
}

/// Times of a file, read at once.
Vector times_in_memory(const std::string& path) {
  const Dataset data = read_dataset({path});
  EXPECT_EQ(data.trajectories.size(), 1u) << path;
  return data.trajectories[0].time;
}

/// The same, read in pieces.
Vector times_in_pieces(const std::string& path) {
  constexpr std::size_t kLittle = std::size_t{1} << 20U;
  const auto files = open_records({path}, {}, {}, kLittle);
  const RecordStream stream = read_stream(*files);
  EXPECT_EQ(stream.excerpt().trajectories.size(), 1u) << path;
  EXPECT_EQ(stream.excerpt().notes, read_dataset({path}).notes) << path;
  return stream.excerpt().trajectories[0].time;
}

void expect_times(const std::string& path, const Vector& expected) {
  EXPECT_EQ(times_in_memory(path), expected) << path;
  EXPECT_EQ(times_in_pieces(path), expected) << path;
}

/// Origins that are 0, small and up to 1e19, steps from a nanosecond to a day.
struct Draw {
  std::uint64_t origin, step;
};

Draw draw(Random& random) {
  constexpr std::uint64_t kLargest = 10'000'000'000'000'000'000ULL;
  constexpr double kDay = 86.4e12;
  const auto step = static_cast<std::uint64_t>(std::pow(kDay, random.uniform()));
  return {random.below(kLargest) >> random.below(40), step};
}

/// Whether doubles hold all times as they are, so that these keep their origin.
bool are_plain(const Stamped& record) { return record.times.back() < (1ULL << 53U); }

Vector expected_nanoseconds(const Stamped& record) {
  if (!are_plain(record)) return expected_times(record, 1.0);
  return expected_times(record, 1.0).array() + static_cast<double>(record.times[0]);
}

constexpr int kDraws = 60;
constexpr std::size_t kRows = 60;

/// Tells of drawn records: the folder for their file, whether their times may have a sign.
template <class Check>
void for_draws(std::uint64_t seed, const Check& check) {
  Random random(seed);
  for (int i = 0; i < kDraws && !::testing::Test::HasFailure(); ++i) {
    const TemporaryFolder folder;
    const auto [origin, step] = draw(random);
    SCOPED_TRACE("origin " + std::to_string(origin) + ", step " + std::to_string(step));
    const Stamped record = record_of(origin, step, kRows, random);
    check(folder, record, record.times.back() < (1ULL << 63U));
  }
}

TEST(ExactTimes, WholeNumbersInTextAndArrays) {
  for_draws(44, [](const TemporaryFolder& folder, const Stamped& record, bool has_sign) {
    const Vector expected = expected_nanoseconds(record);
    expect_times(folder.write("a.csv", integers_csv(record)), expected);
    expect_times(folder.write("b.npy", matrix_npy(record, has_sign, false)), expected);
    expect_times(folder.write("c.npy", matrix_npy(record, has_sign, true)), expected);
    expect_times(folder.write("d.npy", structured_npy(record)), expected);
    EXPECT_EQ(times_in_memory(folder.write("e.npz", npz(record, has_sign))), expected);
  });
}

#if HAS_MATIO
TEST(ExactTimes, WholeNumbersInMatlabFiles) {
  for_draws(45, [](const TemporaryFolder& folder, const Stamped& record, bool has_sign) {
    const std::string path =
        folder.write("a.mat", testing::mat_file({{"t", false, has_sign, record.times},
                                                 {"x", true, false, record.signal}}));
    EXPECT_EQ(times_in_memory(path), expected_nanoseconds(record));
  });
}
#endif

#if HAS_HDF5
TEST(ExactTimes, WholeNumbersInHdf5) {
  for_draws(46, [](const TemporaryFolder& folder, const Stamped& record, bool has_sign) {
    {
      const testing::WrittenHdf5 file(folder.file("a.h5"));
      file.add("t", has_sign ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64, record.times.data(),
               kRows);
      file.add("x", H5T_NATIVE_DOUBLE, record.signal.data(), kRows);
    }
    expect_times(folder.file("a.h5"), expected_nanoseconds(record));
  });
}
#endif

TEST(ExactTimes, DecimalsInText) {
  constexpr double kSecond = 1e9;
  Random random(47);
  for (int i = 0; i < kDraws; ++i) {
    const TemporaryFolder folder;
    const std::uint64_t origin = 1'700'000'000'000'000'001ULL + random.below(1U << 30U);
    // Beyond 2^53 ns after the first a quotient of doubles would be rounded twice.
    const auto step = static_cast<std::uint64_t>(std::pow(1e14, random.uniform()));
    const Stamped record = record_of(origin, step, kRows, random);
    expect_times(folder.write("a.csv", csv(record, "t [s],x", seconds_text)),
                 expected_times(record, kSecond));
  }
}

TEST(ExactTimes, MicrosecondsSince1970HaveNoJitter) {
  const TemporaryFolder folder;
  std::string text = "t,x\n";
  for (int i = 0; i < 50; ++i)
    text += "1700000000." + std::to_string(123456 + i) + "," + std::to_string(i % 5) + "\n";
  Vector expected(50);
  for (Index i = 0; i < 50; ++i) expected[i] = static_cast<double>(i) / 1e6;
  expect_times(folder.write("a.csv", text), expected);
  const Dataset data = read_dataset({folder.file("a.csv")});
  EXPECT_THAT(data.notes, ::testing::ElementsAre(
                              HasSubstr("counted from the first one, 1700000000.123456")));
}

TEST(ExactTimes, OrdinaryRecordsKeepTheirOriginToTheBit) {
  const TemporaryFolder folder;
  std::string text = "t,x\n", commas = "t;x\n";
  Vector expected(3000);
  for (Index i = 0; i < 3000; ++i) {
    const double time = 5.01 + 0.01 * static_cast<double>(i);
    expected[i] = time;
    text += format_number(time) + ",1\n";
    std::string written = format_number(time);
    std::replace(written.begin(), written.end(), '.', ',');
    commas += written + ";1\n";
  }
  expect_times(folder.write("a.csv", text), expected);
  expect_times(folder.write("b.csv", commas), expected);
  EXPECT_TRUE(read_dataset({folder.file("a.csv")}).notes.empty());
}

TEST(ExactTimes, LongTextsInBlocksAreAsInMemory) {
  Random random(48);
  const TemporaryFolder folder;
  const Stamped record = record_of(1'700'000'000'123'456'789ULL, 100, 90000, random);
  const std::string path = folder.write("a.csv.gz", gzip(integers_csv(record)));
  expect_times(path, expected_times(record, 1.0));
}

TEST(ExactTimes, AColumnThatIsNoTimeKeepsItsValue) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.csv",
                   "id,x,clock\n1700000000000000512,1,0\n1700000000000001024,2,1\n"
                   "1700000000000001536,3,2\n");
  ColumnRoles roles;
  const Table table = read_table(path, roles);
  roles.time = "clock";
  roles.states = {"id"};
  EXPECT_EQ(assign_roles(table, roles).trajectories[0].states(2, 0), 1700000000000001536.0);
  EXPECT_EQ(read_dataset({path}, roles).trajectories[0].states(1, 0), 1700000000000001024.0);
}

TEST(ExactTimes, AMissingOneStaysMissing) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.csv",
                   ",7\n1700000000000000100,1\n1700000000000000200,2\nnan,3\n"
                   "1700000000000000400,4\n1700000000000000500,5\n");
  const Dataset data = read_dataset({path});
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.trajectories[0].time, Eigen::Vector2d(0.0, 100.0));
  EXPECT_EQ(data.trajectories[1].time, Eigen::Vector2d(300.0, 400.0));
}

}  // namespace
}  // namespace lacuna
