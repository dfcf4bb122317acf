// SPDX-License-Identifier: MIT
#include "support/settings.hpp"

#include <charconv>
#include <cstdlib>
#include <iostream>

#include "lacuna/core/base/error.hpp"

namespace lacuna::benchmarks {

std::string StudyArguments::at(std::size_t place, const std::string& otherwise) const {
  return place < places.size() ? places[place] : otherwise;
}

std::size_t StudyArguments::count_at(std::size_t place, std::size_t otherwise) const {
  if (place >= places.size()) return otherwise;
  const std::string& text = places[place];
  std::size_t count = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || stop != text.data() + text.size())
    throw ConfigError("study_" + study, "'" + text + "' is no whole number",
                      "give a number, 0 or above");
  return count;
}

std::filesystem::path StudyArguments::folder_at(std::size_t place) const {
  return at(place, "build/studies/" + study);
}

std::string StudyArguments::measured_data() const {
  if (const char* folder = std::getenv("LACUNA_DATA")) return folder;
  throw ConfigError("study_" + study, "LACUNA_DATA is not set",
                    "set it to the folder of the measured records");
}

CellStore StudyArguments::store(const std::string& given) const {
  return {study, given + settings_text(*this), finished, share_of_launcher()};
}

StudyArguments study_arguments(const StudyProgram& study,
                               const std::vector<std::string>& given) {
  StudyArguments arguments;
  arguments.study = study.name;
  Configuration configuration;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string& argument = given[i];
    if (argument == "--cells" && i + 1 < given.size()) {
      arguments.finished = given[++i];
    } else if (argument.starts_with("--")) {
      throw ConfigError("study_" + study.name, "'" + argument + "' cannot be used",
                        "usage: study_" + study.name + " " + study.usage + " [--cells FOLDER]");
    } else if (study.has_options && argument.find('=') != std::string::npos) {
      arguments.settings.push_back(argument);
      configuration.set(argument);
    } else {
      arguments.places.push_back(argument);
    }
  }
  arguments.options = identification_options(configuration, default_registry());
  return arguments;
}

std::string settings_text(const StudyArguments& arguments) {
  std::string text;
  for (const std::string& setting : arguments.settings) text += " " + setting;
  return text;
}

int study_main(const StudyProgram& study, int argc, char** argv) {
  try {
    const StudyArguments arguments = study_arguments(study, {argv + 1, argv + argc});
    if (arguments.places.size() >= study.needed) return study.run(arguments);
    std::cerr << "usage: study_" << study.name << ' ' << study.usage << " [--cells FOLDER]\n";
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "study_" << study.name << ": " << error.what() << '\n';
  }
  return 2;
}

}  // namespace lacuna::benchmarks
