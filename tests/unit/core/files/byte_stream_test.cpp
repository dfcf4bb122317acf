// SPDX-License-Identifier: MIT
#include "core/files/byte_stream.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <string>
#include <thread>

#include "core/base/random.hpp"
#include "core/files/file_bytes.hpp"
#include "core/files/positioned_file.hpp"
#include "core/files/zip_reader.hpp"
#include "core/files/zip_writer.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;

/// More than one buffer of numbers in lines.
std::string numbered_lines() {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + "\n";
  return text;
}

/// All that comes, so many bytes at a time.
std::string read_in_parts(ByteStream& stream, std::size_t size) {
  std::string all, part(size, '\0');
  for (std::size_t count = size; count == size;) {
    count = stream.read(part);
    all.append(part, 0, count);
  }
  return all;
}

TEST(ByteStream, PartsOfAnySizeMakeUpTheFile) {
  const TemporaryFolder folder;
  const std::string text = numbered_lines();
  const std::string path = folder.write("a.txt", text), packed = folder.write("b", gzip(text));
  for (const std::size_t size : {999UL, 262144UL, 10000000UL})
    for (const std::string& file : {path, packed}) {
      ByteStream stream(file);
      EXPECT_EQ(stream.is_packed(), file == packed);
      EXPECT_EQ(read_in_parts(stream, size), text) << file << " by " << size;
      EXPECT_EQ(stream.fraction(), 1.0);
    }
}

TEST(ByteStream, MembersAreJoinedAndZerosBehindThemAreNothing) {
  const TemporaryFolder folder;
  const std::string text = numbered_lines();
  ByteStream stream(folder.write("a.gz", gzip(text) + gzip("end\n") + std::string(99, '\0')));
  EXPECT_EQ(read_in_parts(stream, 4096), text + "end\n");
}

TEST(ByteStream, WhatIsNotPackedBehindPackedDataIsTold) {
  const TemporaryFolder folder;
  const std::string text = numbered_lines();
  // Behind the member at once, behind zeros, and beyond the first buffer.
  for (const std::string& rest :
       {std::string("9,9\n"), std::string(99, '\0') + "9",
        std::string(std::size_t{1} << 20U, '\0') + "9", std::string("\x1f"), gzip("x") + "y"}) {
    const std::string path = folder.write("a.gz", gzip(text) + rest);
    const auto read = [&] {
      ByteStream stream(path);
      read_in_parts(stream, 4096);
    };
    testing::expect_error<DataError>(read, path, "behind the compressed data", "gzip -d");
  }
}

TEST(ByteStream, KnowsHowFarItIs) {
  const TemporaryFolder folder;
  ByteStream stream(folder.write("a.txt", std::string(1000, 'x')));
  EXPECT_EQ(stream.file_size(), 1000U);
  EXPECT_EQ(stream.fraction(), 0.0);
  std::string part(250, '\0');
  stream.read(part);
  EXPECT_EQ(stream.fraction(), 0.25);
  ByteStream empty(folder.write("empty", ""));
  EXPECT_EQ(empty.read(part), 0U);
  EXPECT_FALSE(empty.fraction());
}

TEST(ByteStream, APipeIsReadToItsEnd) {
  const TemporaryFolder folder;
  const std::string path = folder.file("pipe"), text = numbered_lines();
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << text; });
  ByteStream stream(path);
  EXPECT_EQ(read_in_parts(stream, 5000), text);
  EXPECT_FALSE(stream.file_size());
  EXPECT_FALSE(stream.fraction());
  writer.join();
}

TEST(ByteStream, SaysWhatCannotBeRead) {
  const TemporaryFolder folder;
  testing::expect_error<FileError>([&] { ByteStream(folder.file("none")); },
                                   folder.file("none"), "cannot be read", "check the name");
  testing::expect_error<FileError>([&] { ByteStream(folder.path()); }, folder.path().string(),
                                   "it is a folder", "*.csv");
  const std::string packed = gzip(numbered_lines());
  const std::string path = folder.write("cut.gz", packed.substr(0, packed.size() / 2));
  ByteStream stream(path);
  testing::expect_error<DataError>([&] { read_in_parts(stream, 4096); }, path,
                                   "damaged or cut short", "gzip -t");
}

/// Text that is longer than every buffer inside, packed and unpacked.
std::string long_text() {
  Random random(3);
  std::string text;
  for (int i = 0; i < 200000; ++i) text += static_cast<char>('0' + random.below(64));
  return text + std::string(3'000'000, 'x');
}

TEST(FileBytes, ReadsAFileWhole) {
  const TemporaryFolder folder;
  const std::string text = long_text();
  EXPECT_EQ(read_bytes(folder.write("a.txt", text)).view(), text);
  EXPECT_EQ(read_bytes(folder.write("empty", "")).view(), "");
}

TEST(FileBytes, UnpacksGzipByItsFirstBytes) {
  const TemporaryFolder folder;
  const std::string text = long_text();
  EXPECT_EQ(read_bytes(folder.write("a.txt", gzip(text))).view(), text);
}

TEST(Gzip, JoinsMembers) {
  EXPECT_EQ(gunzip(gzip("first\n") + gzip("second\n"), "a.gz").view(), "first\nsecond\n");
}

TEST(Gzip, IgnoresPaddingBehindTheLastMember) {
  EXPECT_EQ(gunzip(gzip("text") + std::string(512, '\0'), "a.gz").view(), "text");
}

TEST(Gzip, ReportsWhatIsCutShortOrDamaged) {
  const std::string packed = gzip(long_text());
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  for (const std::string& bytes : {packed.substr(0, packed.size() / 2), damaged})
    expect_error<DataError>([&] { gunzip(bytes, "a.gz"); }, "a.gz", "damaged or cut short",
                            "again");
}

TEST(FileBytes, ATextThatSomebodyWroteHasABound) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(read_text_file(folder.write("a.ode", "dx/dt = 1\n"), "model file"), "dx/dt = 1\n");
  EXPECT_EQ(read_text_file(folder.write("empty", ""), "model file"), "");
  testing::expect_error<FileError>([] { read_text_file("/dev/zero", "model file"); },
                                   "/dev/zero", "the model file is larger than 64 MiB",
                                   "right file");
  testing::expect_error<FileError>([&] { read_text_file(folder.file("no"), "configuration"); },
                                   folder.file("no"), "the configuration cannot be read",
                                   "exists");
  EXPECT_THROW(read_text_file(folder.file(""), "model file"), FileError);
}

TEST(PositionedFile, ReadsAnywhere) {
  const testing::TemporaryFolder folder;
  const PositionedFile file(folder.write("a", "0123456789"));
  EXPECT_EQ(file.size(), 10U);
  std::array<char, 3> part{};
  file.read(7, part);
  EXPECT_EQ(std::string(part.data(), 3), "789");
  file.read(0, part);
  EXPECT_EQ(std::string(part.data(), 3), "012");
}

TEST(PositionedFile, SaysWhatCannotBeRead) {
  const testing::TemporaryFolder folder;
  std::array<char, 3> part{};
  EXPECT_THROW(PositionedFile(folder.write("a", "01")).read(0, part), FileError);
  EXPECT_THROW(PositionedFile(folder.file("none")), FileError);
  EXPECT_THROW(PositionedFile(folder.path()), FileError);
}

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

TEST(ZipWriter, OtherProgramsReadIt) {
  const std::string python = testing::python_with("zipfile");
  if (python.empty()) GTEST_SKIP() << "there is no Python";
  const testing::TemporaryFolder folder;
  const std::string path =
      folder.write("a.zip", zip_of({{"one.txt", "12"}, {"in/two.txt", ""}, {"3", "777"}}));
  const std::string script =
      folder.write("read.py",
                   "import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1])\n"
                   "assert z.testzip() is None\n"
                   "assert z.namelist() == ['one.txt', 'in/two.txt', '3']\n"
                   "print(z.read('one.txt').decode(), len(z.read('in/two.txt')))\n"
                   "print(int(z.read('3')))\n");
  EXPECT_EQ(testing::printed_numbers(python + " " + script + " " + path),
            (std::vector<double>{12.0, 0.0, 777.0}));
}

}  // namespace
}  // namespace lacuna
