#include "forward/room/text_encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "forward/luminaire/photometry_file.h"
#include "tests/support/forward/encoded_text.h"
#include "tests/support/forward/photometry_text.h"

namespace luxfit {
namespace {

using support::InUtf16;
using support::kIes;
using support::kLdt;
using support::PhotometryError;
using support::Replaced;
using testing::HasSubstr;

constexpr char kMark[] = "\xef\xbb\xbf";

TEST(TextEncoding, Utf8ComesBackAsItIs) {
  for (const char* text : {"", "plain", u8"\u00fc \u20ac \U0001f4a1", "line\r\nline"})
    EXPECT_EQ(Utf8Text(text), text);
  EXPECT_EQ(Utf8Text(std::string(kMark) + kMark + "text"), "text");
}

TEST(TextEncoding, BytesThatAreNoUtf8AreWindows1252) {
  EXPECT_EQ(Utf8Text("Stra\xdf\x65 \xb0 M\xfcller"), u8"Stra\u00dfe \u00b0 M\u00fcller");
  EXPECT_EQ(Utf8Text("5 \x80 \x96 \x9f"), u8"5 \u20ac \u2013 \u0178");
  // Longer than it must be, a surrogate, beyond U+10FFFF, cut short, a byte that continues nothing: Table 3-7.
  EXPECT_EQ(Utf8Text("\xc0\xaf"), u8"\u00c0\u00af");
  EXPECT_EQ(Utf8Text("\xed\xa0\xa1"), u8"\u00ed\u00a0\u00a1");
  EXPECT_EQ(Utf8Text("\xf4\xa0\xa1\xa2"), u8"\u00f4\u00a0\u00a1\u00a2");
  EXPECT_EQ(Utf8Text("\xe0\xa0"), u8"\u00e0\u00a0");
  EXPECT_EQ(Utf8Text("a\xa1"), u8"a\u00a1");
}

TEST(TextEncoding, Utf16IsToldByItsMarkOrItsNuls) {
  const std::u16string text = u"M\u00fcller \u20ac \U0001f4a1 12";
  const std::string utf8 = u8"M\u00fcller \u20ac \U0001f4a1 12";
  for (const bool big : {false, true}) {
    EXPECT_EQ(Utf8Text(InUtf16(text, big, true)), utf8) << big;
    EXPECT_EQ(Utf8Text(InUtf16(text, big, false)), utf8) << big;
  }
  EXPECT_EQ(Utf8Text(InUtf16(u"a\xd800z\xdc00", false, true)), u8"a\ufffdz\ufffd");
  EXPECT_EQ(Utf8Text(InUtf16(u"ab", true, true) + '\0'), "ab");  // half a character
  // A file that is filled up with NULs is no UTF-16.
  EXPECT_EQ(Utf8Text(std::string("ab\0\0\0\0", 6)), std::string("ab\0\0\0\0", 6));
}

void ExpectSame(const PhotometryFile& file, const PhotometryFile& expected) {
  EXPECT_EQ(file.format, expected.format);
  EXPECT_EQ(file.table.c_rad, expected.table.c_rad);
  EXPECT_EQ(file.table.gamma_rad, expected.table.gamma_rad);
  EXPECT_EQ(file.table.cd_per_lm, expected.table.cd_per_lm);
  EXPECT_EQ(file.luminaire_flux_lm, expected.luminaire_flux_lm);
  EXPECT_EQ(file.size_m, expected.size_m);
  EXPECT_EQ(file.notes, expected.notes);
  ASSERT_EQ(file.keywords.size(), expected.keywords.size());
  for (size_t i = 0; i < file.keywords.size(); ++i) {
    EXPECT_EQ(file.keywords[i].name, expected.keywords[i].name);
    EXPECT_EQ(file.keywords[i].text, expected.keywords[i].text);
  }
}

TEST(TextEncoding, PhotometricFilesAreReadInEveryEncoding) {
  for (const std::string& name : {std::string("a.ies"), std::string("a.ldt")}) {
    const bool ies = name == "a.ies";
    const std::string plain = ies ? kIes : kLdt;
    const PhotometryFile expected = ParsePhotometry(plain, name);
    const std::u16string wide(plain.begin(), plain.end());
    ExpectSame(ParsePhotometry(kMark + plain, name), expected);
    for (const bool big : {false, true}) {
      for (const bool mark : {false, true})
        ExpectSame(ParsePhotometry(InUtf16(wide, big, mark), name), expected);
    }
    const std::string from = ies ? "[MANUFAC] M" : "Maker";
    for (const char* maker : {"M\xfcller", u8"M\u00fcller"}) {
      const PhotometryFile file =
          ParsePhotometry(Replaced(plain, from, (ies ? "[MANUFAC] " : "") + std::string(maker)), name);
      EXPECT_EQ(file.keywords[ies ? 1 : 0].text, u8"M\u00fcller");
    }
  }
}

TEST(TextEncoding, SaysWhereATextIsNoUnicode) {
  EXPECT_FALSE(FirstByteOfNoUnicode("plain"));
  EXPECT_FALSE(FirstByteOfNoUnicode("M\xc3\xbcller"));
  EXPECT_FALSE(FirstByteOfNoUnicode(InUtf16(u"M\u00fcller, 1", false, true)));
  EXPECT_EQ(FirstByteOfNoUnicode("M\xfcller"), 1u);
  EXPECT_EQ(FirstByteOfNoUnicode("M\xc3\xbcller, \xb0"), 9u);
}

TEST(TextEncoding, ErrorsKeepTheirLine) {
  const std::string broken = Replaced(kIes, "300 220 120", "300 -220 120");
  EXPECT_THAT(PhotometryError(InUtf16({broken.begin(), broken.end()}, false, true), "a.ies"),
              HasSubstr("a.ies:11: candela values: expected a number"));
  for (size_t length = 0; length + 10 < 2 * std::string(kIes).size(); ++length) {
    const std::string wide = InUtf16({kIes, kIes + sizeof kIes - 1}, true, true).substr(0, length);
    EXPECT_THAT(PhotometryError(wide, "a.ies"), HasSubstr("a.ies:")) << length;
  }
}

}  // namespace
}  // namespace luxfit
