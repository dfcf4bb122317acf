// SPDX-License-Identifier: MIT
#include "core/files/near_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/files/byte_stream.hpp"
#include "core/files/file_bytes.hpp"
#include "core/files/positioned_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
