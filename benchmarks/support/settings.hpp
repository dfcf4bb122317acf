// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/configuration/identification_configuration.hpp"
#include "support/cells.hpp"

namespace lacuna::benchmarks {

struct StudyArguments;

/// What the main() of a study is made of.
struct StudyProgram {
  std::string name;   ///< "odebench"
  std::string usage;  ///< "FILE OUTPUT_FOLDER [DRAWS] [PATH=VALUE...]"
  int (*run)(const StudyArguments&) = nullptr;
  std::size_t needed = 0;    ///< places that have to be given
  bool has_options = false;  ///< of `identify`, PATH=VALUE
};

/// Arguments of a study: those that have a place, and options of `identify` among them, written
/// PATH=VALUE: forms.same=0.2.
struct StudyArguments {
  std::string study;
  std::vector<std::string> places;
  std::vector<std::string> settings;  ///< as they were written
  IdentificationOptions options;
  std::optional<std::filesystem::path> finished;  ///< --cells: folder of finished cells

  /// What stands at a place, or what holds where nothing does.
  std::string at(std::size_t place, const std::string& otherwise = "") const;

  /// The same as a whole number. @throws ConfigError when it is none.
  std::size_t count_at(std::size_t place, std::size_t otherwise) const;

  /// The same as a folder of output; build/studies/STUDY where there is none.
  std::filesystem::path folder_at(std::size_t place) const;

  /// The folder of the measured records, LACUNA_DATA. @throws ConfigError where it is not set.
  std::string measured_data() const;

  /// The store of this process. @param given what, beside options of `identify` and the name of
  /// a cell, decides its values. @throws ConfigError as share_of_launcher().
  CellStore store(const std::string& given = "") const;
};

/// @throws ConfigError as identification_options(), and for an option that no study has.
StudyArguments study_arguments(const StudyProgram& study,
                               const std::vector<std::string>& given);

/// " forms.same=0.2": what a table says of its settings; empty where there are none.
std::string settings_text(const StudyArguments& arguments);

/// Runs a study; what is wrong is told in one line.
/// @return exit status: 2 where something is wrong.
int study_main(const StudyProgram& study, int argc, char** argv);

}  // namespace lacuna::benchmarks
