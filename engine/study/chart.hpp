// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "render/colour.hpp"

namespace hallway::study {

/// An axis of a chart.
struct Axis {
  std::string label{};               ///< what is shown, with its unit
  bool log = false;                  ///< logarithmic; what is not above zero is then not shown
  std::vector<std::string> names{};  ///< of the places 0, 1, ... in place of numbers; not logarithmic
  bool counts = false;               ///< ticks are at whole numbers only; not logarithmic
};

/// How a series is drawn.
enum class SeriesStyle { kLine, kDashed, kMarks };

/// Points of a chart that belong together.
struct Series {
  std::string name{};          ///< in the legend; empty for none
  std::vector<Vec2> points{};  ///< one that is not finite breaks the line
  SeriesStyle style = SeriesStyle::kLine;
  render::Rgb colour{};
};

/// A diagram with two axes.
struct Chart {
  std::string file{};  ///< name without ending
  std::string title{};
  std::string figures{};  ///< of the thesis, that it corresponds to: "146", "130, 132, 134"
  Axis x{};
  Axis y{};
  std::vector<Series> series{};
  bool equal_scales = false;  ///< one unit of x is as long as one of y: a map
  bool clock = false;         ///< shows times, which differ from run to run
};

/// The colour of the series number `index` of a chart; eight differ, also for the colour-blind (Okabe and Ito).
render::Rgb series_colour(std::size_t index);

/// As many points or fewer, each the mean of its neighbours in equal parts of the series; the same where there are no more than `most`.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, std::size_t most);

/// A chart's size in both forms.
inline constexpr int kChartWidth_px = 900;
inline constexpr int kChartHeight_px = 540;

/// The chart as SVG 1.1. The same chart gives the same bytes.
std::string print_svg(const Chart& chart);

/// The chart as the bytes of a PNG file. The same chart gives the same bytes.
std::string print_png(const Chart& chart);

}  // namespace hallway::study
