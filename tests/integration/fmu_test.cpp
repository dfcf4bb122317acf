// SPDX-License-Identifier: MIT
// Exported FMUs, loaded as importing programs do.
#include <dlfcn.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// Files of an archive that holds them uncompressed.
std::map<std::string, std::string> stored_files(const std::string& archive) {
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::size_t value = 0;
    for (std::size_t i = bytes; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(archive[at + i]);
    return value;
  };
  std::map<std::string, std::string> files;
  for (std::size_t at = 0; archive.compare(at, 4, "PK\x03\x04") == 0;) {
    const std::size_t size = number(at + 18, 4), length = number(at + 26, 2);
    files[archive.substr(at + 30, length)] = archive.substr(at + 30 + length, size);
    at += 30 + length + size;
  }
  return files;
}

/// The functions of FMI 2.0 that a run takes.
class Fmu {
 public:
  Fmu(const std::string& library, std::string guid)
      : handle_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)), guid_(std::move(guid)) {}
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;
  ~Fmu() {
    if (handle_ != nullptr) dlclose(handle_);
  }

  bool loaded() const { return handle_ != nullptr; }

  void* instance(const std::string& guid) const {
    return function<void*(const char*, int, const char*, const char*, const void*, int, int)>(
        "fmi2Instantiate")("run", 1, guid.c_str(), "", nullptr, 0, 0);
  }
  void* instance() const { return instance(guid_); }
  void free(void* it) const { function<void(void*)>("fmi2FreeInstance")(it); }

  int set(void* it, unsigned reference, double value) const {
    return function<int(void*, const unsigned*, std::size_t, const double*)>("fmi2SetReal")(
        it, &reference, 1, &value);
  }
  int get(void* it, unsigned reference, double& value) const {
    return function<int(void*, const unsigned*, std::size_t, double*)>("fmi2GetReal")(
        it, &reference, 1, &value);
  }
  int step(void* it, double time, double size) const {
    return function<int(void*, double, double, int)>("fmi2DoStep")(it, time, size, 1);
  }

 private:
  template <class Signature>
  Signature* function(const char* name) const {
    return reinterpret_cast<Signature*>(dlsym(handle_, name));
  }

  void* handle_;
  std::string guid_;
};

std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      rows.back().push_back(std::stod(cell));
  }
  return rows;
}

struct FmuCase {
  std::string name, model, start;
  std::optional<double> input = {};  ///< held; its reference follows those of the states
  std::vector<unsigned> columns;     ///< value references of what `simulate` writes before inputs
};

std::vector<FmuCase> fmu_cases() {
  return {{"lorenz",
           "dx/dt = 10*(y-x)\ndy/dt = x*(28-z) - y\ndz/dt = x*y - 8/3*z\n"
           "initial x = 1\ninitial y = 1\ninitial z = 20\n",
           "1,1,20",
           {},
           {0, 1, 2}},
          {"tanks",
           "input u [V] hold zero\nparam k1 = 0.5 [1/s] in 0..1\nparam k4 = 0.25 fixed\n"
           "dx1/dt = -k1*sqrt(x1) + k4*u\ndx2/dt = k1*sqrt(x1) - 0.3*sqrt(x2)\n"
           "y = 3*x2 + x1^2 [V]\ninitial x1 = 1\ninitial x2 = 0.5 fixed\n",
           "1,0.5",
           2.0,
           {0, 1, 5}},
          {"pendulum",
           "input u hold zero\ndth/dt = w\ndw/dt = -19.62*sin(th) - 0.15*w + u\n"
           "initial th = 2\ninitial w = 0\n",
           "2,0",
           0.7,
           {0, 1}},
          {"stiff",
           "param m = 30\nda/dt = b\ndb/dt = m*(1-a^2)*b - a\nsum = a + b\n"
           "initial a = 2\ninitial b = 0\n",
           "2,0",
           {},
           {0, 1, 3}}};
}

/// Exports the model and compares a run of the FMU with `lacuna simulate`.
void expect_same_run(const FmuCase& one) {
  const TemporaryFolder place;
  const std::string model = place.write("m.ode", one.model), fmu = place.file("m.fmu");
  const CommandResult written = run_program_well("export " + model + " --format fmu -o " + fmu);
  std::string inputs;
  if (one.input)
    inputs = " --input-data " +
             place.write("u.csv", "t,u\n0," + std::to_string(*one.input) + "\n9," +
                                      std::to_string(*one.input) + "\n");
  run_program_well("simulate " + model + " --x0 " + one.start + inputs +
                   " --t-end 2 --dt 0.1 --integrator dopri87 -o " + place.file("run.csv"));
  const auto files = stored_files(place.read("m.fmu"));
  ASSERT_TRUE(files.contains("modelDescription.xml"));
  ASSERT_TRUE(files.contains("sources/lacuna_model.c"));
  std::smatch guid;
  ASSERT_TRUE(std::regex_search(files.at("modelDescription.xml"), guid,
                                std::regex("guid=\"([^\"]*)\"")));
  const Fmu library(place.write("m.so", files.at("binaries/linux64/lacuna_model.so")), guid[1]);
  ASSERT_TRUE(library.loaded()) << dlerror();
  EXPECT_EQ(library.instance("{another}"), nullptr);
  void* it = library.instance();
  ASSERT_NE(it, nullptr);
  const auto states =
      static_cast<unsigned>(std::count(one.start.begin(), one.start.end(), ',') + 1);
  if (one.input) {
    EXPECT_EQ(library.set(it, states, *one.input), 0);
  }
  const auto rows = rows_of(place.read("run.csv"));
  ASSERT_EQ(rows.size(), 21u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), one.columns.size() + (one.input ? 2 : 1)) << one.name;
    for (std::size_t c = 0; c < one.columns.size(); ++c) {
      double value = NAN;
      EXPECT_EQ(library.get(it, one.columns[c], value), 0);
      EXPECT_NEAR(value, rows[i][c + 1], 1e-8 * (1.0 + std::abs(rows[i][c + 1])))
          << one.name << " at " << rows[i][0] << ", column " << c + 1;
    }
    EXPECT_EQ(library.step(it, rows[i][0], 0.1), 0);
  }
  double none = 0.0;
  EXPECT_NE(library.get(it, 99, none), 0);
  library.free(it);
}

TEST(Fmu, RunsAsSimulateDoes) {
  ASSERT_EQ(fmu_cases().size(), 4u);
  for (const FmuCase& one : fmu_cases()) expect_same_run(one);
}

TEST(Fmu, ParametersOfAnInstanceAreItsOwn) {
  const TemporaryFolder place;
  const std::string model = place.write("m.ode", "param k = 1\ndx/dt = -k*x\ninitial x = 1\n");
  run_program_well("export " + model + " --format fmu -o " + place.file("m.fmu"));
  const auto files = stored_files(place.read("m.fmu"));
  std::smatch guid;
  const std::string description = files.at("modelDescription.xml");
  ASSERT_TRUE(std::regex_search(description, guid, std::regex("guid=\"([^\"]*)\"")));
  EXPECT_THAT(description, ::testing::HasSubstr("name=\"k\" valueReference=\"1\" "
                                                "causality=\"parameter\" variability=\"tunable\""));
  const Fmu library(place.write("m.so", files.at("binaries/linux64/lacuna_model.so")), guid[1]);
  ASSERT_TRUE(library.loaded());
  void *slow = library.instance(), *fast = library.instance();
  ASSERT_NE(fast, nullptr);
  EXPECT_EQ(library.set(fast, 1, 3.0), 0);
  for (void* it : {slow, fast}) EXPECT_EQ(library.step(it, 0.0, 1.0), 0);
  double x = 0.0;
  library.get(slow, 0, x);
  EXPECT_NEAR(x, std::exp(-1.0), 1e-10);
  library.get(fast, 0, x);
  EXPECT_NEAR(x, std::exp(-3.0), 1e-10);
  library.free(slow), library.free(fast);
}

TEST(Fmu, WhatCannotBeWrittenIsAnError) {
  const TemporaryFolder place;
  expect_program_error("export lorenz --format fmu", 2, {"--format fmu", "-o model.fmu"});
  const std::string delayed = place.write("d.ode", "dx/dt = -delay(x,1)\n");
  expect_program_error("export " + delayed + " --format fmu -o " + place.file("d.fmu"), 2,
                       {"no delay"});
  const std::string call = "export lorenz --format fmu -o " + place.file("l.fmu");
  const CommandResult without = run_program(call, "CC=/no/compiler");
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, ::testing::HasSubstr("the C compiler '/no/compiler' made no library"));
  EXPECT_EQ(place.read("d.fmu") + place.read("l.fmu"), "");
}

TEST(Fmu, AnInterruptLeavesNothing) {
  const TemporaryFolder place;
  const std::string compiler = place.write("cc.sh", "#!/bin/sh\nkill -INT $PPID\nsleep 60\n");
  std::filesystem::permissions(compiler, std::filesystem::perms::owner_all);
  std::filesystem::create_directory(place.file("tmp"));
  const CommandResult ended =
      run_program("export lorenz --format fmu -o " + place.file("l.fmu"),
                  "TMPDIR=" + place.file("tmp") + " CC=" + compiler);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_TRUE(std::filesystem::is_empty(place.file("tmp")));
  EXPECT_FALSE(std::filesystem::exists(place.file("l.fmu")));
}

}  // namespace
}  // namespace lacuna::testing
