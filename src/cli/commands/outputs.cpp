// SPDX-License-Identifier: MIT
#include "outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "core/files/atomic_file.hpp"
#include "data/formats/file_kinds.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char *kPictureEnding = ".svg", *kPictures = "FOLDER";

/// Where a file is, there or not yet, behind its links; empty where that is not known.
fs::path real_place(const fs::path& path) {
  std::error_code unknown;
  return fs::weakly_canonical(fs::absolute(written_file(path), unknown), unknown);
}

bool is_output(const Option& option) {
  return option.form.ends_with("|-") || option.form == kPictures;
}

/// Whether both are one file, there or not yet.
bool same_file(const fs::path& a, const fs::path& b) {
  if (is_stream(a) || is_stream(b)) return false;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return !real_place(a).empty() && real_place(a) == real_place(b);
}

/// Whether a picture in the folder would be, or already is, that file.
bool has_picture(const fs::path& folder, const fs::path& file) {
  const fs::path place = real_place(file);
  if (place.extension() == kPictureEnding && same_file(place.parent_path(), folder))
    return true;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (entry->path().extension() == kPictureEnding && same_file(entry->path(), file))
      return true;
  return false;
}

/// Whether to write the output is to write that file.
bool replaces(const OutputFile& output, const fs::path& file) {
  return same_file(output.path, file) || (output.is_folder && has_picture(output.path, file));
}

/// @throws FileError where pictures can neither be written into a folder nor it be made.
void check_folder(const std::string& option, const fs::path& folder) {
  constexpr const char* kRemedy = "name a folder that may be written";
  if (folder == "-")
    throw ConfigError(option + " -", "pictures are several files", "name a folder");
  std::error_code error;
  fs::path there = real_place(folder);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  const std::string place = option + " " + folder.string();
  if (!fs::is_directory(there, error))
    throw FileError(place, "the folder cannot be made: '" + there.string() + "' is no folder",
                    kRemedy);
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw FileError(place, "'" + there.string() + "' may not be written", kRemedy);
}

/// What an output shares with those before it, which are kept apart from each other.
void check_apart(const OutputFile& output, const std::vector<OutputFile>& before) {
  const std::string place = output.option + " " + output.path;
  for (const OutputFile& other : before) {
    const bool same = other.path == output.path ||
                      (other.path != "-" && output.path != "-" &&
                       (replaces(output, other.path) || replaces(other, output.path)));
    if (same)
      throw ConfigError(place, other.option + " goes there too",
                        "give each result a place of its own");
  }
  if (output.path != "-" && same_file(output.path, "/dev/stdout"))
    throw ConfigError(place, "standard output goes there too",
                      "give the result a file of its own, or - for standard output");
}

}  // namespace

std::vector<OutputFile> outputs_of(const std::vector<GivenOption>& given) {
  std::vector<OutputFile> outputs;
  for (const auto& [option, words] : given)
    if (is_output(*option))
      for (const std::string& path : words)
        outputs.push_back({option->name(), path, option->form == kPictures});
  return outputs;
}

std::vector<fs::path> files_read_by(const std::vector<GivenOption>& given) {
  std::vector<fs::path> files;
  for (const auto& [option, words] : given) {
    if (is_output(*option)) continue;
    for (const std::string& word : words)
      for (fs::path& file : files_named(word)) files.push_back(std::move(file));
  }
  return files;
}

void check_outputs(const std::vector<fs::path>& read, const std::vector<OutputFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (output.path != "-")
      for (const fs::path& file : read)
        if (replaces(output, file))
          throw ConfigError(output.option + " " + output.path,
                            "this would replace '" + file.string() + "', which is read",
                            "give the result a file of its own");
    check_apart(output, {outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(i)});
  }
  for (const OutputFile& output : outputs) {
    if (output.is_folder)
      check_folder(output.option, output.path);
    else if (output.path != "-")
      check_writable(output.path);
  }
}

}  // namespace lacuna::cli
