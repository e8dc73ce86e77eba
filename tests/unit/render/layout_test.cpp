// SPDX-License-Identifier: MIT
#include "render/layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "render/draw.hpp"
#include "unit/render/scenes.hpp"

namespace hallway::render {
namespace {

Picture many_labels(int count) {
  Picture picture;
  for (int i = 0; i < count; ++i) {
    picture.polylines.push_back(
        {{}, palette::kTruth, 2.0, false, "a line with a rather long name " + std::to_string(i)});
  }
  return picture;
}

TEST(Layout, RoundLengthsAre125) {
  EXPECT_DOUBLE_EQ(round_down_125(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down_125(1.99), 1.0);
  EXPECT_DOUBLE_EQ(round_down_125(2.0), 2.0);
  EXPECT_DOUBLE_EQ(round_down_125(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_down_125(73.0), 50.0);
  EXPECT_DOUBLE_EQ(round_down_125(0.03), 0.02);
  EXPECT_DOUBLE_EQ(round_down_125(1000.0), 1000.0);
}

TEST(Layout, LengthsAreNamedInTheirUnit) {
  EXPECT_EQ(length_text(5.0), "5 m");
  EXPECT_EQ(length_text(0.2), "20 cm");
  EXPECT_EQ(length_text(2000.0), "2 km");
  EXPECT_EQ(length_text(0.005), "5 mm");
}

TEST(Layout, ScaleBarIsAsLongAsItSays) {
  for (double scale = 1e-3; scale < 1e5; scale *= 1.37) {
    const ScaleBar bar = scale_bar(scale, 150.0);
    EXPECT_NEAR(bar.length_px, bar.metres * scale, 1e-9 * bar.length_px);
    EXPECT_LE(bar.length_px, 150.0 * (1.0 + 1e-9));
    EXPECT_GT(bar.length_px, 150.0 / 2.6);
  }
}

TEST(Layout, DrawnScaleBarHasThatManyPixels) {
  Picture picture = test::office();
  picture.surfaces.clear();
  View view;
  view.crop = Crop{{8.0, 5.0}, 12.48};
  const Image image = draw(picture, view, 1280, 800);
  const Camera camera = picture_camera(picture, view, 1280, 800);
  const PixelRect map = map_area(picture, 1280, 800);
  const ScaleBar bar = scale_bar(camera.scale(), 150.0);
  // The bar's lower rim is one row of ink that begins at the left end of the map area.
  int longest = 0;
  for (int y = map.bottom + 2; y < image.height_px; ++y) {
    int length = 0;
    while (image.at(map.left + length, y) == palette::kInk) ++length;
    longest = std::max(longest, length);
  }
  EXPECT_EQ(longest, static_cast<int>(std::lround(bar.length_px)));
}

TEST(Layout, LegendStaysBelowTheMapAndInThePicture) {
  const Fonts fonts;
  for (const int count : {0, 1, 5, 12, 100}) {
    const Layout layout = make_layout(many_labels(count), 1280, 800, fonts);
    EXPECT_GT(layout.map.height(), 300);
    for (const LegendEntry& entry : layout.legend) {
      EXPECT_GT(entry.at_px.y(), layout.map.bottom);
      EXPECT_LT(entry.at_px.y() + 8.0, 800.0);
      EXPECT_LT(entry.at_px.x() + 36.0 + fonts.regular.width_px(entry.text, layout.text_px), 1280.0);
    }
  }
}

TEST(Layout, LegendEntriesDoNotOverlap) {
  const Fonts fonts;
  const Layout layout = make_layout(many_labels(9), 1280, 800, fonts);
  ASSERT_EQ(layout.legend.size(), 9u);
  for (std::size_t i = 1; i < layout.legend.size(); ++i) {
    const LegendEntry& before = layout.legend[i - 1];
    const LegendEntry& entry = layout.legend[i];
    const double end = before.at_px.x() + 36.0 + fonts.regular.width_px(before.text, layout.text_px);
    EXPECT_TRUE(entry.at_px.y() > before.at_px.y() + 15.0 || entry.at_px.x() > end);
  }
}

TEST(Layout, OneLabelHasOneLine) {
  Picture picture = many_labels(1);
  picture.polylines.push_back(picture.polylines[0]);
  picture.polylines.push_back({{}, palette::kError, 1.0, false, ""});
  EXPECT_EQ(make_layout(picture, 1280, 800, Fonts()).legend.size(), 1u);
}

TEST(Layout, TextsAreEchoedSafely) {
  Picture picture;
  picture.markers.push_back({{}, MarkerShape::kDot, palette::kTruth, 5.0, "red\x1b[31m\n"});
  const Layout layout = make_layout(picture, 1280, 800, Fonts());
  ASSERT_EQ(layout.legend.size(), 1u);
  EXPECT_EQ(layout.legend[0].text.find('\x1b'), std::string::npos);
  EXPECT_EQ(layout.legend[0].text.find('\n'), std::string::npos);
}

TEST(Layout, SmallPicturesAreAllMap) {
  const PixelRect map = make_layout(many_labels(3), 100, 80, Fonts()).map;
  EXPECT_EQ(map.width(), 100);
  EXPECT_EQ(map.height(), 80);
}

TEST(Font, ShortensToFit) {
  const Font font(Font::Weight::kRegular);
  const std::string text = "a text that is too long";
  const std::string part = font.shortened(text, 13.0, 60.0);
  EXPECT_LE(font.width_px(part, 13.0), 60.0);
  EXPECT_EQ(part.substr(0, 3), "a t");
  EXPECT_EQ(font.shortened(text, 13.0, 1000.0), text);
  EXPECT_EQ(font.shortened(text, 13.0, 1.0), "");
}

TEST(Font, DrawsAnyBytes) {
  const Font font(Font::Weight::kBold);
  std::string all;
  for (int i = 1; i < 256; ++i) all += static_cast<char>(i);
  const TextBitmap bitmap = font.render(all + "\xF0\x9F\x98", 13.0);
  EXPECT_EQ(bitmap.coverage.size(),
            static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
  EXPECT_TRUE(font.render("", 13.0).coverage.empty());
}

TEST(Font, GlyphsHaveTheHeightOfTheirSize) {
  const TextBitmap bitmap = Font(Font::Weight::kRegular).render("H", 100.0);
  EXPECT_NEAR(bitmap.height, 73.0, 2.0) << "capitals of DejaVu Sans are 0.729 em high";
  EXPECT_NEAR(bitmap.top, -73.0, 2.0);
}

}  // namespace
}  // namespace hallway::render
