// SPDX-License-Identifier: MIT
#include "core/files/atomic_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/files/byte_stream.hpp"
#include "core/files/file_bytes.hpp"
#include "core/files/near_file.hpp"
#include "core/files/positioned_file.hpp"
#include "core/files/temporary_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/disk_limits.hpp"
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

class NearFile : public ::testing::Test {
 protected:
  NearFile() {
    folder_.write("pendulum.ode", "dx/dt = 1\n");
    std::filesystem::create_directory(folder_.file("pendulum.od"));
  }

  std::string remedy(const std::string& name) const {
    return remedy_of_missing(folder_.file(name), "look");
  }

  testing::TemporaryFolder folder_;
  std::string wanted_ = "did you mean '" + folder_.file("pendulum.ode") + "'?";
};

TEST_F(NearFile, AFileOfTheFolderIsSuggested) {
  EXPECT_EQ(remedy("pendlum.ode"), wanted_);
  EXPECT_EQ(remedy("Pendulum.ode"), wanted_);
}

TEST_F(NearFile, NothingIsSuggestedForWhatIsThereOrFar) {
  for (const char* name : {"pendulum.ode", "scope.csv", "", "none/pendlum.ode"})
    EXPECT_EQ(remedy(name), "look") << name;
  EXPECT_EQ(remedy_of_missing("", "look"), "look");
  EXPECT_EQ(remedy(std::string(100000, 'x')), "look");
}

/// However a file is opened for reading.
TEST_F(NearFile, ErrorsOfReadersSuggestIt) {
  const std::string name = folder_.file("pendlum.ode");
  const auto remedy_of = [](const auto& open) {
    try {
      open();
    } catch (const FileError& error) {
      return error.remedy();
    }
    return std::string("no error");
  };
  EXPECT_EQ(remedy_of([&] { (void)read_text_file(name, "model file"); }), wanted_);
  EXPECT_EQ(remedy_of([&] { const ByteStream stream(name); }), wanted_);
  EXPECT_EQ(remedy_of([&] { const PositionedFile file(name); }), wanted_);
}

TEST(NearFileHere, APathWithoutAFolderIsOfThisOne) {
  const std::string name = "near_file_test_of_this_folder.csv";
  const testing::TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  folder.write(name, "");
  EXPECT_EQ(remedy_of_missing("near_file_test_of_this_foldr.csv", ""),
            "did you mean '" + name + "'?");
  std::filesystem::current_path(before);
}

std::string content_of(const PositionedFile& file) {
  std::string content(file.size(), '\0');
  file.read(0, content);
  return content;
}

TEST(TemporaryFile, HasNoNameAndLivesAsLongAsItsReader) {
  const TemporaryFolder folder;
  const testing::TemporaryFilesIn there(folder.path());
  std::optional<PositionedFile> reader;
  {
    TemporaryFile file;
    EXPECT_EQ(file.folder(), folder.path());
    EXPECT_TRUE(file.append(std::string("0123456789")));
    EXPECT_TRUE(file.append(std::string("abc")));
    file.replace_begin(std::string("xy"));
    EXPECT_EQ(file.size(), 13U);
    EXPECT_EQ(folder.count(), 0);
    reader.emplace(file.reader());
  }
  EXPECT_EQ(content_of(*reader), "xy23456789abc");
}

TEST(TemporaryFile, SaysWhereThereIsNoRoom) {
  const testing::FileSizeLimit limit(10);
  TemporaryFile file;
  EXPECT_TRUE(file.append(std::string("0123456")));
  EXPECT_FALSE(file.append(std::string("0123456")));
  EXPECT_EQ(file.size(), 10U);
}

TEST(TemporaryFile, NeedsAFolder) {
  const TemporaryFolder folder;
  const testing::TemporaryFilesIn nowhere(folder.file("none"));
  testing::expect_error<FileError>([] { TemporaryFile(); }, folder.file("none"),
                                   "no temporary file", "set TMPDIR");
}

}  // namespace
}  // namespace lacuna
