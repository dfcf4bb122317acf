// SPDX-License-Identifier: MIT
#include "arguments/examples.hpp"

namespace lacuna::arguments {

All<LeastSquaresSystem> Choices<LeastSquaresSystem>::all() {
  return {{"40 rows", LeastSquaresSystem(make_row_source(record().states, record().inputs),
                                         {"q", "v"}, {"F"})}};
}

All<Subproblem> Choices<Subproblem>::all() {
  const LeastSquaresSystem system = Choices<LeastSquaresSystem>::all()[0].value;
  return {{"q, v", system.subproblem(0, {0, 1})}, {"none", system.subproblem(0, {})}};
}

All<Factor> Choices<Factor>::all() {
  return {{"40 rows", Choices<LeastSquaresSystem>::all()[0].value.factor()}, {"nothing", {}}};
}

All<WeightFunction> Choices<WeightFunction>::all() {
  using Rows = Eigen::Ref<const Vector>;
  return {{"1", [](const Rows&, Eigen::Ref<Vector> weights) { weights.setOnes(); }},
          {"nan", [](const Rows&, Eigen::Ref<Vector> weights) { weights.setConstant(kNan); },
           false}};
}

All<L1Problem> Choices<L1Problem>::all() {
  const Matrix r = triangle().topLeftCorner(4, 4);
  const Vector c = triangle().col(4).head(4), ones = Vector::Ones(4);
  return {{"4", {r, c, ones, Vector::Zero(4)}},
          {"nothing", {}},
          {"mismatched", {r, c, Vector::Ones(2), Vector::Zero(1)}},
          {"nan", {r, with(c, 0, kNan), ones, ones}, false}};
}

All<SampledSignal> Choices<SampledSignal>::all() {
  return {{"a record", SampledSignal(record().time, record().states.col(0))},
          {"one sample", SampledSignal(Vector::Zero(1), Vector::Ones(1))}};
}

All<RightHandSide> Choices<RightHandSide>::all() {
  static const auto kDecay = [](double, const double* x, double* f) { f[0] = -x[0]; };
  return {{"decay", RightHandSide(kDecay)}};
}

All<DrivenModel> Choices<DrivenModel>::all() {
  static const OdeModel kModel = oscillator();
  static const auto kInput = [](double t, double* u) { u[0] = t; };
  return {{"oscillator", {kModel, kInput}},
          {"falling breaks", {kModel, kInput, Vector::LinSpaced(3, 2.0, 1.0)}},
          {"nan breaks", {kModel, kInput, Vector::Constant(2, kNan)}, false}};
}

All<LinearisedRecord> Choices<LinearisedRecord>::all() {
  return {{"a record",
           linearise(oscillator(), record(), record().states, Vector::Constant(2, 1e-3))}};
}

All<DelayedVariable> Choices<DelayedVariable>::all() {
  return {{"q", {0, 0.1}},
          {"7", {7, 0.1}},
          {"-1", {-1, 0.1}},
          {"past", {0, -1.0}},
          {"nan", {0, kNan}, false}};
}

All<ConstrainedCoefficient> Choices<ConstrainedCoefficient>::all() {
  return {{"(0, 1)", {0, 1, 1.0}}, {"(-1, -1)", {-1, -1, 1.0}}, {"nan", {0, 1, kNan}, false}};
}

All<CoefficientConstraint> Choices<CoefficientConstraint>::all() {
  return {{"one", {{{0, 1, 1.0}, {1, 1, 1.0}}, 2.0}},
          {"empty", {}},
          {"nan", {{{0, 1, kNan}}, kNan}, false}};
}

All<CoefficientPlaces> Choices<CoefficientPlaces>::all() {
  return {{"two", {{0, 1}, {1, 1}}}, {"none", {}}, {"negative", {{-1, -1}}}};
}

All<CoefficientPlace> Choices<CoefficientPlace>::all() {
  return {{"(1, 0)", {1, 0}}, {"(0, 7)", {0, 7}}, {"(-1, -1)", {-1, -1}}};
}

All<EmbeddingOrder> Choices<EmbeddingOrder>::all() {
  return {{"q", {"q", 2}},
          {"other", {"other", 2}},
          {"0", {"q", 0}},
          {"-1", {"q", -1}},
          {"max", {"q", std::numeric_limits<int>::max()}},
          {"min", {"q", std::numeric_limits<int>::min()}}};
}

All<Limits> Choices<Limits>::all() {
  return {{"-5 .. 5", {-5.0, 5.0}},
          {"none", {}},
          {"turned", {5.0, -5.0}},
          {"nan", {kNan, kNan}, false}};
}

All<StateNoise> Choices<StateNoise>::all() {
  return {{"white", {0.1, NoiseKind::White, {}, 0.0, 2, 0.1}}, {"none", {}}};
}

All<BoundRecords> Choices<BoundRecords>::all() {
  return {{"a record", observed(dataset({record()}))}};
}

All<Program> Choices<Program>::all() {
  const std::vector<Expression> outputs = {parse_expression("q*v"), parse_expression("F+1")};
  return {{"two", Program(outputs, variables())}};
}

All<Program::Workspace> Choices<Program::Workspace>::all() { return {{"new", {}}}; }

All<SyncOptions> Choices<SyncOptions>::all() {
  SyncOptions coupling, start, nan;
  coupling.coupling = Matrix::Ones(1, 3);
  start.start = Vector::Ones(7);
  nan.coupling = Matrix::Constant(2, 2, kNan);
  return {
      {"default", {}}, {"odd coupling", coupling}, {"odd start", start}, {"nan", nan, false}};
}

All<SyncResult> Choices<SyncResult>::all() { return {{"nothing", {}}}; }

All<SpectralLine> Choices<SpectralLine>::all() { return {{"none", {}}}; }

All<Hint> Choices<Hint>::all() { return {{"a hint", {}}}; }

}  // namespace lacuna::arguments
