// SPDX-License-Identifier: MIT
#include "core/files/atomic_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;

TEST(AtomicFile, WritesEveryByteAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string content("a\0b\r\n", 5);
  write_file_atomically(folder.file("out.bin"), content);
  EXPECT_EQ(folder.read("out.bin"), content);
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, ReplacesAFile) {
  const TemporaryFolder folder;
  folder.write("out.txt", "a long old content");
  write_file_atomically(folder.file("out.txt"), "new");
  EXPECT_EQ(folder.read("out.txt"), "new");
}

TEST(AtomicFile, FollowsALink) {
  const TemporaryFolder folder;
  folder.write("target.txt", "old");
  std::filesystem::create_symlink("target.txt", folder.file("link.txt"));
  write_file_atomically(folder.file("link.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
  EXPECT_EQ(folder.read("target.txt"), "new");
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const std::string path = folder.write("secret.txt", "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(path, "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(folder.read("secret.txt"), "new");
}

TEST(AtomicFile, ALinkToNothingBringsItsTargetIntoBeing) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("sub"));
  std::filesystem::create_symlink("sub/target.txt", folder.file("first"));
  std::filesystem::create_symlink("first", folder.file("second"));
  write_file_atomically(folder.file("second"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("first")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("second")));
  EXPECT_EQ(folder.read("sub/target.txt"), "new");
}

TEST(AtomicFile, ACircleOfLinksIsAnError) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("b", folder.file("a"));
  std::filesystem::create_symlink("a", folder.file("b"));
  expect_error<FileError>([&] { write_file_atomically(folder.file("a"), "x"); },
                          folder.file("a"), "circle", "");
  EXPECT_EQ(folder.count(), 2);
}

TEST(AtomicFile, WritesToADevice) {
  EXPECT_NO_THROW(write_file_atomically("/dev/null", "gone"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, NamesAFolderThatIsMissing) {
  const TemporaryFolder folder;
  const std::string path = folder.file("missing/out.txt");
  expect_error<FileError>([&] { write_file_atomically(path, "x"); }, path, "cannot be written",
                          "folder exists");
}

TEST(AtomicFile, DoesNotReplaceAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("sub"));
  expect_error<FileError>([&] { write_file_atomically(folder.file("sub"), "x"); },
                          folder.file("sub"), "it is a folder", "");
  EXPECT_EQ(folder.count(), 1);
}

TEST(CheckWritable, TriesWithoutLeavingAnything) {
  const TemporaryFolder folder;
  const std::string there = folder.write("there.txt", "old");
  check_writable(there);
  check_writable(folder.file("new.txt"));
  check_writable("/dev/null");
  EXPECT_EQ(folder.count(), 1);
  EXPECT_EQ(folder.read("there.txt"), "old");
  for (const std::string& place :
       {folder.file("none/new.txt"), folder.file("."), there + "/new.txt", std::string()})
    EXPECT_THROW(check_writable(place), FileError) << place;
}

TEST(WrittenFile, IsBehindItsLinks) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("second", folder.file("first"));
  std::filesystem::create_symlink("new.txt", folder.file("second"));
  EXPECT_EQ(written_file(folder.file("first")), folder.file("new.txt"));
  EXPECT_EQ(written_file(folder.file("other")), folder.file("other"));
}

}  // namespace
}  // namespace lacuna
