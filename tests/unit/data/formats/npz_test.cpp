// SPDX-License-Identifier: MIT
#include "data/formats/npz.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

std::string little(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
  return text;
}

std::string deflated(const std::string& content) {
  std::string packed(content.size() + 100, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// An archive as zip has it (APPNOTE 6.3.9, sections 4.3.7, 4.3.12, 4.3.16).
std::string archive(const std::vector<std::pair<std::string, Matrix>>& arrays, bool pack) {
  std::string files, directory;
  for (const auto& [name, values] : arrays) {
    const testing::TemporaryFolder folder;
    write_npy(folder.file("a.npy"), values);
    const std::string content = folder.read("a.npy");
    const std::string stored = pack ? deflated(content) : content;
    const std::string common = little(pack ? 8 : 0, 2) + little(0, 8) +
                               little(stored.size(), 4) + little(content.size(), 4) +
                               little(name.size(), 2);
    directory += "PK\x01\x02" + little(20, 2) + little(20, 2) + little(0, 2) + common +
                 little(0, 2) + little(0, 2) + little(0, 8) + little(files.size(), 4) + name;
    files +=
        "PK\x03\x04" + little(20, 2) + little(0, 2) + common + little(0, 2) + name + stored;
  }
  return files + directory + "PK\x05\x06" + little(0, 4) + little(arrays.size(), 2) +
         little(arrays.size(), 2) + little(directory.size(), 4) + little(files.size(), 4) +
         little(0, 2);
}

TEST(Npz, ArraysAreColumns) {
  const Vector t = Vector::LinSpaced(50, 0.0, 1.0);
  const Matrix x = Matrix::Random(50, 2);
  for (const bool pack : {false, true}) {
    const Table table = parse_npz(
        archive({{"t.npy", t}, {"x.npy", x}, {"note.npy", Vector::Ones(1)}}, pack), "a.npz");
    ASSERT_EQ(table.columns.size(), 3u);
    EXPECT_EQ(table.columns[0].name, "t");
    EXPECT_EQ(table.columns[2].name, "x2");
    EXPECT_EQ(table.values.col(0), t);
    EXPECT_EQ(table.values.rightCols(2), x);
    EXPECT_THAT(table.notes.at(0),
                ::testing::HasSubstr("'note' has 1 x 1 values, not 50 samples"));
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
