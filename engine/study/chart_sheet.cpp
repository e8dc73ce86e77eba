// SPDX-License-Identifier: MIT
#include "study/chart_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "render/font.hpp"

namespace hallway::study {
namespace {

using render::Font;
namespace palette = render::palette;

constexpr double kText = 13.0;
constexpr double kTitle = 15.0;
constexpr render::Rgb kGrid{224, 221, 212};

/// "thesis, figures 137, 145"
std::string figures_text(const std::string& figures) {
  const bool several = figures.find_first_of(",-") != std::string::npos;
  return std::string("thesis, figure") + (several ? "s " : " ") + printable(figures);
}

/// Puts a chart's parts where they belong.
class Layouter {
 public:
  explicit Layouter(const Chart& chart) : chart_(chart) {
    sheet_.frame_low = {78.0, 66.0};
    sheet_.frame_high = {kChartWidth_px - 22.0, kChartHeight_px - 52.0 - legend_height()};
    sheet_.x = range_of(0, chart.x);
    sheet_.y = range_of(1, chart.y);
    if (chart.equal_scales) make_scales_equal();
  }

  ChartSheet lay_out() {
    add_axis(0, ticks_of(sheet_.x, chart_.x, 9));
    add_axis(1, ticks_of(sheet_.y, chart_.y, 8));
    add_series();
    add_frame();
    add_texts();
    add_legend();
    return std::move(sheet_);
  }

 private:
  AxisRange range_of(Eigen::Index index, const Axis& axis) const {
    if (!axis.names.empty()) return {-0.5, static_cast<double>(axis.names.size()) - 0.5};
    std::vector<double> values;
    for (const Series& series : chart_.series) {
      for (const Vec2& point : series.points) {
        if (shown(point)) values.push_back(point[index]);
      }
    }
    return axis_range(values, axis.log);
  }

  /// Widens the range that has the larger scale.
  void make_scales_equal() {
    const Vec2 room = sheet_.frame_high - sheet_.frame_low;
    const double per_px =
        std::max((sheet_.x.high - sheet_.x.low) / room.x(), (sheet_.y.high - sheet_.y.low) / room.y());
    const auto widen = [&](AxisRange& range, double px) {
      const double middle = 0.5 * (range.low + range.high), half = 0.5 * per_px * px;
      range = {middle - half, middle + half};
    };
    widen(sheet_.x, room.x());
    widen(sheet_.y, room.y());
  }

  static std::vector<Tick> ticks_of(const AxisRange& range, const Axis& axis, int most) {
    std::vector<Tick> named;
    for (const std::string& name : axis.names)
      named.push_back({static_cast<double>(named.size()), printable(name)});
    if (!named.empty()) return named;
    return axis.log ? log_ticks(range, most) : linear_ticks(range, most, axis.counts ? 1.0 : 0.0);
  }

  bool shown(const Vec2& point) const {
    return point.allFinite() && !(chart_.x.log && point.x() <= 0.0) && !(chart_.y.log && point.y() <= 0.0);
  }

  static double share(double value, const AxisRange& range, bool log) {
    if (log) return std::log(value / range.low) / std::log(range.high / range.low);
    return (value - range.low) / (range.high - range.low);
  }

  double x_px(double value) const {
    return sheet_.frame_low.x() +
           share(value, sheet_.x, chart_.x.log) * (sheet_.frame_high.x() - sheet_.frame_low.x());
  }
  double y_px(double value) const {
    return sheet_.frame_high.y() -
           share(value, sheet_.y, chart_.y.log) * (sheet_.frame_high.y() - sheet_.frame_low.y());
  }

  void line(std::vector<Vec2> points, const render::Rgb& colour, double width, bool dashed, bool clipped) {
    sheet_.pieces.emplace_back(SheetLine{std::move(points), colour, width, dashed, clipped});
  }
  void words(const Vec2& at, std::string text, SheetWords::Anchor anchor, bool bold = false,
             double size = kText, render::Rgb colour = palette::kInk) {
    sheet_.pieces.emplace_back(SheetWords{at, std::move(text), size, anchor, bold, colour});
  }

  void add_axis(int axis, const std::vector<Tick>& ticks) {
    const Vec2 low = sheet_.frame_low, high = sheet_.frame_high;
    for (const Tick& tick : ticks) {
      if (axis == 0) {
        const double x = x_px(tick.value);
        line({{x, low.y()}, {x, high.y()}}, kGrid, 1.0, false, false);
        line({{x, high.y()}, {x, high.y() + 5.0}}, palette::kInk, 1.0, false, false);
        words({x, high.y() + 19.0}, tick.text, SheetWords::Anchor::kMiddle);
      } else {
        const double y = y_px(tick.value);
        line({{low.x(), y}, {high.x(), y}}, kGrid, 1.0, false, false);
        line({{low.x() - 5.0, y}, {low.x(), y}}, palette::kInk, 1.0, false, false);
        words({low.x() - 9.0, y + 4.5}, tick.text, SheetWords::Anchor::kEnd);
      }
    }
  }

  void add_frame() {
    const Vec2 low = sheet_.frame_low, high = sheet_.frame_high;
    line({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, palette::kMutedInk, 1.0, false, false);
  }

  void add_series() {
    for (const Series& series : chart_.series) {
      if (series.style == SeriesStyle::kMarks) {
        SheetDots dots{.colour = series.colour};
        for (const Vec2& point : series.points) {
          if (shown(point)) dots.places.emplace_back(x_px(point.x()), y_px(point.y()));
        }
        sheet_.pieces.emplace_back(std::move(dots));
        continue;
      }
      std::vector<Vec2> part;
      const auto end_part = [&] {
        if (part.size() > 1)
          line(std::move(part), series.colour, 1.8, series.style == SeriesStyle::kDashed, true);
        part.clear();
      };
      for (const Vec2& point : series.points) {
        if (shown(point)) {
          part.emplace_back(x_px(point.x()), y_px(point.y()));
        } else {
          end_part();
        }
      }
      end_part();
    }
  }

  void add_texts() {
    const double right = sheet_.frame_high.x();
    const double most = right - 12.0;
    words({12.0, 24.0}, bold_.shortened(printable(chart_.title), kTitle, most), SheetWords::Anchor::kStart,
          true, kTitle);
    words({12.0, 52.0}, regular_.shortened(printable(chart_.y.label), kText, 0.6 * most),
          SheetWords::Anchor::kStart);
    if (!chart_.figures.empty()) {
      words({right, 52.0}, figures_text(chart_.figures), SheetWords::Anchor::kEnd, false, 12.0,
            palette::kMutedInk);
    }
    words({right, sheet_.frame_high.y() + 40.0}, printable(chart_.x.label), SheetWords::Anchor::kEnd);
  }

  /// Names of series and where each begins in its row: rows are filled from the left.
  struct Entry {
    const Series* series;
    std::string text;
    double x;
    int row;
  };

  std::vector<Entry> legend() const {
    constexpr double kSample = 34.0, kGap = 22.0;
    std::vector<Entry> entries;
    double x = 78.0;
    int row = 0;
    for (const Series& series : chart_.series) {
      if (series.name.empty()) continue;
      const std::string text = regular_.shortened(printable(series.name), kText, 360.0);
      const double width = kSample + regular_.width_px(text, kText) + kGap;
      if (x + width > kChartWidth_px && x > 78.0) {
        x = 78.0;
        ++row;
      }
      entries.push_back({&series, text, x, row});
      x += width;
    }
    return entries;
  }

  double legend_height() const {
    const auto entries = legend();
    return entries.empty() ? 0.0 : 20.0 * (entries.back().row + 1);
  }

  void add_legend() {
    const double top = kChartHeight_px - legend_height() + 8.0;
    for (const Entry& entry : legend()) {
      const double y = top + 20.0 * entry.row;
      const Series& series = *entry.series;
      if (series.style == SeriesStyle::kMarks) {
        sheet_.pieces.emplace_back(SheetDots{{{entry.x + 13.0, y - 4.0}}, series.colour});
      } else {
        line({{entry.x, y - 4.0}, {entry.x + 26.0, y - 4.0}}, series.colour, 2.2,
             series.style == SeriesStyle::kDashed, false);
      }
      words({entry.x + 34.0, y}, entry.text, SheetWords::Anchor::kStart);
    }
  }

  const Chart& chart_;
  Font regular_{Font::Weight::kRegular};
  Font bold_{Font::Weight::kBold};
  ChartSheet sheet_;
};

}  // namespace

ChartSheet lay_out(const Chart& chart) {
  return Layouter(chart).lay_out();
}

}  // namespace hallway::study
