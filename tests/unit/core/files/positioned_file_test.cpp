// SPDX-License-Identifier: MIT
#include "core/files/positioned_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
