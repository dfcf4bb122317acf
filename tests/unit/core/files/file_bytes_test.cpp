// SPDX-License-Identifier: MIT
#include "core/files/file_bytes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;

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

}  // namespace
}  // namespace lacuna
