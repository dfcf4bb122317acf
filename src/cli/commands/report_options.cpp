// SPDX-License-Identifier: MIT
#include "report_options.hpp"

#include <filesystem>
#include <ostream>

#include "cli/terminal/browser.hpp"
#include "core/base/utf8.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

void write_pictures(const std::string& folder, const Page& page) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw FileError("--plot " + folder, "the folder cannot be made: " + error.message(),
                    "name a folder that may be written");
  for (const Picture& picture : pictures_of(page))
    write_file_atomically((fs::path(folder) / (picture.name + ".svg")).string(),
                          stand_alone(picture));
}

}  // namespace

void declare_report_options(Command& command, ReportOptions& options) {
  command.add("--report FILE.html|-", &options.page,
              "Write the answer with its pictures as one HTML page that needs no network");
  command.add("--open", &options.open, "Show the page of --report in a browser");
  command.add("--plot FOLDER", &options.pictures,
              "Write the pictures of the page as .svg files");
}

void declare_digits_option(Command& command, Digits& digits, const std::string& description) {
  const auto read = [&digits](const std::string& text) -> std::string {
    try {
      digits = parse_digits(text);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  command.add("--digits auto|full|N", read, description);
}

std::string model_text(const std::string& path, const SystemModel& model,
                       const Digits& digits) {
  const bool is_read_by_people = fs::path(path).extension() == ".ode";
  return format_model_for(path, is_read_by_people ? rounded(model, digits) : model);
}

void check_open(const ReportOptions& options) {
  if (options.open && (!options.page || *options.page == "-"))
    throw ConfigError("--open", "there is no file to show",
                      "name it: --report answer.html --open");
}

void write_report(const Session& session, const ReportOptions& options,
                  FunctionRef<Page()> make_page) {
  if (!options.page && !options.pictures) return;
  Page page = make_page();
  page.command = session.command_line;
  if (options.pictures) write_pictures(*options.pictures, page);
  if (!options.page) return;
  write_output(session, *options.page, format_html(page));
  if (options.open && !open_in_browser(*options.page))
    session.streams.err << "lacuna: no browser could be started; open " +
                               printable(*options.page) + " yourself, or set BROWSER\n";
}

}  // namespace lacuna::cli
