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

int members_of(const std::string& code) {
  const Declarations found = read(code);
  EXPECT_EQ(found.classes.size(), 1u) << code;
  return found.classes.empty() ? -1 : found.classes.front().mutable_members;
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

TEST(Declarations, LocalClassesAndLambdasBelongToTheirFunction) {
  const Declarations found =
      read("void f() {\n  struct A { int x; void g() {} };\n  auto h = [](int a) { };\n}\n");
  EXPECT_EQ(found.functions.size(), 1u);
  EXPECT_TRUE(found.classes.empty());
}

TEST(Declarations, ParametersAreCountedThroughBrackets) {
  EXPECT_EQ(only_function("void f();").parameters, 0);
  EXPECT_EQ(only_function("void f(std::map<int, int> a, int b = g(1, 2));").parameters, 2);
  EXPECT_EQ(only_function("void f(std::function<void(int, int)> a, B b = {1, 2});").parameters,
            2);
  EXPECT_EQ(only_function("decltype(auto) f(int a, int (*b)(int, int), int c);").parameters, 3);
  EXPECT_EQ(only_function("std::function<int(int, int)> f(int a) noexcept(true);").parameters,
            1);
  EXPECT_EQ(only_function("template <class A, class B = C<A>>\nA f(A a, B b);").parameters, 2);
}

TEST(Declarations, OperatorsHaveNamesToo) {
  EXPECT_EQ(only_function("bool operator<(const A& a, const A& b);").parameters, 2);
  EXPECT_EQ(only_function("struct A { void operator()(int, int) const {} };").parameters, 2);
  EXPECT_EQ(only_function("struct A { A& operator=(const A&) = default; };").parameters, 1);
  EXPECT_EQ(only_function("struct A { bool operator==(const A& a) const; };").name,
            "operator==");
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
  EXPECT_EQ(found.classes[0].mutable_members, 2);
}

TEST(Declarations, ConstructorWithManyInitialisersIsOneFunction) {
  const FunctionText function = only_function(
      "struct A {\n  A(int x, int y)\n      : a_{x},\n        b_{y, y},\n        c_(y) {\n"
      "    go();\n  }\n};\n");
  EXPECT_EQ(function.first, 2u);
  EXPECT_EQ(function.last, 7u);
}

TEST(Declarations, ParametersHaveTypesAsTheyAreWritten) {
  const auto types = [](const std::string& code) { return only_function(code).types; };
  using Types = std::vector<std::string>;
  EXPECT_EQ(types("void f();"), Types{});
  EXPECT_EQ(types("void f(const Matrix& a, std::span<const double> b = {}, Index = 1 << 2);"),
            (Types{"const Matrix&", "std::span<const double>", "Index"}));
  EXPECT_EQ(types("void f(std::map<int, int> a, const std::function<void(int, int)>&);"),
            (Types{"std::map<int, int>", "const std::function<void(int, int)>&"}));
  EXPECT_EQ(types("void f(const std::vector<Index>&\n     numbers, double* out);"),
            (Types{"const std::vector<Index>&", "double*"}));
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

TEST(Declarations, OnlyMembersThatCanChangeCount) {
  EXPECT_EQ(members_of("struct A { int a; const int b = 1; int& c; const int& d; };"), 1);
  EXPECT_EQ(members_of("struct A { const int* a; static int b; mutable int c = f(1); };"), 2);
  EXPECT_EQ(members_of("struct A { std::map<int, int> a, b{1, 2}; int c[2], d = 1, e; };"), 5);
  EXPECT_EQ(members_of("struct A { std::function<void(int)> a; void b(); using C = D; };"), 1);
  EXPECT_EQ(members_of("struct A { friend struct B; enum class C { d, e }; C f; };"), 1);
}

TEST(Declarations, VariablesAreNoFunctions) {
  EXPECT_TRUE(read("const int a = f(1);\nstd::vector<int> b{1, 2};\n").functions.empty());
  EXPECT_TRUE(read("const auto f = [](int a) {\n  return a;\n};\n").functions.empty());
  EXPECT_TRUE(read("enum class A { b, c };\nusing F = void(int, int);\n").functions.empty());
}

TEST(Declarations, ABracketThatIsNotClosedIsAnError) {
  EXPECT_THROW(read("void f() {\n"), std::runtime_error);
}

}  // namespace
}  // namespace lacuna::repository
