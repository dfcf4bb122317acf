// SPDX-License-Identifier: MIT
#include "output.hpp"

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"

namespace lacuna::benchmarks {

Output::Output(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_);
}

void Output::chapter(const std::string& title, const std::string& text) {
  report_ += "\n## " + title + "\n\n" + text + "\n";
}

void Output::table(const std::string& stem, const std::string& title,
                   const ResultTable& table) {
  write_file_atomically(folder_ / (stem + ".csv"), table.csv());
  write_file_atomically(folder_ / (stem + ".md"), table.markdown());
  report_ += "\n**" + title + "** (" + stem + ".csv)\n\n" + table.markdown();
}

void Output::data(const std::string& stem, const std::vector<std::string>& names,
                  const Matrix& columns) {
  std::string text = join(names, ",") + "\n";
  for (Index i = 0; i < columns.rows(); ++i)
    for (Index k = 0; k < columns.cols(); ++k)
      text += format_number(columns(i, k), 7) + (k + 1 < columns.cols() ? "," : "\n");
  write_file_atomically(folder_ / (stem + ".csv"), text);
}

void Output::picture(const std::string& stem, const std::string& title, int width, int height,
                     const std::string& script) {
  const std::string head = "set terminal pngcairo size " + std::to_string(width) + "," +
                           std::to_string(height) + " font 'sans,11'\nset output '" + stem +
                           ".png'\nset datafile separator ','\n";
  write_file_atomically(folder_ / (stem + ".gp"), head + script);
  if (!render_with_gnuplot(std::filesystem::absolute(folder_ / (stem + ".gp"))))
    return skip(stem + ".png", "gnuplot is not installed (package gnuplot-nox)");
  report_ += "\n**" + title + "**\n\n![" + title + "](" + stem + ".png)\n";
}

void Output::skip(const std::string& what, const std::string& reason) {
  skipped_.push_back(what + ": " + reason);
  report_ += "\nSkipped: " + skipped_.back() + "\n";
}

std::vector<std::string> Output::finish(double seconds) {
  const std::string head = "# The paper, reproduced\n\nMade by `lacuna-paper` in " +
                           format_number(seconds, 3) + " s, " + today() + ", on " +
                           machine_description() + ".\n";
  write_file_atomically(folder_ / "report.md", head + report_);
  return skipped_;
}

std::string cell(double value) { return format_number(value, 4); }

std::string ratio_cell(double found, double printed) {
  return format_number(found / printed, 3);
}

}  // namespace lacuna::benchmarks
