// SPDX-License-Identifier: MIT
//
// A plan on paper: its parts in their order, dimension lines, title block.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "editor/plan.hpp"

namespace hallway::editor {
namespace {

constexpr double kMargin = 7.0;    ///< from the paper's edge to the frame, mm
constexpr double kFoot = 16.0;     ///< height of the title block
constexpr double kPad = 4.0;       ///< from the frame to what is drawn
constexpr double kOverall = 12.0;  ///< that the overall dimensions take, at the left and below
constexpr double kDimensionText = 2.2;

constexpr SheetColour kBlack{0, 0, 0}, kWhite{255, 255, 255}, kSolid{70, 70, 70}, kThin{110, 110, 110},
    kFaint{205, 210, 215}, kRoute{0, 90, 170}, kLamp{190, 120, 0}, kRobot{170, 0, 40};

struct PaperSize {
  std::string_view name{};
  double narrow_mm = 0.0, wide_mm = 0.0;
};
/// By size; the last one is a size of its own, which is not proposed.
constexpr std::array kPapers{PaperSize{"a4", 210.0, 297.0}, PaperSize{"a3", 297.0, 420.0},
                             PaperSize{"a2", 420.0, 594.0}, PaperSize{"a1", 594.0, 841.0},
                             PaperSize{"letter", 215.9, 279.4}};
constexpr std::array kScales{1.0,   2.0,   5.0,    10.0,   20.0,   25.0,    50.0,    100.0,   200.0,
                             250.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0, 50000.0, 100000.0};

const PaperSize& paper_size(const std::string& name) {
  const auto found = std::ranges::find_if(kPapers, [&](const PaperSize& one) { return one.name == name; });
  if (found == kPapers.end()) throw Error(ErrorCode::kInternal, "no such paper");
  return *found;
}

/// What a page has for the drawing itself.
Vec2 room_on(const Vec2& page, bool dimensions) {
  const double overall = dimensions ? kOverall : 0.0, rim = 2.0 * (kMargin + kPad) + overall;
  return {page.x() - rim, page.y() - rim - kFoot};
}

/// The page of that paper on which so much fits.
std::optional<Vec2> page_for(const PlanPaper& paper, const PaperSize& size, const Vec2& needed) {
  const Vec2 upright(size.narrow_mm, size.wide_mm), lying(size.wide_mm, size.narrow_mm);
  std::vector<Vec2> pages;
  if (paper.orientation != "landscape") pages.push_back(upright);
  if (paper.orientation != "portrait") pages.push_back(lying);
  if (pages.size() == 2 && needed.x() > needed.y()) std::swap(pages[0], pages[1]);
  for (const Vec2& page : pages) {
    const Vec2 room = room_on(page, paper.dimensions);
    if (needed.x() <= room.x() + 1e-6 && needed.y() <= room.y() + 1e-6) return page;
  }
  return std::nullopt;
}

[[noreturn]] void refuse_size(const PlanPaper& paper, const Vec2& size_m) {
  const PaperSize& own = paper_size(paper.name);
  std::vector<std::string> ways;
  for (std::size_t i = 0; i + 1 < kPapers.size() && ways.empty(); ++i) {
    if (kPapers[i].wide_mm > own.wide_mm && page_for(paper, kPapers[i], size_m * 1000.0 / paper.scale))
      ways.push_back(fmt::format("paper={}", kPapers[i].name));
  }
  for (const double scale : kScales) {
    if (scale <= paper.scale || !page_for(paper, own, size_m * 1000.0 / scale)) continue;
    ways.push_back(fmt::format("scale={}", sheet_number(scale)));
    break;
  }
  const Vec2 needed = size_m * 1000.0 / paper.scale;
  std::string message = fmt::format(
      "the plan is {:.2f} x {:.2f} m large, which is {:.0f} x {:.0f} mm at 1:{} and does not fit on {}{}",
      size_m.x(), size_m.y(), needed.x(), needed.y(), sheet_number(paper.scale), paper.name,
      paper.orientation == "auto" ? "" : " " + paper.orientation);
  for (std::size_t i = 0; i < ways.size(); ++i) message += (i == 0 ? "; it would with " : " or ") + ways[i];
  refuse(message);
}

/// Metres to the millimetre, with two decimals where those are enough.
std::string metres_text(double metres) {
  std::string text = fmt::format("{:.3f}", metres);
  if (text.back() == '0') text.pop_back();
  return text;
}

/// Draws a plan on a page.
class PlanDrawer {
 public:
  PlanDrawer(const FloorPlan& plan, const PlanPaper& paper)
      : plan_(plan), paper_(paper), bounds_(plan.bounds()) {
    const Vec2 size = bounds_.sizes();
    const auto page = page_for(paper, paper_size(paper.name), size * 1000.0 / paper.scale);
    if (!page) refuse_size(paper, size);
    sheet_.width_mm = page->x();
    sheet_.height_mm = page->y();
    sheet_.title = plan.title;
    mm_per_m_ = 1000.0 / paper.scale;
    const double overall = paper.dimensions ? kOverall : 0.0;
    const Vec2 corner(kMargin + kPad + overall, kMargin + kFoot + kPad + overall);
    shift_ = corner + room_on(*page, paper.dimensions) / 2.0 - bounds_.center() * mm_per_m_;
  }

  Sheet draw() {
    if (paper_.grid_m > 0.0) draw_grid();
    draw_below();
    draw_solid();
    draw_paths();
    draw_lights();
    draw_starts();
    if (paper_.dimensions) draw_dimensions();
    draw_names();
    draw_frame();
    return std::move(sheet_);
  }

 private:
  Vec2 on_paper(const Vec2& metres) const { return metres * mm_per_m_ + shift_; }

  void begin(const char* name) { sheet_.layers.push_back({.name = name}); }
  void line(std::vector<Vec2> points, const Pen& pen) {
    sheet_.layers.back().items.emplace_back(SheetLine{std::move(points), pen});
  }
  void area(std::vector<std::vector<Vec2>> loops, const SheetColour& colour) {
    sheet_.layers.back().items.emplace_back(SheetFill{std::move(loops), colour});
  }
  void text(SheetText one) { sheet_.layers.back().items.emplace_back(std::move(one)); }
  void circle(const Vec2& middle, double radius, const Pen& pen) {
    constexpr int kCorners = 32;
    std::vector<Vec2> points;
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
      points.push_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    line(std::move(points), pen);
  }

  static PlanBox box_of(const SheetText& one) {
    const double width = text_width_mm(one.text, one.size_mm);
    const double back = one.anchor == SheetText::Anchor::kMiddle ? width / 2.0 : 0.0;
    constexpr double kRim = 0.3;
    const double below = 0.22 * one.size_mm + kRim, above = 0.74 * one.size_mm + kRim;
    if (one.upwards) return {one.at - Vec2(above, back + kRim), one.at + Vec2(below, width - back + kRim)};
    return {one.at - Vec2(back + kRim, below), one.at + Vec2(width - back + kRim, above)};
  }

  /// A text on white, where it covers no earlier one if there is such a place nearby.
  void label(SheetText one, bool may_move) {
    const Vec2 step = one.upwards ? Vec2(-1.3 * one.size_mm, 0.0) : Vec2(0.0, -1.3 * one.size_mm);
    const Vec2 wanted = one.at;
    const auto is_free = [&] {
      return std::ranges::none_of(
          labels_, [box = box_of(one)](const PlanBox& other) { return box.intersects(other); });
    };
    for (const double steps : {0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0, -4.0}) {
      one.at = wanted + steps * step;
      if (!may_move || is_free()) break;
      if (steps == -4.0) one.at = wanted;
    }
    const PlanBox box = box_of(one);
    labels_.push_back(box);
    area({{box.min(), Vec2(box.max().x(), box.min().y()), box.max(), Vec2(box.min().x(), box.max().y())}},
         kWhite);
    text(std::move(one));
  }

  void draw_grid() {
    const double cell = paper_.grid_m;
    if (cell * mm_per_m_ < 1.0) {
      refuse(
          "grid: lines {} m apart are {:.2f} mm apart at 1:{}; from {} m on they can be "
          "distinguished",
          sheet_number(cell), cell * mm_per_m_, sheet_number(paper_.scale),
          sheet_number(paper_.scale / 1000.0));
    }
    begin("grid");
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const double last = std::floor(bounds_.max()[axis] / cell + 1e-9);
      for (double i = std::ceil(bounds_.min()[axis] / cell - 1e-9); i <= last; i += 1.0) {
        Vec2 from = bounds_.min(), to = bounds_.max();
        from[axis] = to[axis] = i * cell;
        line({on_paper(from), on_paper(to)}, {.colour = kFaint, .width_mm = 0.1});
      }
    }
  }

  void draw_below() {
    begin("below");
    for (const PlanLine& edge : plan_.below)
      line({on_paper(edge.from), on_paper(edge.to)}, {.colour = kThin, .width_mm = 0.13});
  }

  void draw_solid() {
    begin("solid");
    std::vector<std::vector<Vec2>> loops;
    for (const auto& loop : plan_.section.loops) {
      auto& points = loops.emplace_back();
      for (const Vec2& point : loop) points.push_back(on_paper(point));
    }
    const auto outlines = loops;
    area(std::move(loops), kSolid);
    for (auto points : outlines) {
      points.push_back(points.front());
      line(std::move(points), {.colour = kBlack, .width_mm = 0.25});
    }
  }

  void draw_paths() {
    begin("paths");
    for (const auto& path : plan_.paths) {
      std::vector<Vec2> points;
      for (const Vec2& point : path) points.push_back(on_paper(point));
      line(std::move(points), {.colour = kRoute, .width_mm = 0.25, .dash_mm = 2.0, .gap_mm = 1.2});
    }
  }

  void draw_lights() {
    begin("lights");
    for (const Vec2& light : plan_.lights) {
      const Vec2 at = on_paper(light);
      const Pen pen{.colour = kLamp, .width_mm = 0.2};
      constexpr double kRadius = 1.2;
      circle(at, kRadius, pen);
      for (const double y : {-1.0, 1.0}) {
        const Vec2 arm = kRadius * std::numbers::sqrt2 / 2.0 * Vec2(1.0, y);
        line({at - arm, at + arm}, pen);
      }
    }
  }

  void draw_starts() {
    if (plan_.starts.empty()) return;
    begin("start");
    for (const PlanStart& start : plan_.starts) {
      const Vec2 at = on_paper(start.at), ahead = start.ahead;
      const Vec2 left(-ahead.y(), ahead.x());
      const Pen pen{.colour = kRobot, .width_mm = 0.35};
      circle(at, 1.6, pen);
      line({at, at + 4.0 * ahead}, pen);
      area({{at + 5.2 * ahead, at + 3.4 * ahead + 0.8 * left, at + 3.4 * ahead - 0.8 * left}}, kRobot);
    }
  }

  /// A line between two places on paper with its ends ticked, and a measure over it.
  void dimension(const Vec2& from, const Vec2& to, double metres) {
    const Vec2 along = (to - from).normalized();
    const Pen pen{.colour = kBlack, .width_mm = 0.13};
    const bool upwards = std::abs(along.y()) > std::abs(along.x());
    const Vec2 aside = upwards ? Vec2(-0.8, 0.0) : Vec2(0.0, 0.8);
    label({.at = (from + to) / 2.0 + aside,
           .text = metres_text(metres),
           .size_mm = kDimensionText,
           .anchor = SheetText::Anchor::kMiddle,
           .upwards = upwards},
          false);
    line({from, to}, pen);
    for (const Vec2& end : {from, to})
      line({end - Vec2(0.7, 0.7), end + Vec2(0.7, 0.7)}, {.colour = kBlack, .width_mm = 0.25});
  }

  void draw_dimensions() {
    begin("dimensions");
    for (const PlanLine& width : plan_.widths) {
      const double metres = (width.to - width.from).norm();
      if (metres * mm_per_m_ > text_width_mm(metres_text(metres), kDimensionText) + 3.0)
        dimension(on_paper(width.from), on_paper(width.to), metres);
    }
    const PlanBox solid = plan_.section.bounds();
    const Vec2 low = on_paper(solid.min()), high = on_paper(solid.max());
    const Vec2 edge = on_paper(bounds_.min());
    const double y = edge.y() - 7.0, x = edge.x() - 7.0;
    const Pen pen{.colour = kBlack, .width_mm = 0.1};
    for (const double at : {low.x(), high.x()}) line({{at, edge.y() - 1.0}, {at, y - 1.5}}, pen);
    for (const double at : {low.y(), high.y()}) line({{edge.x() - 1.0, at}, {x - 1.5, at}}, pen);
    dimension({low.x(), y}, {high.x(), y}, solid.sizes().x());
    dimension({x, low.y()}, {x, high.y()}, solid.sizes().y());
  }

  void draw_names() {
    begin("names");
    for (const PlanName& name : plan_.names) {
      SheetText one{.at = on_paper(name.at),
                    .text = name.text,
                    .size_mm = name.beside ? 2.0 : 2.5,
                    .anchor = SheetText::Anchor::kMiddle,
                    .upwards = name.upwards};
      if (name.beside) {
        one.at += name.upwards ? Vec2(-1.0, 0.0) : Vec2(0.0, 1.0);
      } else {
        one.at.y() -= 0.35 * one.size_mm;
      }
      label(std::move(one), true);
    }
  }

  void draw_frame() {
    begin("title-block");
    const double right = sheet_.width_mm - kMargin, top = sheet_.height_mm - kMargin;
    const Pen pen{.colour = kBlack, .width_mm = 0.35};
    line({{kMargin, kMargin}, {right, kMargin}, {right, top}, {kMargin, top}, {kMargin, kMargin}}, pen);
    line({{kMargin, kMargin + kFoot}, {right, kMargin + kFoot}}, pen);
    const double x = kMargin + 4.0, wide = right - kMargin - 115.0;
    const double size = std::clamp(4.5 * wide / std::max(text_width_mm(plan_.title, 4.5), 1e-3), 1.5, 4.5);
    text({.at = {x, kMargin + 6.2}, .text = plan_.title, .size_mm = size});
    const double facts = right - 105.0;
    text({.at = {facts, kMargin + 9.2},
          .text = fmt::format("Scale 1:{} ({})", sheet_number(paper_.scale), paper_.name),
          .size_mm = 2.8});
    text({.at = {facts, kMargin + 4.2},
          .text = fmt::format("Cut at {} m; lengths in m", metres_text(plan_.height_m)),
          .size_mm = 2.2});
    draw_scale_bar({right - 62.0, kMargin + 5.0});
    draw_north({right - 7.0, kMargin + 3.0});
  }

  /// The longest of 1, 2, 5, 10, ... metres that has room, in parts.
  void draw_scale_bar(const Vec2& at) {
    constexpr double kLongest = 45.0, kHigh = 1.6;
    double metres = 1e-3;
    int parts = 5;
    for (double decade = 1e-3; decade < 1e7; decade *= 10.0) {
      for (const int digit : {1, 2, 5}) {
        if (digit * decade * mm_per_m_ > kLongest + 1e-9) continue;
        metres = digit * decade;
        parts = digit == 2 ? 4 : 5;
      }
    }
    const double width = metres * mm_per_m_, part = width / parts;
    for (int i = 0; i < parts; i += 2) {
      const Vec2 low = at + Vec2(i * part, 0.0), high = low + Vec2(part, kHigh);
      area({{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}, kBlack);
    }
    const Vec2 far = at + Vec2(width, kHigh);
    line({at, {far.x(), at.y()}, far, {at.x(), far.y()}, at}, {.colour = kBlack, .width_mm = 0.2});
    const auto number = [&](double x, std::string words) {
      text({.at = at + Vec2(x, kHigh + 1.2),
            .text = std::move(words),
            .size_mm = 2.2,
            .anchor = SheetText::Anchor::kMiddle});
    };
    number(0.0, "0");
    number(width, sheet_number(metres) + " m");
  }

  /// North is where y grows.
  void draw_north(const Vec2& at) {
    area({{at, at + Vec2(1.8, -0.8), at + Vec2(0.0, 6.0), at + Vec2(-1.8, -0.8)}}, kBlack);
    text({.at = at + Vec2(0.0, 7.0), .text = "N", .size_mm = 3.0, .anchor = SheetText::Anchor::kMiddle});
  }

  const FloorPlan& plan_;
  const PlanPaper& paper_;
  PlanBox bounds_;
  Sheet sheet_;
  double mm_per_m_ = 20.0;
  Vec2 shift_ = Vec2::Zero();
  std::vector<PlanBox> labels_;
};

}  // namespace

Sheet draw_plan(const FloorPlan& plan, const PlanPaper& paper) {
  return PlanDrawer(plan, paper).draw();
}

}  // namespace hallway::editor
