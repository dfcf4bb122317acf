// SPDX-License-Identifier: MIT
// The reader of declarations on small pieces of code.
#include "repository/declarations.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace lacuna::repository {
namespace {

Declarations read(const std::string& code) {
  std::istringstream stream(code);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return read_declarations(lines);
}

FunctionText only_function(const std::string& code) {
  const Declarations found = read(code);
  EXPECT_EQ(found.functions.size(), 1u) << code;
  return found.functions.empty() ? FunctionText{} : found.functions.front();
}

TEST(Declarations, FunctionGoesFromItsTypeToItsLastBrace) {
  const FunctionText function = only_function(R"(
namespace a {
namespace {
std::vector<int> numbers(int first,
                         int last) {
  if (first < last) { return {}; }
  return {first};
}
}  // namespace
})");
  EXPECT_EQ(function.name, "numbers");
  EXPECT_EQ(function.owner, "");
  EXPECT_EQ(function.first, 4u);
  EXPECT_EQ(function.last, 8u);
  EXPECT_EQ(function.lines(), 5u);
  EXPECT_TRUE(function.has_body);
}

TEST(Declarations, BracesInCommentsAndLiteralsDoNotCount) {
  const FunctionText function = only_function(
      "#define OPEN {  \\\n  {\n"
      "int f() {  // {\n  /* { */ g(\"{\\\"{\", '{', R\"x({)\")x\", 1'000);\n}\n");
  EXPECT_EQ(function.first, 3u);
  EXPECT_EQ(function.last, 5u);
}

TEST(Declarations, FunctionsKnowTheirClassAndTheirAccess) {
  const Declarations found = read(R"(
class A : public B<int> {
  void hidden();
 public:
  explicit A(int x) : x_{x}, y_(x) { go(); }
  struct Inner { void shown() {} };
 private:
  int go() const { return x_; }
  int x_, y_ = 3;
};
template <int Size>
void Outer<Size>::Inner::run(int a) {
}
)");
  ASSERT_EQ(found.functions.size(), 5u);
  EXPECT_EQ(found.functions[0].name, "hidden");
  EXPECT_FALSE(found.functions[0].is_public);
  EXPECT_FALSE(found.functions[0].has_body);
  EXPECT_EQ(found.functions[1].name, "A");
  EXPECT_TRUE(found.functions[1].is_public);
  EXPECT_TRUE(found.functions[1].has_body);
  EXPECT_EQ(found.functions[2].owner, "A::Inner");
  EXPECT_FALSE(found.functions[3].is_public);
  EXPECT_EQ(found.functions[4].owner, "Outer::Inner");
  EXPECT_EQ(found.functions[4].name, "run");
  ASSERT_EQ(found.classes.size(), 2u);
  EXPECT_EQ(found.classes[0].name, "A");
}

TEST(Declarations, FunctionsSayWhatTheyAre) {
  EXPECT_TRUE(only_function("struct A { static A of(int a); };").is_static);
  EXPECT_TRUE(only_function("struct A { A(int) = delete; };").is_deleted);
  EXPECT_FALSE(only_function("struct A { A(int) = default; };").is_deleted);
  const Declarations found = read(R"(
template <class T> struct A { void f(T a); };
void g(int a);
template <class T> void h(T a) {}
class B { struct C { int d; void i(); }; int e; public: int f, g; };
)");
  ASSERT_EQ(found.functions.size(), 4u);
  EXPECT_TRUE(found.functions[0].is_template);
  EXPECT_FALSE(found.functions[1].is_template);
  EXPECT_TRUE(found.functions[2].is_template);
  EXPECT_FALSE(found.functions[3].is_public);
  ASSERT_EQ(found.classes.size(), 3u);
  EXPECT_FALSE(found.classes[2].is_public);
  ASSERT_EQ(found.classes[1].members.size(), 2u);
  EXPECT_EQ(found.classes[1].members[1].name, "g");
  EXPECT_EQ(found.classes[1].members[1].line, 5u);
}

TEST(Declarations, ABracketThatIsNotClosedIsAnError) {
  EXPECT_THROW(read("void f() {\n"), std::runtime_error);
}

}  // namespace
}  // namespace lacuna::repository
