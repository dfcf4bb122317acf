// SPDX-License-Identifier: MIT
// The values that are tried as arguments.
#pragma once

#include <limits>

#include "arguments/hand.hpp"
#include "lacuna/lacuna.hpp"

namespace lacuna::arguments {

template <class T>
using All = std::vector<Choice<T>>;

template <class T>
concept HasChoices = requires {
  Choices<T>::all();
};

/// Types of which one value is enough: options, and stages that were made of options.
template <class T>
requires(std::is_class_v<T>&& std::is_default_constructible_v<T> &&
         (std::is_aggregate_v<T> || std::derived_from<T, StageInterface>)) struct Choices<T> {
  static All<T> all() { return {{"default", T{}}}; }
};

template <std::derived_from<StageInterface> T>
struct Choices<Stage<T>> {
  static All<Stage<T>> all() {
    All<Stage<T>> choices;
    for (const Stage<T>& stage : default_registry().make_all<T>())
      choices.push_back({std::string(stage->info().name), stage});
    return choices;
  }
};

template <class T>
requires std::is_enum_v<T>
struct Choices<T> {
  static All<T> all() { return {{"1", static_cast<T>(1)}, {"0", static_cast<T>(0)}}; }
};

template <HasChoices T>
struct Choices<std::optional<T>> {
  static All<std::optional<T>> all() {
    All<std::optional<T>> choices = {{"nothing", std::nullopt}};
    for (const Choice<T>& choice : Choices<T>::all())
      choices.push_back({choice.name, choice.value, choice.is_finite});
    return choices;
  }
};

/// Two of the first, none, each alone.
template <HasChoices T>
struct Choices<std::vector<T>> {
  static All<std::vector<T>> all() {
    const All<T> entries = Choices<T>::all();
    All<std::vector<T>> choices = {
        {"two times " + entries[0].name, {entries[0].value, entries[0].value}}, {"none", {}}};
    for (const Choice<T>& entry : entries)
      choices.push_back({"{" + entry.name + "}", {entry.value}, entry.is_finite});
    return choices;
  }
};

#define LACUNA_CHOICES(...)        \
  template <>                      \
  struct Choices<__VA_ARGS__> {    \
    static All<__VA_ARGS__> all(); \
  };
LACUNA_CHOICES(Interpolation)
LACUNA_CHOICES(Operation)
LACUNA_CHOICES(bool)
LACUNA_CHOICES(char)
LACUNA_CHOICES(int)
LACUNA_CHOICES(Index)
LACUNA_CHOICES(std::size_t)
LACUNA_CHOICES(double)
LACUNA_CHOICES(std::string)
LACUNA_CHOICES(std::string_view)
LACUNA_CHOICES(Vector)
LACUNA_CHOICES(const Vector*)
LACUNA_CHOICES(Matrix)
LACUNA_CHOICES(TermSet)
LACUNA_CHOICES(std::vector<int>)
LACUNA_CHOICES(std::vector<double>)
LACUNA_CHOICES(std::vector<std::string>)
LACUNA_CHOICES(Trajectory)
LACUNA_CHOICES(Dataset)
LACUNA_CHOICES(Quantity)
LACUNA_CHOICES(std::vector<Quantity>)
LACUNA_CHOICES(Table)
LACUNA_CHOICES(ColumnIndices)
LACUNA_CHOICES(TableRows)
LACUNA_CHOICES(ColumnRoles)
LACUNA_CHOICES(RunContext)
LACUNA_CHOICES(FirstAnswer)
LACUNA_CHOICES(Expression)
LACUNA_CHOICES(Variables)
LACUNA_CHOICES(Term)
LACUNA_CHOICES(WeightedTerm)
LACUNA_CHOICES(Equation)
LACUNA_CHOICES(std::vector<Equation>)
LACUNA_CHOICES(Output)
LACUNA_CHOICES(InitialValue)
LACUNA_CHOICES(OdeModel)
LACUNA_CHOICES(Parameter)
LACUNA_CHOICES(SystemModel)
LACUNA_CHOICES(FreeCoefficient)
LACUNA_CHOICES(FreeShape)
LACUNA_CHOICES(ParametrisedModel)
LACUNA_CHOICES(TermLibrary)
LACUNA_CHOICES(Pipeline)
LACUNA_CHOICES(RecordStream)
LACUNA_CHOICES(std::shared_ptr<const SampleSource>)
LACUNA_CHOICES(std::shared_ptr<const RowSource>)
LACUNA_CHOICES(LeastSquaresSystem)
LACUNA_CHOICES(Subproblem)
LACUNA_CHOICES(Factor)
LACUNA_CHOICES(WeightFunction)
LACUNA_CHOICES(L1Problem)
LACUNA_CHOICES(SampledSignal)
LACUNA_CHOICES(RightHandSide)
LACUNA_CHOICES(DrivenModel)
LACUNA_CHOICES(LinearisedRecord)
LACUNA_CHOICES(DelayedVariable)
LACUNA_CHOICES(ConstrainedCoefficient)
LACUNA_CHOICES(CoefficientConstraint)
LACUNA_CHOICES(CoefficientPlaces)
LACUNA_CHOICES(CoefficientPlace)
LACUNA_CHOICES(EmbeddingOrder)
LACUNA_CHOICES(Limits)
LACUNA_CHOICES(BoundRecords)
LACUNA_CHOICES(StateNoise)
LACUNA_CHOICES(Program)
LACUNA_CHOICES(Program::Workspace)
LACUNA_CHOICES(SyncOptions)
LACUNA_CHOICES(SyncResult)
LACUNA_CHOICES(SpectralLine)
LACUNA_CHOICES(Hint)
#undef LACUNA_CHOICES

}  // namespace lacuna::arguments
