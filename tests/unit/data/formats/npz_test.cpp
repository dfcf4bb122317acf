// SPDX-License-Identifier: MIT
#include "data/formats/npz.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/npy.hpp"
#include "data/times/counted_times.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

std::string archive(const std::vector<std::pair<std::string, Matrix>>& arrays, bool pack) {
  std::vector<std::pair<std::string, std::string>> contents;
  for (const auto& [name, values] : arrays) {
    const testing::TemporaryFolder folder;
    write_npy(folder.file("a.npy"), values);
    contents.emplace_back(name, folder.read("a.npy"));
  }
  return testing::zip_archive(contents, pack);
}

TEST(Npz, DatesAreTimesInTheirUnit) {
  std::string times = npy_begin("<M8[us]", false, 30, 1),
              values = npy_begin("<f8", false, 30, 1);
  for (std::size_t i = 0; i < 30; ++i) {
    times += testing::bytes_of({1'795'000'000'000'000 + 20 * i});
    values += testing::bytes_of({0x3FF0000000000000 + i});
  }
  const Table table =
      parse_npz(testing::zip_archive({{"t.npy", times}, {"x.npy", values}}, true), "a.npz",
                time_finder({}));
  EXPECT_EQ(table.columns[0].name, "t");
  EXPECT_EQ(table.columns[0].unit, "us");
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_EQ(table.values(29, 0) - table.values(0, 0), 580.0);
}

TEST(Npz, ArraysAreColumns) {
  const Vector t = Vector::LinSpaced(50, 0.0, 1.0);
  const Matrix x = Matrix::Random(50, 2), y = Matrix::Random(2, 50);
  for (const bool pack : {false, true}) {
    const Table table = parse_npz(archive({{"t.npy", t.transpose()},
                                           {"x.npy", x},
                                           {"y.npy", y},
                                           {"note.npy", Vector::Ones(1)}},
                                          pack),
                                  "a.npz");
    ASSERT_EQ(table.columns.size(), 5u);
    EXPECT_EQ(table.columns[0].name, "t");
    EXPECT_EQ(table.columns[2].name, "x2");
    EXPECT_EQ(table.columns[3].name, "y1");
    EXPECT_EQ(table.values.col(0), t);
    EXPECT_EQ(table.values.middleCols(1, 2), x);
    EXPECT_EQ(table.values.rightCols(2), y.transpose());
    EXPECT_THAT(table.notes.at(0),
                ::testing::HasSubstr("'note' has 1 x 1 values, not 50 samples"));
  }
  EXPECT_EQ(parse_npz(archive({{"x.npy", y.leftCols(6)}}, true), "a.npz").values, y.leftCols(6))
      << "rows are samples";
}

TEST(Npz, WhatIsNoMatrixIsLeftOutAndNoted) {
  const std::string words = testing::bytes_of({1, 2, 3, 4, 5, 6, 7, 8});
  const std::string file = testing::zip_archive(
      {{"t.npy", testing::npy_file("'<i8'", "(8,)", words)},
       {"fs.npy", testing::npy_file("'<f8'", "()", words.substr(0, 8))},
       {"who.npy", testing::npy_file("'<U2'", "(8,)", words)},
       {"cube.npy", testing::npy_file("'<i8'", "(2, 2, 2)", words)},
       {"z.npy", testing::npy_file("'<c16'", "(4,)", words)},
       {"o.npy", testing::npy_file("'|O'", "(8,)", words)},
       {"none.npy", testing::npy_file("'<f8'", "(0,)", "")},
       {"readme.txt", "made by hand"},
       {"run.npy",
        testing::npy_file("[('x', '<i2'), ('y', '<i2'), ('w', '<f4')]", "(8,)", words)}});
  const Table table = parse_npz(file, "a.npz");
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  EXPECT_THAT(names, ::testing::ElementsAre("t", "run_x", "run_y", "run_w"));
  EXPECT_EQ(table.values(3, 0), 4.0);
  EXPECT_EQ(table.values(3, 1), 4.0) << "the first two bytes of the word";
  for (const char* name : {"fs", "who", "cube", "z", "o", "none", "readme.txt"})
    EXPECT_THAT(table.notes, ::testing::Contains(::testing::HasSubstr(
                                 "'" + std::string(name) + "' is neither a vector")));
}

TEST(Npz, AWrongChecksumIsTold) {
  const std::string good = archive({{"t.npy", Vector::Ones(9)}}, false);
  EXPECT_NO_THROW(parse_npz(good, "a.npz"));
  const std::size_t number = good.find("PK\x01\x02") - 8;  // the last of the numbers
  for (std::size_t at = number; at < number + 8; ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    testing::expect_error<DataError>([&] { parse_npz(bad, "a.npz"); }, "a.npz",
                                     "'t.npy' is damaged: it is not what its checksum says",
                                     "numpy.savez");
  }
}

TEST(Npz, DamageIsTold) {
  const std::string good = archive({{"t.npy", Vector::Ones(9)}}, true);
  EXPECT_THROW(parse_npz("", "a.npz"), DataError);
  for (std::size_t size = 0; size + 22 < good.size(); size += 7)
    EXPECT_THROW(parse_npz(good.substr(0, size), "a.npz"), DataError) << size;
  std::string bad = good;
  for (std::size_t at = 40; at < 60; ++at) bad[at] = static_cast<char>(0x5A);
  EXPECT_THROW(parse_npz(bad, "a.npz"), DataError);
}

}  // namespace
}  // namespace lacuna
