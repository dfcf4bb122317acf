// SPDX-License-Identifier: MIT
#include "core/files/byte_stream.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <thread>

#include "core/files/file_bytes.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
