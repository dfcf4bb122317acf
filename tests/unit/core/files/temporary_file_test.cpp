// SPDX-License-Identifier: MIT
#include "core/files/temporary_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "support/disk_limits.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

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
