// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/npy.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "regression/formulations/next_sample.hpp"
#include "solvers/ols.hpp"
#include "support/expect_error.hpp"
#include "support/maps.hpp"
#include "support/temporary_folder.hpp"
#include "support/thread_team.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using testing::long_oscillation;
using testing::TemporaryFolder;

ColumnRoles first_is_time() {
  ColumnRoles roles;
  roles.names = {{"t", "1"}, {"x", "2"}, {"v", "3"}};
  return roles;
}

std::string saved(const TemporaryFolder& folder, const std::string& name,
                  const Matrix& values) {
  const std::string path = folder.file(name);
  write_npy(path, values);
  return path;
}

/// Time and states of Lorenz' system with a little noise.
Matrix lorenz_table(Index samples) {
  const OdeModel model = test_system("lorenz").model;
  const Vector time = sample_times(0.0, 0.002, samples);
  const Solution orbit = simulate(model, Rk4{}, Vector::Ones(3), time);
  Random random(5);
  Matrix values(samples, 4);
  values << time, orbit.states;
  for (double& value : values.rightCols(3).reshaped()) value += 0.01 * random.normal();
  return values;
}

TEST(ReadStream, ModelsAreTheSameToTheBitAsFromMemory) {
  const TemporaryFolder folder;
  const std::string path = saved(folder, "long.npy", lorenz_table(200000));
  ColumnRoles roles;
  roles.names = {{"t", "1"}, {"x", "2"}, {"y", "3"}, {"z", "4"}};
  const Dataset data = read_dataset({path}, roles);
  const Pipeline pipeline = preset("algorithm1");
  RunContext two;
  two.threads = 2;
  const RecordStream stream = read_stream({path}, roles, two);
  ASSERT_TRUE(stream.is_long());
  EXPECT_EQ(stream.in_memory(), nullptr);
  EXPECT_EQ(stream.samples(), 200000);
  const OdeModel streamed = identify(stream, pipeline, two).model;
  EXPECT_EQ(format_model(streamed), format_model(identify(data, pipeline).model));
  EXPECT_NEAR(streamed.coefficient(1, "x*z"), -1.0, 1e-3);
}

TEST(ReadStream, ATeamFindsTheSameToTheBit) {
  const TemporaryFolder folder;
  Matrix values = lorenz_table(200000);
  values(150000, 2) = std::numeric_limits<double>::quiet_NaN();
  const std::string path = saved(folder, "long.npy", values);
  ColumnRoles roles;
  roles.names = {{"t", "1"}, {"x", "2"}, {"y", "3"}, {"z", "4"}};
  const Pipeline pipeline = preset("algorithm1");
  const RecordStream alone = read_stream({path}, roles);
  const std::string expected = format_model(identify(alone, pipeline).model);
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    const RecordStream stream = read_stream({path}, roles, context);
    EXPECT_EQ(stream.records().size(), 2U);
    EXPECT_EQ(stream.excerpt().notes, alone.excerpt().notes);
    const OdeModel model = identify(stream, pipeline, context).model;
    if (context.leads()) {
      EXPECT_EQ(format_model(model), expected);
    }
  });
}

TEST(ReadStream, ASlowMapIsNotThinned) {
  // A turn by 2 pi / 200 000 in each step.
  const double turn = 2.0 * std::acos(-1.0) / 2e5;
  const auto rotated = [&](const Vector& x) {
    return Vector{{std::cos(turn) * x[0] - std::sin(turn) * x[1],
                   std::sin(turn) * x[0] + std::cos(turn) * x[1]}};
  };
  const Dataset data = testing::orbit_of_map(rotated, Vector{{1.0, 0.0}}, 300000);
  ASSERT_GT(RecordStream(data).excerpt().notes.size(), 0U) << "a flow would be thinned";
  Pipeline pipeline = preset("sindy");
  pipeline.basis = Monomials{{.max_degree = 1}};
  pipeline.formulation = NextSample{};
  pipeline.regressor = Ols{};
  const OdeModel model = identify(data, pipeline).model;
  EXPECT_NEAR(model.coefficient(1, "x"), std::sin(turn), 1e-9);
  const TemporaryFolder folder;
  const std::string path = saved(folder, "map.npy", data.trajectories[0].states);
  ColumnRoles roles;
  roles.step = 1.0;
  EXPECT_THROW(identify(read_stream({path}, roles), pipeline), ConfigError);
}

TEST(ReadStream, AStepStandsForTheTime) {
  const TemporaryFolder folder;
  const std::string path =
      saved(folder, "a.npy", long_oscillation(150000, 97.3).trajectories[0].states);
  ColumnRoles roles;
  roles.step = 0.01;
  const RecordStream stream = read_stream({path}, roles);
  EXPECT_DOUBLE_EQ(stream.records()[0]->read(140000, 2).time[1], 1400.01);
}

TEST(ReadStream, DerivativesOfOtherColumnsAreNoStates) {
  const TemporaryFolder folder;
  Matrix values(3000, 3);
  values.col(0) = Vector::LinSpaced(3000, 0.0, 3.0);
  values.col(1) = (-values.col(0)).array().exp();
  values.col(2) = -values.col(1);
  const std::string path = saved(folder, "decay.npy", values);
  ColumnRoles roles;
  roles.names = {{"t", "1"}, {"x", "2"}, {"dx", "3"}};
  const Dataset pieces = read_stream({path}, roles).excerpt(), whole = read_dataset({path}, roles);
  EXPECT_EQ(names_of(pieces.states), std::vector<std::string>{"x"});
  EXPECT_EQ(pieces.notes, whole.notes);
  roles.states = {"x", "dx"};
  EXPECT_EQ(read_stream({path}, roles).excerpt().state_count(), 2);
}

TEST(ReadStream, RefusesOtherFilesAndOtherColumns) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("a.npz")) << "PK";
  testing::expect_error<DataError>([&] { read_stream({folder.file("a.npz")}); },
                                   folder.file("a.npz"), "in pieces", "--memory");
  testing::expect_error<FileError>([&] { read_stream({folder.file("none.npy")}); },
                                   folder.file("none.npy"), "cannot be read", "name");
  saved(folder, "1.npy", Matrix::Random(10, 3));
  saved(folder, "2.npy", Matrix::Random(10, 4));
  ColumnRoles step;
  step.step = 0.1;
  testing::expect_error<DataError>([&] { read_stream({folder.file("?.npy")}, step); },
                                   folder.file("2.npy"), "columns", "same columns");
}

/// Time, states and exact derivatives of an oscillation.
Matrix oscillation_with_rates(Index samples) {
  const Matrix values = testing::table_of(long_oscillation(samples, 97.3));
  const double w = 2.0 * std::acos(-1.0) / 0.973;
  Matrix table(samples, 5);
  table << values, values.col(2), -w * w * values.col(1);
  return table;
}

/// What comes out of records that are read with one pass less, and how often it was begun.
struct Tried {
  std::string model;
  std::size_t records = 0;
  std::vector<std::string> notes;
  int times = 0;
};

Tried tried(const std::string& path, const ColumnRoles& roles, const Pipeline& pipeline) {
  Tried tried;
  const auto use = [&](RecordStream stream) {
    ++tried.times;
    tried.model = format_model(identify(stream, pipeline).model);
    tried.records = stream.records().size();
    tried.notes = stream.excerpt().notes;
    return 0;
  };
  EXPECT_EQ(with_stream(*open_records({path}, roles), {}, use), 0);
  return tried;
}

ColumnRoles with_rates() {
  ColumnRoles roles;
  roles.names = {{"t", "1"}, {"x", "2"}, {"v", "3"}, {"rx", "4"}, {"rv", "5"}};
  roles.states = {"x", "v"};
  roles.derivatives = {"rx", "rv"};
  return roles;
}

Pipeline linear_sindy() {
  Pipeline pipeline = preset("sindy");
  pipeline.basis = Monomials{{.max_degree = 1}};
  return pipeline;
}

TEST(WithStream, BeginsAgainWhereARecordIsInterruptedAnywhere) {
  const TemporaryFolder folder;
  const Index samples = 300000;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // In the first and the last row, inside, and between two pieces of the pass over the rows.
  for (const Index row : {Index{0}, Index{150001}, Index{8192} * 9, samples - 1})
    for (const bool given : {false, true}) {
      Matrix values = oscillation_with_rates(samples);
      values(row, 1) = nan;
      const std::string path =
          saved(folder, "nan.npy", given ? values : Matrix(values.leftCols(3)));
      const ColumnRoles roles = given ? with_rates() : first_is_time();
      const RecordStream expected = read_stream({path}, roles);
      const Tried twice = tried(path, roles, linear_sindy());
      EXPECT_EQ(twice.records, expected.records().size()) << row;
      EXPECT_EQ(twice.notes, expected.excerpt().notes) << row;
      EXPECT_EQ(twice.model, format_model(identify(expected, linear_sindy()).model)) << row;
    }
}

TEST(WithStream, TimeThatJumpsBetweenTwoReadsIsSeen) {
  const TemporaryFolder folder;
  for (const Index row : {Index{8192} * 3, Index{8192} * 20 + 17}) {
    Matrix values = oscillation_with_rates(300000);
    values.col(0).tail(300000 - row).array() += 5.0;
    const std::string path = saved(folder, "jump.npy", values);
    const Tried twice = tried(path, with_rates(), linear_sindy());
    EXPECT_EQ(twice.records, 2U);
    EXPECT_LE(twice.times, 2);
    EXPECT_EQ(twice.model,
              format_model(identify(read_stream({path}, with_rates()), linear_sindy()).model));
  }
}

TEST(WithStream, WhatNobodyUsesInterruptsNothing) {
  const TemporaryFolder folder;
  Matrix values = oscillation_with_rates(200000);
  values(1000, 3) = std::numeric_limits<double>::quiet_NaN();
  const std::string path = saved(folder, "unused.npy", values);
  ColumnRoles roles = with_rates();
  roles.derivatives = {};
  EXPECT_EQ(tried(path, roles, linear_sindy()).times, 1);
}

TEST(WithStream, DoesNotHopeWhereNotAllRowsAreLookedAt) {
  const TemporaryFolder folder;
  const std::string slow =
      saved(folder, "slow.npy", testing::table_of(long_oscillation(300000, 20000.3)));
  ASSERT_LT(read_stream({slow}, first_is_time()).samples(), 300000) << "thinned";
  EXPECT_FALSE(read_hopeful_stream(*open_records({slow}, first_is_time())));
  const std::string path =
      saved(folder, "a.npy", testing::table_of(long_oscillation(200000, 97.3)));
  const auto plain = open_records({path}, first_is_time());
  EXPECT_TRUE(read_hopeful_stream(*plain));
  ColumnRoles numbered = first_is_time();
  numbered.trajectory = "v";
  EXPECT_FALSE(read_hopeful_stream(*open_records({path}, numbered)));
  testing::ThreadTeam(2).run(1, [&](const RunContext& context) {
    EXPECT_FALSE(read_hopeful_stream(*plain, context));
  });
  const std::string few = saved(folder, "few.npy", testing::table_of(long_oscillation(900, 9)));
  EXPECT_FALSE(read_hopeful_stream(*open_records({few}, first_is_time())));
}

/// A file of text with these numbers, to the last digit, and a comment in front of one line.
std::string saved_as_text(const TemporaryFolder& folder, const std::string& name,
                          const std::string& header, const Matrix& values) {
  std::string text = header + "\n";
  for (Index row = 0; row < values.rows(); ++row) {
    if (row == 70000) text += "# a comment\n";
    for (Index column = 0; column < values.cols(); ++column)
      text += (column > 0 ? "," : "") + format_number(values(row, column));
    text += '\n';
  }
  return folder.write(name, name.ends_with(".gz") ? std::string(gzip(text)) : text);
}

TEST(ReadStream, TextGivesTheSameModelToTheBit) {
  const TemporaryFolder folder;
  Matrix values = lorenz_table(200000);
  values(150000, 2) = std::numeric_limits<double>::quiet_NaN();
  const Pipeline pipeline = preset("algorithm1");
  for (const char* name : {"long.csv", "long.csv.gz"}) {
    const std::string path = saved_as_text(folder, name, "t [ms],x [V],y,z", values);
    const Dataset data = read_dataset({path});
    const RecordStream stream = read_stream({path});
    ASSERT_TRUE(stream.is_long());
    EXPECT_EQ(stream.in_memory(), nullptr);
    EXPECT_EQ(stream.records().size(), 2U);
    EXPECT_EQ(stream.excerpt().time_unit, "ms");
    EXPECT_EQ(stream.excerpt().notes, data.notes);
    EXPECT_EQ(stream.excerpt().trajectories[0].source, path + ", piece 1");
    EXPECT_EQ(format_model(identify(stream, pipeline).model),
              format_model(identify(data, pipeline).model));
  }
}

TEST(ReadStream, NamesRecordsAndPiecesAsInMemory) {
  const TemporaryFolder folder;
  const Matrix values = lorenz_table(150000);
  Matrix numbered(values.rows(), values.cols() + 1);
  numbered << values, Vector::Ones(values.rows());
  numbered.rightCols(1).bottomRows(60000).setConstant(2.0);
  numbered(120000, 2) = std::numeric_limits<double>::quiet_NaN();
  const std::string path = saved_as_text(folder, "long.csv", "t,x,y,z,run", numbered);
  const RecordStream stream = read_stream({path}, {.trajectory = "run"});
  std::vector<std::string> names;
  for (const auto& record : stream.records()) names.push_back(record->read(0, 2).source);
  EXPECT_THAT(names, ::testing::ElementsAre(path + ", record 1", path + ", record 2, piece 1",
                                            path + ", record 2, piece 2"));
}

TEST(ReadStream, TextHasTheErrorsThatItHasInMemory) {
  const TemporaryFolder folder;
  const Matrix good = lorenz_table(150000);
  const auto expect_the_same = [&](const std::vector<std::string>& paths) {
    std::string expected = "none";
    try {
      read_dataset(paths);
    } catch (const Error& error) {
      expected = error.what();
    }
    try {
      read_stream(paths);
      ADD_FAILURE() << expected;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), expected);
    }
  };
  Matrix back = good, infinite = good;
  back(120000, 0) = 0.0;
  infinite(120000, 2) = std::numeric_limits<double>::infinity();
  expect_the_same({saved_as_text(folder, "back.csv", "t,x,y,z", back)});
  expect_the_same({saved_as_text(folder, "infinite.csv", "t,x,y,z", infinite)});
  expect_the_same({saved_as_text(folder, "twice.csv", "t,x,x,z", good)});
  const std::string first = saved_as_text(folder, "1.csv", "t,x,y,z", good.topRows(9));
  const auto other = [&](const char* header) {
    return std::vector{first, saved_as_text(folder, "2.csv", header, good.topRows(9))};
  };
  expect_the_same(other("t,x,y,w"));
  expect_the_same(other("t,x,y [m],z"));
  expect_the_same({first, folder.file("none.csv")});
}

TEST(ReadStream, ColumnsMayHaveAnotherOrderInOtherFiles) {
  const TemporaryFolder folder;
  const Matrix values = lorenz_table(100000), other = 2.0 * values.topRows(90000);
  const std::string first = saved_as_text(folder, "1.csv", "t,x,y,z", values);
  const std::string second = saved_as_text(folder, "2.csv", "z,y,t,x",
                                           other(Eigen::all, std::vector<int>{3, 2, 0, 1}));
  const RecordStream stream = read_stream({first, second});
  ASSERT_EQ(stream.records().size(), 2U);
  EXPECT_EQ(stream.samples(), 190000);
  EXPECT_EQ(stream.records()[1]->read(100, 50).states, other.middleRows(100, 50).rightCols(3));
}

TEST(ReadStream, TimeThatGoesBackwardsIsAnError) {
  const TemporaryFolder folder;
  Matrix values = testing::table_of(long_oscillation(200000, 97.3));
  values(150000, 0) = 0.0;
  const std::string path = saved(folder, "back.npy", values);
  EXPECT_THROW(read_stream({path}, first_is_time()), DataError);
  EXPECT_THROW(tried(path, first_is_time(), linear_sindy()), DataError);
}

}  // namespace
}  // namespace lacuna
