// SPDX-License-Identifier: MIT
#include "identify/forms_beside/form_rows.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lacuna {
namespace {

/// Columns of 1, 2, ... of what is made, whose names are noted.
struct Counter {
  std::vector<std::string> made;

  Matrix operator()(const std::vector<Expression>& forms) {
    Matrix columns(3, static_cast<Index>(forms.size()));
    for (Index j = 0; j < columns.cols(); ++j) {
      made.push_back(forms[static_cast<std::size_t>(j)].to_string());
      columns.col(j).setConstant(static_cast<double>(made.size()));
    }
    return columns;
  }
};

std::vector<Expression> forms_of(const std::vector<std::string>& texts) {
  std::vector<Expression> forms;
  for (const std::string& text : texts) forms.push_back(parse_expression(text));
  return forms;
}

TEST(ColumnMemory, MakesAColumnOnce) {
  const ColumnMemory memory;
  Counter counter;
  EXPECT_EQ(memory.columns(forms_of({"sin(x)", "x^2"}), 3, counter).row(0),
            (Matrix(1, 2) << 1.0, 2.0).finished());
  EXPECT_EQ(memory.columns(forms_of({"x^2", "exp(x)", "sin(x)"}), 3, counter).row(0),
            (Matrix(1, 3) << 2.0, 3.0, 1.0).finished());
  EXPECT_EQ(counter.made, (std::vector<std::string>{"sin(x)", "x^2", "exp(x)"}));
}

TEST(ColumnMemory, MakesAgainWhatHasNoRoom) {
  const ColumnMemory memory(3);
  Counter counter;
  memory.columns(forms_of({"sin(x)", "x^2"}), 3, counter);
  EXPECT_EQ(memory.columns(forms_of({"sin(x)", "x^2"}), 3, counter).row(0),
            (Matrix(1, 2) << 1.0, 3.0).finished());
}

}  // namespace
}  // namespace lacuna
