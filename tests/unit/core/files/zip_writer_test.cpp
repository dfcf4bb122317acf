// SPDX-License-Identifier: MIT
#include "core/files/zip_writer.hpp"

#include <gtest/gtest.h>

#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

TEST(ZipWriter, OtherProgramsReadIt) {
  const std::string python = testing::python_with("zipfile");
  if (python.empty()) GTEST_SKIP() << "there is no Python";
  const testing::TemporaryFolder folder;
  const std::string path =
      folder.write("a.zip", zip_of({{"one.txt", "12"}, {"in/two.txt", ""}, {"3", "777"}}));
  const std::string script = folder.write(
      "read.py", "import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1])\n"
                 "assert z.testzip() is None\n"
                 "assert z.namelist() == ['one.txt', 'in/two.txt', '3']\n"
                 "print(z.read('one.txt').decode(), len(z.read('in/two.txt')))\n"
                 "print(int(z.read('3')))\n");
  EXPECT_EQ(testing::printed_numbers(python + " " + script + " " + path),
            (std::vector<double>{12.0, 0.0, 777.0}));
}

}  // namespace
}  // namespace lacuna
