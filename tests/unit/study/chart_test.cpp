// SPDX-License-Identifier: MIT
#include "study/chart.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

#include "study/chart_sheet.hpp"

namespace hallway::study {
namespace {

Chart small_chart() {
  return {.file = "small",
          .title = "A <title> & more",
          .figures = "146",
          .x = {"iteration"},
          .y = {"error, m"},
          .series = {{.name = "one", .points = {{0.0, 0.0}, {10.0, 5.0}}, .colour = {255, 0, 0}},
                     {.name = "two",
                      .points = {{0.0, 5.0}, {5.0, NAN}, {10.0, 0.0}},
                      .style = SeriesStyle::kMarks,
                      .colour = {0, 0, 255}}}};
}

/// The places of the texts of a sheet.
std::map<std::string, Vec2> texts_of(const ChartSheet& sheet) {
  std::map<std::string, Vec2> texts;
  for (const SheetPiece& piece : sheet.pieces) {
    if (const auto* words = std::get_if<SheetWords>(&piece)) texts[words->text] = words->at;
  }
  return texts;
}

std::vector<SheetLine> data_lines(const ChartSheet& sheet) {
  std::vector<SheetLine> lines;
  for (const SheetPiece& piece : sheet.pieces) {
    if (const auto* line = std::get_if<SheetLine>(&piece); line != nullptr && line->clipped)
      lines.push_back(*line);
  }
  return lines;
}

TEST(ChartSheet, APointLiesWhereTheTicksSayItDoes) {
  const ChartSheet sheet = lay_out(small_chart());
  const auto texts = texts_of(sheet);
  const SheetLine line = data_lines(sheet).at(0);
  ASSERT_TRUE(texts.contains("10") && texts.contains("0") && texts.contains("5"));
  EXPECT_NEAR(line.points.at(1).x(), texts.at("10").x(), 1e-9);
  EXPECT_NEAR(line.points.at(1).y() + 4.5, texts.at("5").y(),
              1e-9);                                        // texts stand on a base line below the middle
  EXPECT_GT(line.points.at(0).y(), line.points.at(1).y());  // up is more
}

TEST(ChartSheet, NamesAreWhereTheirNumbersWouldBe) {
  Chart chart = small_chart();
  chart.x.names = {"here", "there"};
  chart.series = {{.name = "one", .points = {{0.0, 1.0}, {1.0, 2.0}}}};
  const ChartSheet sheet = lay_out(chart);
  const auto texts = texts_of(sheet);
  const SheetLine line = data_lines(sheet).at(0);
  EXPECT_NEAR(line.points.at(0).x(), texts.at("here").x(), 1e-9);
  EXPECT_NEAR(line.points.at(1).x(), texts.at("there").x(), 1e-9);
  EXPECT_LT(texts.at("here").x(), texts.at("there").x());
}

TEST(ChartSheet, OnLogarithmicAxesEqualFactorsAreEqualDistances) {
  Chart chart = small_chart();
  chart.x.log = chart.y.log = true;
  chart.series = {{.name = "one", .points = {{1.0, 1.0}, {10.0, 0.01}, {100.0, 0.0001}, {0.0, 1.0}}}};
  const auto points = data_lines(lay_out(chart)).at(0).points;
  ASSERT_EQ(points.size(), 3u);  // what is not above zero is not shown
  EXPECT_NEAR((points[1] - points[0] - (points[2] - points[1])).norm(), 0.0, 1e-6);
}

TEST(ChartSheet, WhatIsNotFiniteBreaksALine) {
  Chart chart = small_chart();
  chart.series = {{.points = {{0.0, 1.0}, {1.0, 1.0}, {2.0, NAN}, {3.0, 1.0}, {4.0, 1.0}}}};
  EXPECT_EQ(data_lines(lay_out(chart)).size(), 2u);
}

TEST(ChartSheet, OfAMapHasEqualScales) {
  Chart chart = small_chart();
  chart.equal_scales = true;
  chart.series = {{.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {400.0, 3.0}}}};
  const auto points = data_lines(lay_out(chart)).at(0).points;
  EXPECT_NEAR((points[1] - points[0]).norm(), (points[2] - points[1]).norm(), 1e-9);
}

TEST(ChartSheet, AllTextsLieOnThePaperAndDoNotMeet) {
  Chart chart = small_chart();
  for (int i = 0; i < 12; ++i)
    chart.series.push_back(
        {.name = "a plugin with many parameters, number " + std::to_string(i), .points = {{0.0, 1.0}}});
  const ChartSheet sheet = lay_out(chart);
  EXPECT_GT(sheet.frame_high.y() - sheet.frame_low.y(), 150.0);
  for (const auto& [text, at] : texts_of(sheet)) {
    EXPECT_GE(at.x(), 0.0) << text;
    EXPECT_LE(at.x(), kChartWidth_px) << text;
    EXPECT_LT(at.y(), kChartHeight_px) << text;
  }
}

/// Each tag of a text is closed in order, and no character stands that XML forbids there.
void expect_well_formed(const std::string& xml) {
  static const std::regex kTag("<(/?)([a-zA-Z]+)((?:\\s+[a-zA-Z:-]+=\"[^\"<&]*\")*)\\s*(/?)>");
  std::vector<std::string> open;
  std::string rest = xml;
  std::smatch match;
  while (std::regex_search(rest, match, kTag)) {
    const std::string between = match.prefix();
    EXPECT_EQ(between.find('<'), std::string::npos) << between;
    EXPECT_TRUE(std::regex_match(between, std::regex("([^&]|&(amp|lt|gt|quot);)*"))) << between;
    if (match[1] == "/") {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), match[2]);
      open.pop_back();
    } else if (match[4] != "/") {
      open.push_back(match[2]);
    }
    rest = match.suffix();
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(rest, "\n");
}

TEST(ChartSvg, IsWellFormedAndSaysWhatItShows) {
  const std::string svg = print_svg(small_chart());
  expect_well_formed(svg);
  EXPECT_NE(svg.find("A &lt;title&gt; &amp; more"), std::string::npos);
  EXPECT_NE(svg.find(">thesis, figure 146<"), std::string::npos);
  EXPECT_NE(svg.find("<circle"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg, print_svg(small_chart()));
}

TEST(ChartSvg, NamesSeveralFigures) {
  Chart chart = small_chart();
  chart.figures = "137, 145";
  EXPECT_NE(print_svg(chart).find(">thesis, figures 137, 145<"), std::string::npos);
}

/// Red, green, blue of each pixel, by libpng's own simple reader.
struct Picture {
  explicit Picture(const std::string& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return;
    image.format = PNG_FORMAT_RGB;
    rgb.resize(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr) == 0) return;
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
  }
  /// Whether a pixel near to this place has nearly this colour.
  bool has(const Vec2& at, int r, int g, int b) const {
    for (int y = static_cast<int>(at.y()) - 1; y <= static_cast<int>(at.y()) + 1; ++y) {
      for (int x = static_cast<int>(at.x()) - 1; x <= static_cast<int>(at.x()) + 1; ++x) {
        const auto* pixel = &rgb[3 * static_cast<std::size_t>(y * width + x)];
        if (std::abs(pixel[0] - r) + std::abs(pixel[1] - g) + std::abs(pixel[2] - b) < 60) return true;
      }
    }
    return false;
  }
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

TEST(ChartPng, ShowsTheSeriesWhereTheSheetHasThem) {
  const Chart chart = small_chart();
  const std::string bytes = print_png(chart);
  const Picture picture(bytes);
  ASSERT_EQ(picture.width, kChartWidth_px);
  ASSERT_EQ(picture.height, kChartHeight_px);
  const ChartSheet sheet = lay_out(chart);
  const auto line = data_lines(sheet).at(0).points;
  for (const double share : {0.1, 0.37, 0.8})
    EXPECT_TRUE(picture.has(line[0] + share * (line[1] - line[0]), 255, 0, 0)) << share;
  EXPECT_FALSE(picture.has(line[0] + Vec2(0.3, 0.1).cwiseProduct(line[1] - line[0]), 255, 0, 0));
  for (const SheetPiece& piece : sheet.pieces) {
    const auto* dots = std::get_if<SheetDots>(&piece);
    for (const Vec2& place : dots != nullptr ? dots->places : std::vector<Vec2>{})
      EXPECT_TRUE(picture.has(place, 0, 0, 255));
  }
  EXPECT_EQ(bytes, print_png(chart));
}

TEST(ChartPng, WithoutSeriesIsAnEmptyFrame) {
  Chart chart = small_chart();
  chart.series.clear();
  EXPECT_FALSE(print_png(chart).empty());
  expect_well_formed(print_svg(chart));
}

TEST(Thinned, KeepsTheMeanAndTheEnds) {
  std::vector<Vec2> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i, i % 2);
  const auto few = thinned(points, 100);
  ASSERT_EQ(few.size(), 100u);
  EXPECT_EQ(few.front(), Vec2(4.5, 0.5));
  EXPECT_EQ(few.back(), Vec2(994.5, 0.5));
  EXPECT_EQ(thinned(few, 100), few);
}

}  // namespace
}  // namespace hallway::study
