// SPDX-License-Identifier: MIT
#include "data/formats/row_blocks.hpp"

#include <gtest/gtest.h>

#include "core/files/file_bytes.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

TEST(OpenedFile, IsOfAKind) {
  const TemporaryFolder folder;
  const auto kind = [&](const std::string& name, const std::string& bytes) {
    return OpenedFile(folder.write(name, bytes)).kind;
  };
  EXPECT_EQ(kind("a.csv", "t,x\n0,1\n"), FileKind::Text);
  EXPECT_EQ(kind("a.csv.gz", gzip("t,x\n0,1\n")), FileKind::Text);
  EXPECT_EQ(kind("a.npz", "PK\x03\x04"), FileKind::Npz);
  EXPECT_EQ(kind("a.h5", "\x89HDF\r\n\x1a\n"), FileKind::Hdf5);
  EXPECT_EQ(kind("a.bin", gzip("\x93NUMPY")), FileKind::Npy);
  EXPECT_TRUE(OpenedFile(folder.file("a.csv")).has_places());
  EXPECT_FALSE(OpenedFile(folder.file("a.csv.gz")).has_places());
  testing::expect_error<DataError>([&] { kind("a.pdf", "%PDF-1.7"); }, folder.file("a.pdf"),
                                   "a PDF document", "numbers");
}

TEST(RowBlocks, SayWhatCannotBeReadInPieces) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& bytes,
                           const std::string& remedy) {
    const std::string path = folder.write(name, bytes);
    testing::expect_error<DataError>(
        [&] { row_blocks(std::make_unique<OpenedFile>(path), 1U << 24U); }, path,
        "cannot be read in pieces", remedy + ", or leave out --memory");
  };
  refused("a.npz", "PK\x03\x04", "one .npy array");
  refused("a.npy.gz", gzip("\x93NUMPY"), "unpack it and give its name");
  refused("a.h5.gz", gzip("\x89HDF\r\n\x1a\n"), "unpack it and give its name");
  std::string mat(128, ' ');
  mat.replace(124, 4, std::string_view("\0\1IM", 4));
  refused("a.mat", mat, "save it with '-v7.3'");
}

TEST(RowBlocks, TakeAFractionOfTheMemory) {
  const BlockSizes small = block_sizes(1U << 24U), large = block_sizes(std::size_t{1} << 34U);
  EXPECT_EQ(small.block, std::size_t{1} << 19U);
  EXPECT_EQ(large.block, std::size_t{1} << 22U);
  EXPECT_EQ(large.longest, std::size_t{1} << 30U);
}

}  // namespace
}  // namespace lacuna
