// SPDX-License-Identifier: MIT
#include "core/files/zip_reader.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

TEST(ZipReader, EntriesAreThoseThatWereWritten) {
  const std::string bytes = testing::zip_archive({{"a.txt", "hello"}, {"b/c", ""}});
  const ZipArchive archive = open_zip(bytes, "a.zip", "save it again");
  ASSERT_EQ(archive.entries.size(), 2u);
  EXPECT_EQ(archive.entries[0].name, "a.txt");
  EXPECT_EQ(unpacked(archive, archive.entries[0], 5), "hello");
  EXPECT_EQ(find_entry(archive, "b/c"), &archive.entries[1]);
  EXPECT_EQ(find_entry(archive, "x"), nullptr);
}

TEST(ZipReader, LargeAndDamagedEntriesAreRefused) {
  const std::string bytes = testing::zip_archive({{"a.txt", "hello"}});
  const ZipArchive archive = open_zip(bytes, "a.zip", "save it again");
  expect_error<DataError>([&] { unpacked(archive, archive.entries[0], 4); }, "a.zip",
                          "'a.txt' has more than", "save it again");
  std::string changed = bytes;
  changed[changed.find("hello")] = 'j';
  const ZipArchive damaged = open_zip(changed, "a.zip", "save it again");
  expect_error<DataError>([&] { unpacked(damaged, damaged.entries[0], 5); }, "a.zip",
                          "not what its checksum says", "");
  ZipEntry bomb = archive.entries[0];
  bomb.method = 8;
  bomb.size = 1U << 28U;
  expect_error<DataError>([&] { unpacked(archive, bomb, 1U << 29U); }, "a.zip",
                          "cannot be as large", "");
}

TEST(ZipReader, EntriesThatShareBytesAreRefused) {
  // The second entry begins inside of the first one: its offset is the last number of its line
  // in the directory.
  std::string bytes = testing::zip_archive({{"a.txt", std::string(100, 'a')}, {"b.txt", "b"}});
  const std::size_t line = bytes.rfind("PK\x01\x02");
  for (const int begin : {0, 40}) {
    bytes.replace(line + 42, 4, testing::bytes_of({static_cast<std::uint64_t>(begin)}, 4));
    expect_error<DataError>([&] { open_zip(bytes, "a.zip", "save it again"); }, "a.zip",
                            "stand in the same bytes", "save it again");
  }
}

TEST(ZipReader, AnArchiveCutAnywhereIsRefused) {
  const std::string bytes = testing::zip_archive({{"a.txt", "hello"}});
  ASSERT_GT(bytes.size(), 22u);
  ASSERT_FALSE(bytes.empty());
  for (std::size_t size = 0; size + 22 < bytes.size(); ++size)
    EXPECT_THROW(open_zip(bytes.substr(0, size), "a.zip", ""), DataError) << size;
}

}  // namespace
}  // namespace lacuna
