// The report in headless Chromium: WebGL drawn by the processor, no network.
//
// The page checks itself (apps/report/page/self_test.js): pixels against the colours of their values, sliders
// against sums of columns, a click, statistics and glare against the program's, requests, words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/apps/small_room.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ReportBrowserTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(LUXFIT_CHROMIUM)) GTEST_SKIP() << "no chromium: apt-get install chromium";
  }

  // What the browser leaves behind: standard output of --dump-dom.
  std::string Browse(const std::string& flags, const std::string& page) const {
    const std::string command =
        "'" LUXFIT_CHROMIUM "' --headless=new --no-sandbox --hide-scrollbars --user-data-dir='" +
        folder_.Path("profile") +
        "' --host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=30000 --window-size=1400,1000 " +
        flags + " 'file://" + page + "' > '" + folder_.Path("dom") + "' 2> '" + folder_.Path("log") + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << folder_.Read("log");
    return folder_.Read("dom");
  }

  static json SelfTestOf(const std::string& dom) {
    const std::string open = "<pre id=\"selftest\">";
    const size_t from = dom.find(open);
    if (from == std::string::npos) return {{"ok", false}, {"dom", dom.substr(0, 2000)}};
    const size_t begin = from + open.size();
    std::string text = dom.substr(begin, dom.find("</pre>", begin) - begin);
    for (const auto& [entity, c] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}}) {
      for (size_t at; (at = text.find(entity)) != std::string::npos;)
        text.replace(at, std::string(entity).size(), c);
    }
    return json::parse(text);
  }

  // Returns the width of the page's contents in a window of 390 px, which headless Chromium has as a frame only.
  int WidthOnPhone(const std::string& report) const {
    folder_.Write(
        "phone.html",
        "<iframe src='" + report +
            "' style='width:390px;height:844px;border:0'></iframe><pre id=width></pre><script>"
            "onload = () => setTimeout(() => { document.getElementById('width').textContent = 'px ' + "
            "document.querySelector('iframe').contentDocument.documentElement.scrollWidth; }, 2000)"
            "</script>");
    const std::string dom = Browse(std::string(kWebGl) + " --allow-file-access-from-files --dump-dom",
                                   folder_.Path("phone.html"));
    const std::string open = "<pre id=\"width\">px ";
    const size_t at = dom.find(open);
    return at == std::string::npos ? 0 : std::stoi(dom.substr(at + open.size()));
  }

  TempFolder folder_;
  static constexpr char kWebGl[] = "--use-angle=swiftshader --enable-unsafe-swiftshader";
};

TEST_F(ReportBrowserTest, TheOfficePassesItsOwnTest) {
  const support::ProgramRun fitted =
      support::RunProgram("run '" LUXFIT_FIXTURES "/office/session.toml' -o '" + folder_.Path("out") + "'");
  ASSERT_EQ(fitted.status, 0) << fitted.output;
  const support::ProgramRun run = support::RunProgram("report '" + folder_.Path("out") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string page = folder_.Path("out/report.html");
  const json checked = SelfTestOf(Browse(std::string(kWebGl) + " --dump-dom", page + "#selftest"));
  EXPECT_TRUE(checked["ok"].get<bool>()) << checked.dump(1);
  EXPECT_GE(checked["pixels"]["compared"].get<int>(), 100) << checked.dump(1);
  EXPECT_EQ(checked["webgl"]["cells"], 11701);

  Browse(std::string(kWebGl) + " --no-pdf-header-footer --print-to-pdf='" + folder_.Path("report.pdf") + "'",
         page);
  const std::string pdf = folder_.Read("report.pdf");
  size_t pages = 0;
  for (size_t at = 0; (at = pdf.find("/Type /Page\n", at)) != std::string::npos; ++at) ++pages;
  EXPECT_GE(pages, 4U) << pdf.size();
  EXPECT_LE(pages, 9U);  // cover, luminaires, room, planes, photos, and an annex of four pages at most

  // The page is handed on: it names no folder of this machine.
  const std::string html = folder_.Read("out/report.html");
  EXPECT_EQ(html.find(LUXFIT_FIXTURES), std::string::npos);
  EXPECT_EQ(html.find(folder_.Path("")), std::string::npos);

  EXPECT_EQ(WidthOnPhone("out/report.html"), 390);
}

// Names that end scripts, a fit without photos, and a browser without WebGL.
TEST_F(ReportBrowserTest, TablesStandWithoutWebGlAndNoNameIsRun) {
  support::FitSmallRoom(folder_);
  const support::ProgramRun run = support::RunProgram("report '" + folder_.Path("out") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string page = folder_.Path("out/report.html") + "#selftest";
  const std::string dom = Browse("--disable-3d-apis --dump-dom", page);
  EXPECT_THAT(dom, HasSubstr("gives no WebGL"));
  EXPECT_THAT(dom, HasSubstr("class=\"schedule\""));
  EXPECT_THAT(dom, HasSubstr("fitted to readings alone"));
  const json flat = SelfTestOf(dom);
  for (const char* part : {"sliders", "numbers", "requests", "words", "injected"})
    EXPECT_TRUE(flat[part]["ok"].get<bool>()) << part << " " << flat.dump(1);
  const json drawn = SelfTestOf(Browse(std::string(kWebGl) + " --dump-dom", page));
  EXPECT_TRUE(drawn["ok"].get<bool>()) << drawn.dump(1);
}

}  // namespace
}  // namespace luxfit
