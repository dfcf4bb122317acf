// SPDX-License-Identifier: MIT
#include "cli/terminal/progress_log.hpp"

#include <gtest/gtest.h>

#include <future>
#include <streambuf>

namespace lacuna::cli {
namespace {

/// Keeps the first line that is written to it.
class FirstLine : public std::streambuf {
 public:
  std::string wait() { return line_.get_future().get(); }

 protected:
  int_type overflow(int_type c) override {
    if (done_) return c;
    text_ += static_cast<char>(c);
    if (c == '\n') {
      done_ = true;
      line_.set_value(text_);
    }
    return c;
  }

 private:
  std::string text_;
  bool done_ = false;
  std::promise<std::string> line_;
};

TEST(ProgressLog, LinesHaveTimeActivityAndACountedPercentage) {
  EXPECT_EQ(log_line("fitting", 0.456, std::chrono::seconds(20)), "lacuna: 20 s: fitting: 45 %\n");
  EXPECT_EQ(log_line("reading data", 0.0, std::chrono::seconds(10)),
            "lacuna: 10 s: reading data\n");
}

TEST(ProgressLog, WritesALineThoughNothingReports) {
  FirstLine buffer;
  std::ostream stream(&buffer);
  const ProgressLog log(stream, std::chrono::milliseconds(1));
  EXPECT_EQ(buffer.wait(), "lacuna: 0 s: at work\n");
}

TEST(ProgressLog, WritesWhatWasReportedLast) {
  FirstLine buffer;
  std::ostream stream(&buffer);
  ProgressLog log(stream, std::chrono::milliseconds(200));
  log.note({"reading", 0.0});
  log.note({"fitting", 0.5});
  EXPECT_EQ(buffer.wait(), "lacuna: 0 s: fitting: 50 %\n");
}

TEST(ProgressLog, ARunThatEndsEarlyIsSilent) {
  std::ostringstream stream;
  { const ProgressLog log(stream); }
  EXPECT_EQ(stream.str(), "");
}

}  // namespace
}  // namespace lacuna::cli
