// SPDX-License-Identifier: MIT
#include "base/xml_text.hpp"

#include <gtest/gtest.h>

namespace hallway {
namespace {

TEST(XmlText, EscapesMarkup) {
  EXPECT_EQ(xml_text("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_text("&lt;"), "&amp;lt;");
}

TEST(XmlText, KeepsWhatItIsNotAbout) {
  EXPECT_EQ(xml_text(""), "");
  EXPECT_EQ(xml_text("5 \xc2\xb0, \n\ttwo"), "5 \xc2\xb0, \n\ttwo");
}

TEST(XmlText, HasNothingThatXmlDoesNotAllow) {
  const std::string replacement = "\xEF\xBF\xBD";
  for (char c = 0; c < 0x20; ++c) {
    const bool stays = c == '\n' || c == '\t';
    EXPECT_EQ(xml_text(std::string_view(&c, 1)), stays ? std::string(1, c) : replacement)
        << static_cast<int>(c);
  }
  EXPECT_EQ(xml_text("a\xEF\xBF\xBF\x62"), "a" + replacement + "b");
  EXPECT_EQ(xml_text("a\xFFz\xC2"), "a" + replacement + "z" + replacement);
}

}  // namespace
}  // namespace hallway
