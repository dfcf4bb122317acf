// SPDX-License-Identifier: MIT
#include "arguments/examples.hpp"

namespace lacuna::arguments {

All<RunContext> Choices<RunContext>::all() {
  RunContext none, negative;
  none.threads = 0;
  negative.threads = -5;
  return {{"default", {}}, {"no thread", none}, {"-5 threads", negative}};
}

All<FirstAnswer> Choices<FirstAnswer>::all() {
  const auto reads = [](const IdentificationResult& result) { (void)result.model.equations(); };
  return {{"none", nullptr}, {"a reader", reads}};
}

All<Expression> Choices<Expression>::all() {
  return {{"q*v", parse_expression("q*v")},
          {"1", parse_expression("1")},
          {"other", parse_expression("other")},
          {"log(-q*q)", parse_expression("log(-q*q)")}};
}

All<Variables> Choices<Variables>::all() {
  return {{"q, v, F", variables()}, {"none", {}}, {"q, q", {{"q", "q"}, {}}}};
}

All<Term> Choices<Term>::all() {
  return {{"q", Term::parse("q", variables())},
          {"q*v", Term::parse("q*v", variables())},
          {"1", Term::parse("1", variables())}};
}

All<WeightedTerm> Choices<WeightedTerm>::all() {
  const Term term = Term::parse("q*v", variables());
  return {{"2 q v", {term, 2.0}}, {"nan q v", {term, kNan}, false}};
}

All<Equation> Choices<Equation>::all() {
  const Term term = Term::parse("q", variables());
  return {{"-q", {{term, -1.0}}}, {"empty", {}}, {"twice", {{term, 1.0}, {term, 1.0}}}};
}

All<std::vector<Equation>> Choices<std::vector<Equation>>::all() {
  const Equation decay = {{Term::parse("q", variables()), -1.0}};
  return {{"two", {decay, decay}}, {"none", {}}, {"one", {decay}}, {"empty", {{}, {}}}};
}

All<Output> Choices<Output>::all() {
  return {{"y", {"y", "", parse_expression("q")}}, {"z", {"z", "", parse_expression("other")}}};
}

All<InitialValue> Choices<InitialValue>::all() {
  return {{"0", {}}, {"nan", {kNan}, false}, {"-1", {0.0, false, -1.0}}};
}

All<OdeModel> Choices<OdeModel>::all() {
  return {{"oscillator", oscillator()}, {"an empty equation", without_inputs()}};
}

All<Parameter> Choices<Parameter>::all() {
  return {{"k", {"k", 1.0}}, {"q", {"q", 1.0}}, {"nan", {"n", kNan}, false}};
}

All<SystemModel> Choices<SystemModel>::all() {
  return {{"oscillator", SystemModel(oscillator())}};
}

All<FreeCoefficient> Choices<FreeCoefficient>::all() {
  return {{"(1, 0)", {1, 0}}, {"(0, 7)", {0, 7}}, {"(-1, 0)", {-1, 0}}, {"(0, -1)", {0, -1}}};
}

All<FreeShape> Choices<FreeShape>::all() {
  return {{"F", {"F", 1.0}}, {"b", {"b", 1.0}}, {"nan", {"F", kNan}, false}};
}

All<ParametrisedModel> Choices<ParametrisedModel>::all() {
  return {{"oscillator", with_free_coefficients(oscillator())},
          {"nothing free", ParametrisedModel(oscillator(), {})}};
}

All<TermLibrary> Choices<TermLibrary>::all() {
  const Variables names = variables();
  return {{"1, q, v, F",
           {names,
            {Term::parse("1", names), Term::parse("q", names), Term::parse("v", names),
             Term::parse("F", names)}}},
          {"none", {names, {}}},
          {"no variables", {{}, {Term::parse("1", {})}}},
          {"log(q)", {names, {Term::parse("log(q)", names)}}}};
}

All<Pipeline> Choices<Pipeline>::all() { return {{"algorithm1", algorithm1()}}; }

All<RecordStream> Choices<RecordStream>::all() {
  static const All<Dataset> kData = Choices<Dataset>::all();
  All<RecordStream> choices;
  for (const Choice<Dataset>& data : kData) {
    try {
      choices.push_back({data.name, RecordStream(data.value), data.is_finite});
    } catch (const Error&) {  // such a stream cannot be had
    }
  }
  return choices;
}

All<std::shared_ptr<const SampleSource>> Choices<std::shared_ptr<const SampleSource>>::all() {
  static const Trajectory kRecord = record(), kEmpty = rows_of(kRecord, 0, 0);
  return {
      {"a record", source_of(kRecord)}, {"no sample", source_of(kEmpty)}, {"null", nullptr}};
}

All<std::shared_ptr<const RowSource>> Choices<std::shared_ptr<const RowSource>>::all() {
  const Matrix states = record().states, inputs = record().inputs;
  return {{"40 rows", make_row_source(states, inputs)},
          {"no rows", make_row_source(Matrix(0, 2), Matrix(0, 1))},
          {"no columns", make_row_source(Matrix(40, 0), Matrix(40, 0))},
          {"nan", make_row_source(with(states, 5, kNan), inputs), false}};
}

}  // namespace lacuna::arguments
