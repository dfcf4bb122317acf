// SPDX-License-Identifier: MIT
// Reports as a user gets them, and as a browser shows them where there is one.
#include <cmath>
#include <filesystem>

#include "integration/program.hpp"
#include "report/plot/markup.hpp"
#include "support/well_formed.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kModel =
    "time s\nstate x [m]\nstate v [<img src=x onerror=alert(1)>]\n"
    "dx/dt = v\ndv/dt = -4*x - 0.2*v\n";

/// A swing that dies away with a column that wants to be a script.
std::string record(double stiffness) {
  const double w = std::sqrt(stiffness - 0.01);
  std::string text = "t [s],x [m],v [<img src=x onerror=alert(1)>],<script>alert(1)</script>\n";
  std::uint64_t noise = 12345;
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.02 * i, e = std::exp(-0.1 * t);
    noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
    const double off = 0.01 * (static_cast<double>(noise >> 40U) / 16777216.0 - 0.5);
    text += std::to_string(t) + "," + std::to_string(e * std::cos(w * t) + off) + "," +
            std::to_string(e * (-0.1 * std::cos(w * t) - w * std::sin(w * t)) - off) + "," +
            std::to_string(std::sin(t)) + "\n";
  }
  return text;
}

/// Runs a command with --report and gives the page.
std::string page_of(const TemporaryFolder& folder, const std::string& arguments) {
  const CommandResult result =
      run_program_well(arguments + " --report '" + folder.file("page.html") + "'");
  return folder.read("page.html");
}

void expect_sound(const std::string& html, const std::string& command) {
  EXPECT_EQ(support::first_fault(html), "") << command;
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_THAT(html, Not(HasSubstr("src=\"")));
  EXPECT_THAT(html, Not(HasSubstr("href=")));
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("<math"));
  EXPECT_THAT(html, HasSubstr("<code>lacuna " + command));
}

class Reports : public ::testing::Test {
 protected:
  void SetUp() override {
    model_ = "'" + folder_.write("m.ode", kModel) + "'";
    data_ = "'" + folder_.write("run<b>.csv", record(5.0)) + "'";
  }
  std::string arguments(const std::string& command) const {
    if (command == "identify") return "identify " + data_ + " --states x,v --degree 2";
    if (command == "sync" || command == "fit") return command + " " + model_ + " " + data_;
    return "diagnose --model " + model_ + " " + data_;
  }
  TemporaryFolder folder_;
  std::string model_, data_;
};

TEST_F(Reports, AreSoundWhateverTheFilesSay) {
  expect_sound(page_of(folder_, arguments("identify")), "identify");
  expect_sound(page_of(folder_, arguments("diagnose")), "diagnose");
}

/// Names of curves are buttons, which no image has inside; what scrolls has to take the focus.
TEST_F(Reports, AnswerTheKeyboard) {
  for (const std::string command : {"identify", "diagnose", "sync", "fit"}) {
    const std::string html = page_of(folder_, arguments(command));
    EXPECT_THAT(html, HasSubstr("class=\"picture lines\" role=\"group\"")) << command;
    EXPECT_THAT(html, HasSubstr("class=\"key\" data-series=\"0\" tabindex=\"0\" role=\"button\""));
    for (const std::string scrolled :
         {"<div class=\"wide", "<div class=\"equations", "<figure id=\""})
      EXPECT_THAT(html, Not(::testing::ContainsRegex(scrolled + "[^\" ]*\">"))) << command;
  }
}

TEST_F(Reports, OfASyncSaysWhetherTheModelHolds) {
  const std::string html = page_of(folder_, arguments("sync"));
  EXPECT_THAT(html, HasSubstr("Does not hold: equation v"));
  EXPECT_EQ(support::first_fault(html), "");
}

TEST_F(Reports, PicturesAreFilesToo) {
  const std::string pictures = folder_.file("pictures");
  const CommandResult result =
      run_program_well(arguments("sync") + " --plot '" + pictures + "'");
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pictures)) {
    EXPECT_EQ(entry.path().extension(), ".svg");
    EXPECT_GT(std::filesystem::file_size(entry.path()), 1000u);
    ++count;
  }
  EXPECT_EQ(count, 6);
}

TEST_F(Reports, LongRecordsHaveSmallPages) {
  std::string text = "t,x,v\n";
  for (int i = 0; i < 200000; ++i) {
    const double t = 0.001 * i;
    text += std::to_string(t) + "," + std::to_string(std::cos(2.0 * t)) + "," +
            std::to_string(-2.0 * std::sin(2.0 * t)) + "\n";
  }
  folder_.write("big.csv", text);
  const std::string html =
      page_of(folder_, "sync " + model_ + " '" + folder_.file("big.csv") + "'");
  EXPECT_GT(html.size(), 20000u);
  EXPECT_LT(html.size(), 3000000u) << "a fourth of the record";
}

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + std::string(name) + " > /dev/null 2>&1").c_str()) == 0)
      return name;
  return "";
}

/// The title that a script gives to a page in a browser.
std::string title_in(const std::string& program, const TemporaryFolder& folder,
                     const std::string& html, const std::string& options = "") {
  const std::string path = folder.write("tried.html", html), out = folder.file("dom");
  const std::string run = "timeout 120 " + program +
                          " --headless --no-sandbox --disable-gpu --user-data-dir='" +
                          folder.file("profile") + "' " + options + " --dump-dom 'file://" + path +
                          "' > '" + out + "' 2> /dev/null";
  EXPECT_EQ(std::system(run.c_str()), 0);
  const std::string dom = folder.read("dom");
  const std::size_t begin = dom.find("<title>") + 7;
  return dom.substr(begin, dom.find("</title>") - begin);
}

/// What a browser makes of a page with a script behind it that tries what a reader does.
std::string tried(const std::string& program, const TemporaryFolder& folder, std::string html) {
  const std::string script = R"(<script>
var key=document.querySelector('.lines .key'),svg=key.closest('svg');
var curve=svg.querySelector('path[data-series="'+key.dataset.series+'"]');
var said=[];
key.dispatchEvent(new MouseEvent('click',{bubbles:true}));said.push(curve.style.display);
key.dispatchEvent(new MouseEvent('click',{bubbles:true}));said.push('['+curve.style.display+']');
var p=curve.getAttribute('d').match(/-?[\d.]+,-?[\d.]+/)[0].split(',').map(Number);
var r=svg.getBoundingClientRect(),v=svg.viewBox.baseVal;
svg.dispatchEvent(new PointerEvent('pointermove',{clientX:r.left+p[0]*r.width/v.width,
clientY:r.top+p[1]*r.height/v.height}));
var tip=document.querySelector('.tip');said.push(tip.style.display,tip.textContent);
var all=[...document.querySelectorAll('svg:not(.narrow) path[data-series]')];
said.unshift(all.filter(p=>p.getBBox().width>0).length+' of '+all.length+' drawn');
document.title=said.join('|').replace(/\n/g,'|');</script></body>)";
  html.replace(html.rfind("</body>"), 7, script);
  return title_in(program, folder, html);
}

/// Looks at a page in a frame, as windows of a browser are no narrower than 500 pixels.
/// @return "TERMS terms, NEW new; " and what is wrong.
std::string looked_at(const std::string& program, const TemporaryFolder& folder,
                      const std::string& html, int width) {
  const std::string script = R"(<script>onload=function(){
var page=document.querySelector('iframe').contentDocument,root=page.documentElement,faults=[];
if(root.clientWidth!==WIDTH)faults.push('width '+root.clientWidth);
if(root.scrollWidth>WIDTH)faults.push('scrolls sideways: '+root.scrollWidth);
var terms=[...page.querySelectorAll('.equations .term')];
terms.forEach(function(term){var line=term.parentElement.getBoundingClientRect();
term.querySelectorAll('math').forEach(function(piece){var box=piece.getBoundingClientRect();
if(!(box.width>0)||box.left<line.left-1||box.right>line.right+1)
faults.push('cut: '+term.textContent);});});
page.querySelectorAll('.equations,.wide,figure').forEach(function(one){
if(one.scrollWidth>one.clientWidth+1)faults.push('cut: '+(one.id||one.textContent));});
var news=terms.filter(function(term){return term.matches('.new');});
news.forEach(function(term){var box=term.getBoundingClientRect();
terms.forEach(function(other){var its=other.getBoundingClientRect();
if(other!==term&&Math.min(box.bottom,its.bottom)-Math.max(box.top,its.top)>0.3*its.height)
faults.push('beside another: '+term.textContent);});});
document.title=terms.length+' terms, '+news.length+' new; '+faults.join(' | ');};</script>)";
  const std::string wide = std::to_string(width);
  std::string frame = "<title></title><body style=\"margin:0\">" + script +
                      "<iframe style=\"border:0;width:" + wide + "px;height:3000px\" srcdoc=\"" +
                      escape_markup(html) + "\"></iframe></body>";
  for (std::size_t at = 0; (at = frame.find("WIDTH", at)) != std::string::npos;)
    frame.replace(at, 5, wide);
  return title_in(program, folder, frame, "--hide-scrollbars --window-size=1400,3000");
}

/// A spring with one term more than the model, one that is wider than a phone, and a long equation.
TEST_F(Reports, TermsOfEquationsAreWholeOnPaperAndOnAPhone) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "there is no Chromium here";
  const std::string bench = folder_.write(
      "bench.ode",
      "state x [m]\nstate v [m/s]\ndx/dt = v\ndv/dt = -4*x - 0.2*v - 1.5*x^3 + 2*sin(1.3*t) + "
      "0.3*tanh(x/0.12345)*cos(0.98765*v)*exp(-(x/1.2345)^2)*(1 + 0.54321*abs(v))\n"
      "F = 2*sin(1.3*t)\n");
  const std::string nominal = folder_.write(
      "nominal.ode",
      "time s\ninput F hold smooth\nstate x [m]\nstate v [m/s]\ndx/dt = v\ndv/dt = -4*x - 0.2*v + "
      "F + 0.3*tanh(x/0.12345)*cos(0.98765*v)*exp(-(x/1.2345)^2)*(1 + 0.54321*abs(v))\n");
  const std::string wanted = folder_.file("bench.csv");
  run_program_well("simulate '" + bench + "' --x0 0.5,0 --t-end 40 --dt 0.02 --noise " +
                   "x=0.002,v=0.004 -o '" + wanted + "'");
  const std::string html =
      page_of(folder_, "diagnose --model '" + nominal + "' '" + wanted + "'");
  for (const int width : {390, 1280})
    EXPECT_EQ(looked_at(program, folder_, html, width), "7 terms, 1 new; ") << width;
  const std::string many =
      page_of(folder_, "identify '" + wanted + "' --states x,v --inputs F --effort quick");
  for (const int width : {390, 1280})
    EXPECT_THAT(looked_at(program, folder_, many, width),
                ::testing::MatchesRegex("[0-9]+ terms, 0 new; "))
        << width;
}

TEST_F(Reports, CurvesAreHiddenByAClickAndValuesTold) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "there is no Chromium here";
  for (const std::string command : {"identify", "diagnose", "sync", "fit"}) {
    const std::string title = tried(program, folder_, page_of(folder_, arguments(command)));
    EXPECT_THAT(title,
                ::testing::MatchesRegex(
                    "([1-9][0-9]*) of ([1-9][0-9]*) drawn.none.\\[\\].block.*time \\[s\\]: .*"))
        << command;
    EXPECT_EQ(
        title.substr(0, title.find(" of ")),
        title.substr(title.find(" of ") + 4, title.find(" drawn") - title.find(" of ") - 4))
        << command << ": " << title;
  }
}

TEST_F(Reports, ShowInABrowserWithoutANetwork) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "there is no Chromium here";
  for (const std::string command : {"identify", "diagnose", "sync", "fit"}) {
    page_of(folder_, arguments(command));
    const std::string shot = folder_.file(command + ".png"), log = folder_.file("log");
    const std::string run =
        "timeout 120 " + program +
        " --headless --no-sandbox --disable-gpu --hide-scrollbars --enable-logging=stderr "
        "--host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir='" +
        folder_.file("profile") + "' --window-size=1000,3000 --screenshot='" + shot +
        "' 'file://" + folder_.file("page.html") + "' > /dev/null 2> '" + log + "'";
    ASSERT_EQ(std::system(run.c_str()), 0) << folder_.read("log");
    EXPECT_THAT(folder_.read("log"), Not(HasSubstr("CONSOLE"))) << command;
    // A page of one colour packs into a few kilobytes.
    EXPECT_GT(std::filesystem::file_size(shot), 60000u) << command;
  }
}

}  // namespace
}  // namespace lacuna::testing
