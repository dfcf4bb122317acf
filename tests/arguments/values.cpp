// SPDX-License-Identifier: MIT
#include "arguments/examples.hpp"

namespace lacuna::arguments {

All<Interpolation> Choices<Interpolation>::all() {
  return {{"cubic", Interpolation::Cubic},
          {"quintic", Interpolation::Quintic},
          {"held", Interpolation::Held},
          {"linear", Interpolation::Linear}};
}

All<Operation> Choices<Operation>::all() {
  return {{"add", Operation::Add}, {"sin", Operation::Sin}, {"min", Operation::Min}};
}

All<bool> Choices<bool>::all() { return {{"true", true}, {"false", false}}; }

All<char> Choices<char>::all() { return {{"','", ','}, {"' '", ' '}, {"0", '\0'}}; }

All<int> Choices<int>::all() {
  using Limits = std::numeric_limits<int>;
  return {{"1", 1},
          {"0", 0},
          {"-1", -1},
          {"2", 2},
          {"4", 4},
          {"17", 17},
          {"max", Limits::max()},
          {"min", Limits::min()}};
}

All<Index> Choices<Index>::all() {
  using Limits = std::numeric_limits<Index>;
  return {{"1", 1},
          {"0", 0},
          {"-1", -1},
          {"2", 2},
          {"4", 4},
          {"40", 40},
          {"1e12", Index{1000000000000}},
          {"max", Limits::max()},
          {"min", Limits::min()}};
}

All<std::size_t> Choices<std::size_t>::all() {
  using Limits = std::numeric_limits<std::size_t>;
  return {{"1", 1}, {"0", 0}, {"3", 3}, {"max", Limits::max()}};
}

All<double> Choices<double>::all() {
  return {{"0.5", 0.5},
          {"0", 0.0},
          {"-1", -1.0},
          {"3", 3.0},
          {"1e308", kHuge, false},
          {"-1e308", -kHuge, false},
          {"1e-308", 1e-308, false},
          {"nan", kNan, false},
          {"inf", kInfinity, false}};
}

All<std::string> Choices<std::string>::all() {
  return {{"q", "q"}, {"empty", ""}, {"v", "v"}, {"other", "other"}, {"text", "3,a b\n"}};
}

All<std::string_view> Choices<std::string_view>::all() { return {{"q", "q"}, {"empty", ""}}; }

All<const Vector*> Choices<const Vector*>::all() {
  static const All<Vector> kVectors = Choices<Vector>::all();
  All<const Vector*> choices;
  for (const Choice<Vector>& vector : kVectors)
    choices.push_back({vector.name, &vector.value, vector.is_finite});
  return choices;
}

All<Vector> Choices<Vector>::all() {
  const Vector rising = record().time;
  return {{"40 rising", rising},
          {"empty", Vector()},
          {"1", Vector::Constant(1, 0.5)},
          {"2", Vector::LinSpaced(2, 0.1, 0.3)},
          {"4", Vector::LinSpaced(4, -1.0, 1.0)},
          {"5", Vector::LinSpaced(5, 1.0, 2.0)},
          {"40 falling", rising.reverse()},
          {"40 zeros", Vector::Zero(kSamples)},
          {"2 zeros", Vector::Zero(2)},
          {"40 samples", record().states.col(0)},
          {"2 huge", Vector::Constant(2, kHuge), false},
          {"40 huge", kHuge * record().states.col(0), false},
          {"40 with nan", with(rising, 7, kNan), false},
          {"2 with nan", with(Vector::Ones(2), 1, kNan), false},
          {"4 with nan", with(Vector::Ones(4), 2, kNan), false},
          {"40 with inf", with(rising, 39, kInfinity), false}};
}

All<Matrix> Choices<Matrix>::all() {
  const Matrix states = record().states;
  const Matrix symmetric = Matrix::Identity(2, 2) + Matrix::Constant(2, 2, 0.25);
  return {{"40 x 2", states},
          {"2 x 2", symmetric},
          {"5 x 5 triangle", triangle()},
          {"40 x 1", states.leftCols(1)},
          {"40 x 4", Matrix(states * Matrix::Ones(2, 4))},
          {"0 x 0", Matrix()},
          {"0 x 2", Matrix(0, 2)},
          {"40 x 0", Matrix(40, 0)},
          {"2 x 40", states.transpose()},
          {"40 x 2 zeros", Matrix::Zero(40, 2)},
          {"2 x 2 zeros", Matrix::Zero(2, 2)},
          {"4 x 4", Matrix::Identity(4, 4)},
          {"40 x 2 huge", kHuge * states, false},
          {"2 x 2 huge", kHuge * symmetric, false},
          {"40 x 2 with nan", with(states, 3, kNan), false},
          {"2 x 2 with nan", with(symmetric, 1, kNan), false},
          {"5 x 5 with nan", with(triangle(), 0, kNan), false},
          {"40 x 2 with inf", with(states, 79, kInfinity), false}};
}

All<TermSet> Choices<TermSet>::all() {
  using Limits = std::numeric_limits<Index>;
  return {{"0, 1", {0, 1}},        {"none", {}}, {"1", {1}},         {"1, 0", {1, 0}},
          {"0, 0", {0, 0}},        {"-1", {-1}}, {"0, 40", {0, 40}}, {"max", {Limits::max()}},
          {"min", {Limits::min()}}};
}

All<std::vector<int>> Choices<std::vector<int>>::all() {
  return {{"four", {1, 0, 0, 2}},
          {"none", {}},
          {"3", {3}},
          {"-1", {-1, 0, 0, 0}},
          {"huge", {1 << 30, 1 << 30, 0, 0}}};
}

All<std::vector<double>> Choices<std::vector<double>>::all() {
  return {{"40", std::vector<double>(40, 0.1)},
          {"none", {}},
          {"1", {0.5}},
          {"huge", {kHuge, -kHuge}, false},
          {"nan", {kNan, 1.0}, false}};
}

All<std::vector<std::string>> Choices<std::vector<std::string>>::all() {
  return {
      {"q, v", {"q", "v"}}, {"none", {}}, {"q, q", {"q", "q"}}, {"empty", {""}}, {"q", {"q"}}};
}

All<Trajectory> Choices<Trajectory>::all() {
  return {
      {"a record", record()},
      {"a long one", long_record().trajectories.front()},
      {"nothing", Trajectory{}},
      {"no sample", changed([](Trajectory& r) {
         r.time.resize(0);
         r.states.resize(0, 2);
         r.inputs.resize(0, 1);
       })},
      {"one sample", changed([](Trajectory& r) {
         r.time.conservativeResize(1);
         r.states.conservativeResize(1, 2);
         r.inputs.conservativeResize(1, 1);
       })},
      {"fewer states", changed([](Trajectory& r) { r.states.conservativeResize(20, 2); })},
      {"one state", changed([](Trajectory& r) { r.states.conservativeResize(40, 1); })},
      {"fewer times", changed([](Trajectory& r) { r.time.conservativeResize(3); })},
      {"fewer inputs", changed([](Trajectory& r) { r.inputs.conservativeResize(2, 1); })},
      {"odd derivatives", changed([](Trajectory& r) { r.derivatives = Matrix::Ones(3, 1); })},
      {"odd marks", changed([](Trajectory& r) { r.marks = Matrix::Ones(3, 1); })},
      {"falling time", changed([](Trajectory& r) { r.time.reverseInPlace(); })},
      {"one time", changed([](Trajectory& r) { r.time.setZero(); })},
      {"constant", changed([](Trajectory& r) { r.states.setOnes(); })},
      {"huge", changed([](Trajectory& r) { r.states *= kHuge; }), false},
      {"huge time", changed([](Trajectory& r) { r.time *= kHuge; }), false},
      {"nan state", changed([](Trajectory& r) { r.states(5, 1) = kNan; }), false},
      {"nan time", changed([](Trajectory& r) { r.time[5] = kNan; }), false},
      {"infinite input", changed([](Trajectory& r) { r.inputs(5, 0) = kInfinity; }), false},
  };
}

All<Dataset> Choices<Dataset>::all() {
  All<Dataset> choices;
  for (const Choice<Trajectory>& made : Choices<Trajectory>::all())
    choices.push_back({made.name, dataset({made.value}), made.is_finite});
  choices.push_back({"two records", dataset({record(), record()})});
  choices.push_back({"long record", long_record()});
  choices.push_back({"no record", dataset({})});
  choices.push_back({"nothing", Dataset{}});
  Dataset names = dataset({record()});
  names.states.clear();
  choices.push_back({"no names", names});
  Dataset rates = dataset({record()});
  rates.rate_of = {7};
  rates.reconstructed = {true};
  choices.push_back({"odd identities", rates});
  return choices;
}

All<Quantity> Choices<Quantity>::all() {
  return {{"q", {"q", "m"}}, {"F", {"F", "N"}}, {"no name", {"", ""}}};
}

All<std::vector<Quantity>> Choices<std::vector<Quantity>>::all() {
  return {{"q, v", {{"q", "m"}, {"v", "m/s"}}},
          {"F", {{"F", "N", Hold::Zero}}},
          {"none", {}},
          {"q, q", {{"q", "m"}, {"q", "m"}}}};
}

All<Table> Choices<Table>::all() {
  Table table;
  table.source = "made.csv";
  table.columns = {{"t", "s"}, {"q", "m"}, {"v", "m/s"}, {"F", "N"}};
  table.values.resize(kSamples, 4);
  table.values << record().time, record().states, record().inputs;
  table.headers = names_of(table.columns);
  Table missing = table, rows = table, columns = table, lines = table;
  missing.values(7, 1) = kNan;
  rows.values.resize(0, 4);
  columns.columns.resize(2);
  lines.lines = {1, 2};
  return {{"a table", table},     {"nothing", Table{}},
          {"no rows", rows},      {"fewer names", columns},
          {"fewer lines", lines}, {"a missing value", missing, false}};
}

All<ColumnIndices> Choices<ColumnIndices>::all() {
  ColumnIndices columns, far, negative;
  columns.time = 0;
  columns.states = {1, 2};
  columns.inputs = {3};
  far = negative = columns;
  far.states = {1, 70};
  negative.inputs = {-1};
  return {
      {"columns", columns}, {"none", ColumnIndices{}}, {"far", far}, {"negative", negative}};
}

All<TableRows> Choices<TableRows>::all() {
  return {{"all", {0, kSamples, 0}}, {"none", {0, 0, 0}},      {"from -1", {-1, 3, 0}},
          {"far", {30, 30, 0}},      {"negative", {3, -1, 0}}, {"offset", {0, 3, -7}}};
}

All<ColumnRoles> Choices<ColumnRoles>::all() {
  ColumnRoles no_step, roles;
  no_step.step = -1.0;
  roles.states = {"q", "other"};
  return {{"default", {}}, {"step -1", no_step}, {"unknown", roles}};
}

}  // namespace lacuna::arguments
