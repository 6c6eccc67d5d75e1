#include "apps/report/report_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "apps/text/formats/base64.h"

namespace luxfit {
namespace {

using nlohmann::json;

TEST(ReportPage, NoTextOfTheUserEndsTheData) {
  const json data = {{"id", "</script><b>&"}, {"</script>", "<!--"}};
  const std::string text = JsonForHtml(data);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
  EXPECT_EQ(json::parse(text), data);
}

// Each such byte becomes U+FFFD, and what stands around it stays.
TEST(ReportPage, BytesThatAreNotUtf8AreReplaced) {
  const json data = {{"at the end", "caf\xe9"}, {"within", "caf\xe9 noir"}, {"none", "caf\xc3\xa9"}};
  const json read = json::parse(JsonForHtml(data));
  EXPECT_EQ(read["at the end"], "caf\xef\xbf\xbd");
  EXPECT_EQ(read["within"], "caf\xef\xbf\xbd noir");
  EXPECT_EQ(read["none"], "caf\xc3\xa9");
}

TEST(ReportPage, IsWholeAndAsksForNothing) {
  const std::string page = ReportPage("a <b> & \"c\" <!--DATA-->", {{"x", 1}});
  EXPECT_NE(page.find("<title>a &lt;b&gt; &amp; &quot;c&quot; &lt;!--DATA--&gt;"), std::string::npos);
  EXPECT_NE(page.find("{\"x\":1}"), std::string::npos);
  // Whatever the program would ask for (three.js has loaders that nothing calls) the browser refuses.
  EXPECT_NE(page.find("content=\"default-src 'none'; script-src 'unsafe-inline'"), std::string::npos);
  for (const char* request :
       {" src=\"http", " src='http", " href=\"http", "url(http", "@import", "<link", "<iframe"})
    EXPECT_EQ(page.find(request), std::string::npos) << request;
  // The page's own scripts, one for data and one for the program.
  size_t scripts = 0;
  for (size_t at = 0; (at = page.find("</script", at)) != std::string::npos; ++at) ++scripts;
  EXPECT_EQ(scripts, 2U);
}

// Every part that a reader looks for, by its heading; the program makes them from the data in the browser.
TEST(ReportPage, HoldsEveryPartOfTheReport) {
  const std::string page = ReportPage("office", {{"x", 1}});
  for (const char* heading :
       {"The answer", "Measured against predicted", "The room", "Work planes", "Glare", "Light distribution",
        "Photos and predictions", "Reflectances", "All readings", "Measurement conditions", "Choices and why",
        "Speed and accuracy of this run", "Provenance"})
    EXPECT_NE(page.find('"' + std::string(heading) + '"'), std::string::npos) << heading;
  // The program reads the element of the data, and three.js draws the room.
  EXPECT_NE(page.find("<script type=\"application/json\" id=\"report-data\">{\"x\":1}</script>"),
            std::string::npos);
  for (const char* used : {"report-data", "WebGLRenderer", "gives no WebGL"})
    EXPECT_NE(GetReportAssets().script.find(used), std::string_view::npos) << used;
  EXPECT_NE(page.find(std::string(GetReportAssets().css)), std::string::npos);
  EXPECT_FALSE(GetReportAssets().css.empty());
  // A browser without scripts says what is missing.
  EXPECT_NE(page.find("<noscript>"), std::string::npos);
  EXPECT_NE(page.find("read result.json beside it"), std::string::npos);
}

// RFC 4648, sec. 10.
TEST(Base64, TestVectors) {
  const auto of = [](const std::string& text) { return Base64({text.begin(), text.end()}); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Base64, NumbersAreLittleEndian) {
  EXPECT_EQ(Base64Floats(Eigen::MatrixXd::Constant(1, 1, 1.0)), Base64({0, 0, 0x80, 0x3f}));
  EXPECT_EQ(Base64Shorts({0x1234, 1}), Base64({0x34, 0x12, 1, 0}));
  Eigen::MatrixXd rows(2, 1);
  rows << 1, 2;
  EXPECT_EQ(Base64Floats(rows), Base64({0, 0, 0x80, 0x3f, 0, 0, 0, 0x40}));
}

}  // namespace
}  // namespace luxfit
