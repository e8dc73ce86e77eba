// SPDX-License-Identifier: MIT
#include "render/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "render/canvas.hpp"
#include "render/layout.hpp"
#include "render/shading.hpp"
#include "render/surface_pass.hpp"

namespace hallway::render {
namespace {

/// Pictures up to this many pixels are drawn at twice their resolution.
constexpr std::int64_t kFinePixels = 5ll << 20;
constexpr double kPathHalo_px = 0.9;
constexpr double kDash_px = 9.0;
constexpr double kDashGap_px = 6.0;

// ---- what has to fit into the picture -------------------------------------------------------------------------------

void add_drawable(std::vector<Vec3>& out, const Vec3& point) {
  if (drawable(point)) out.push_back(point);
}

std::vector<Vec3> line_and_mark_points(const Picture& picture) {
  std::vector<Vec3> points;
  for (const Segments& segments : picture.segments) {
    for (const auto& pair : segments.pairs) {
      add_drawable(points, pair[0]);
      add_drawable(points, pair[1]);
    }
  }
  for (const Polyline& line : picture.polylines) {
    for (const Vec3& point : line.points) add_drawable(points, point);
  }
  for (const Markers& markers : picture.markers) {
    for (const Vec3& point : markers.positions) add_drawable(points, point);
  }
  for (const Patches& patches : picture.patches) {
    for (const auto& polygon : patches.polygons) {
      for (const Vec3& corner : polygon) add_drawable(points, corner);
    }
  }
  for (const Label& label : picture.labels) add_drawable(points, label.position);
  for (const FrustumMark& mark : picture.frustums) add_drawable(points, mark.T_world_sensor.t);
  return points;
}

/// Leaves out what lies far from nearly everything else, so that one stray landmark does not shrink the rest to a dot.
void drop_strays(std::vector<Vec3>& points) {
  constexpr std::size_t kLeastCount = 50;
  constexpr double kTail = 0.02;
  constexpr double kSlack = 0.4;
  if (points.size() < kLeastCount) return;
  Vec3 low, high;
  std::vector<double> values(points.size());
  const auto rank = [&](double share) {
    return static_cast<std::ptrdiff_t>(share * static_cast<double>(points.size() - 1));
  };
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [axis](const Vec3& p) { return p[axis]; });
    std::nth_element(values.begin(), values.begin() + rank(kTail), values.end());
    low[axis] = values[static_cast<std::size_t>(rank(kTail))];
    std::nth_element(values.begin(), values.begin() + rank(1.0 - kTail), values.end());
    high[axis] = values[static_cast<std::size_t>(rank(1.0 - kTail))];
  }
  const double slack = kSlack * (high - low).maxCoeff();
  const Eigen::AlignedBox3d keep(low - Vec3::Constant(slack), high + Vec3::Constant(slack));
  std::erase_if(points, [&](const Vec3& p) { return !keep.contains(p); });
}

std::vector<Vec3> content_points(const Picture& picture, const View& view) {
  std::vector<Vec3> points = line_and_mark_points(picture);
  drop_strays(points);
  for (const Surface& surface : picture.surfaces) {
    for (Vec3 corner : surface.polygon.vertices) {
      if (view.cut_z_m) corner.z() = std::min(corner.z(), *view.cut_z_m);
      add_drawable(points, corner);
    }
  }
  return points;
}

// ---- lines ----------------------------------------------------------------------------------------------------------

/// The part of a world line that is before the camera, in the picture.
std::optional<ScreenSegment> project_segment(const Camera& camera, const Vec3& a, const Vec3& b) {
  if (!drawable(a) || !drawable(b)) return std::nullopt;
  Vec3 from = camera.to_camera(a);
  Vec3 to = camera.to_camera(b);
  if (camera.kind() == ViewKind::kPerspective) {
    constexpr double kNear = Camera::near_m();
    if (from.z() < kNear && to.z() < kNear) return std::nullopt;
    if (from.z() < kNear) from = from + (kNear - from.z()) / (to.z() - from.z()) * (to - from);
    if (to.z() < kNear) to = to + (kNear - to.z()) / (from.z() - to.z()) * (from - to);
  }
  return ScreenSegment{camera.from_camera(from), camera.from_camera(to)};
}

/// The part of a convex polygon that is not above a height.
std::vector<Vec3> below(const std::vector<Vec3>& polygon, double height_m) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& from = polygon[i];
    const Vec3& to = polygon[(i + 1) % polygon.size()];
    if (from.z() <= height_m) out.push_back(from);
    if ((from.z() <= height_m) != (to.z() <= height_m)) {
      out.push_back(from + (height_m - from.z()) / (to.z() - from.z()) * (to - from));
    }
  }
  return out;
}

/// The part of a flat convex polygon that is before the camera, in the picture; empty where there is none.
std::vector<ScreenPoint> project_polygon(const Camera& camera, const std::vector<Vec3>& polygon) {
  constexpr double kNear = Camera::near_m();
  std::vector<ScreenPoint> out;
  if (!std::all_of(polygon.begin(), polygon.end(), drawable)) return out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 from = camera.to_camera(polygon[i]);
    const Vec3 to = camera.to_camera(polygon[(i + 1) % polygon.size()]);
    const bool clipped = camera.kind() == ViewKind::kPerspective;
    if (!clipped || from.z() >= kNear) out.push_back(camera.from_camera(from));
    if (clipped && (from.z() < kNear) != (to.z() < kNear)) {
      out.push_back(camera.from_camera(from + (kNear - from.z()) / (to.z() - from.z()) * (to - from)));
    }
  }
  return out;
}

std::vector<ScreenSegment> project_line(const Camera& camera, const std::vector<Vec3>& points) {
  std::vector<ScreenSegment> out;
  if (points.size() == 1) {
    if (const auto dot = project_segment(camera, points[0], points[0])) out.push_back(*dot);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (const auto segment = project_segment(camera, points[i - 1], points[i])) out.push_back(*segment);
  }
  return out;
}

/// Splits a chain of segments into dashes of even length on the picture. What lies outside `area` is left out, which also
/// bounds the number of dashes.
std::vector<ScreenSegment> dashes(const std::vector<ScreenSegment>& chain, double width_px,
                                  const PixelRect& area) {
  const double dash = kDash_px + width_px;
  const double period = dash + kDashGap_px + width_px;
  const Eigen::AlignedBox2d frame(Vec2(area.left, area.top), Vec2(area.right, area.bottom));
  std::vector<ScreenSegment> out;
  double phase = 0.0;
  for (const ScreenSegment& s : chain) {
    const double length = (s.to.pixel - s.from.pixel).norm();
    Eigen::AlignedBox2d reach(s.from.pixel);
    reach.extend(s.to.pixel);
    const bool far_longer_than_picture = length > 64.0 * (area.width() + area.height() + 1);
    if (!frame.intersects(reach) || far_longer_than_picture) {
      phase = std::fmod(phase + length, period);
      continue;
    }
    const auto at = [&](double along) {
      const double t = length > 0.0 ? along / length : 0.0;
      return ScreenPoint{s.from.pixel + t * (s.to.pixel - s.from.pixel),
                         s.from.distance_m + t * (s.to.distance_m - s.from.distance_m)};
    };
    for (double start = -phase; start < length; start += period) {
      const double from = std::max(0.0, start);
      const double to = std::min(length, start + dash);
      if (to > from) out.push_back({at(from), at(to)});
    }
    phase = std::fmod(phase + length, period);
  }
  return out;
}

// ---- the parts of the picture ---------------------------------------------------------------------------------------

class Drawing {
 public:
  Drawing(const Picture& picture, const View& view, int width_px, int height_px)
      : picture_(picture),
        view_(view),
        layout_(make_layout(picture, width_px, height_px, fonts_)),
        content_(content_points(picture, view)),
        camera_(make_camera(view, layout_.map, content_)) {}

  const Layout& layout() const { return layout_; }
  const Camera& camera() const { return camera_; }

  Image paint(int width_px, int height_px) {
    Image image = blank_image(width_px, height_px);
    Canvas canvas(image);
    canvas.set_clip(layout_.map);
    const double grid_m = paint_grid(canvas);
    paint_surfaces(image, canvas);
    paint_patches(canvas);
    for (const FrustumMark& mark : picture_.frustums) paint_frustum(canvas, mark);
    paint_lines(canvas);
    paint_marks(canvas);
    paint_robot(canvas);
    canvas.set_occluders(nullptr);
    paint_labels(canvas);
    if (content_.empty()) paint_nothing(canvas);
    paint_furniture(canvas, picture_, layout_, camera_, width_px, height_px, grid_m, fonts_);
    return image;
  }

 private:
  bool has_surfaces() const { return !picture_.surfaces.empty(); }

  /// A faint grid of round metres on the ground: everywhere in a top view, else under content that has no faces to tell
  /// where the ground is. Returns its width, 0 for none.
  double paint_grid(Canvas& canvas) const {
    if (!layout_.furniture || content_.empty()) return 0.0;
    if (camera_.kind() == ViewKind::kPerspective && has_surfaces()) return 0.0;
    Eigen::AlignedBox3d box;
    for (const Vec3& point : content_) box.extend(point);
    double ground = box.min().z();
    if (camera_.kind() == ViewKind::kTop) {
      box = Eigen::AlignedBox3d(camera_.unproject({Vec2(layout_.map.left, layout_.map.bottom), 0.0}));
      box.extend(camera_.unproject({Vec2(layout_.map.right, layout_.map.top), 0.0}));
      ground = 0.0;
    }
    const double width = round_down_125(std::max(1e-3, box.sizes().head<2>().maxCoeff()) / 5.0);
    const Vec2 first = (box.min().head<2>() / width).array().floor();
    const Vec2 last = (box.max().head<2>() / width).array().ceil();
    std::vector<ScreenSegment> lines;
    const auto add = [&](const Vec2& from, const Vec2& to) {
      const auto line = project_segment(camera_, {from.x() * width, from.y() * width, ground},
                                        {to.x() * width, to.y() * width, ground});
      if (line) lines.push_back(*line);
    };
    for (double i = first.x(); i <= last.x(); i += 1.0) add({i, first.y()}, {i, last.y()});
    for (double i = first.y(); i <= last.y(); i += 1.0) add({first.x(), i}, {last.x(), i});
    canvas.stroke(lines, {mix(palette::kPaper, palette::kMutedInk, 0.16), layout_.unit});
    return width;
  }

  void paint_surfaces(Image& image, Canvas& canvas) {
    if (!has_surfaces()) {
      paint_shadows(canvas);
      return;
    }
    const std::int64_t pixels = std::int64_t{layout_.map.width()} * layout_.map.height();
    SurfaceLayer layer =
        render_surfaces(picture_.surfaces, camera_, layout_.map, pixels <= kFinePixels ? 2 : 1, view_);
    const unsigned threads = hardware_threads();
    darken_corners(layer, camera_, threads);
    outline_faces(layer, threads);
    copy_to_image(layer, image);
    if (camera_.kind() == ViewKind::kPerspective) {
      occluders_ = make_occluders(layer);
      canvas.set_occluders(&occluders_);
    }
  }

  /// In perspective, paths over the bare grid cast a line on it that shows how high they run.
  void paint_shadows(Canvas& canvas) const {
    if (camera_.kind() != ViewKind::kPerspective || content_.empty()) return;
    double ground = content_.front().z();
    for (const Vec3& point : content_) ground = std::min(ground, point.z());
    for (const Polyline& line : picture_.polylines) {
      std::vector<Vec3> points = line.points;
      for (Vec3& point : points) point.z() = std::isfinite(point.z()) ? ground : point.z();
      canvas.stroke(project_line(camera_, points),
                    {mix(palette::kPaper, palette::kMutedInk, 0.3), std::min(2.0, line.width_px)});
    }
  }

  void paint_patches(Canvas& canvas) const {
    for (const Patches& patches : picture_.patches) {
      std::vector<ScreenSegment> rims;
      for (const auto& polygon : patches.polygons) {
        const std::vector<Vec3> shown = view_.cut_z_m ? below(polygon, *view_.cut_z_m) : polygon;
        canvas.fill_convex(project_polygon(camera_, shown), patches.colour,
                           std::clamp(patches.opacity, 0.0, 1.0));
        for (std::size_t i = 0; i < shown.size(); ++i) {
          const auto rim = project_segment(camera_, shown[i], shown[(i + 1) % shown.size()]);
          if (rim) rims.push_back(*rim);
        }
      }
      if (patches.outline_px > 0.0) canvas.stroke(rims, {patches.colour, patches.outline_px, 0.85, 0.0});
    }
  }

  void paint_lines(Canvas& canvas) const {
    for (const Segments& bundle : picture_.segments) {
      std::vector<ScreenSegment> lines;
      for (const auto& pair : bundle.pairs) {
        if (const auto line = project_segment(camera_, pair[0], pair[1])) lines.push_back(*line);
      }
      canvas.stroke(lines, {bundle.colour, bundle.width_px, std::clamp(bundle.opacity, 0.0, 1.0), 0.0});
    }
    for (const Polyline& line : picture_.polylines) {
      std::vector<ScreenSegment> chain = project_line(camera_, line.points);
      if (line.dashed) chain = dashes(chain, line.width_px, layout_.map);
      canvas.stroke(chain, {line.colour, line.width_px, 1.0, kPathHalo_px});
    }
  }

  void paint_marks(Canvas& canvas) const {
    for (const Markers& markers : picture_.markers) {
      for (const Vec3& position : markers.positions) {
        if (const auto at = camera_.project(position))
          canvas.mark(*at, markers.shape, markers.colour, markers.size_px);
      }
    }
  }

  /// The direction in the sensor's frame at the given angles left and up.
  static Vec3 direction(double left, double up) {
    return {std::cos(up) * std::cos(left), std::cos(up) * std::sin(left), std::sin(up)};
  }

  void paint_frustum(Canvas& canvas, const FrustumMark& mark) const {
    const bool shown = drawable(mark.T_world_sensor.t) && mark.T_world_sensor.q.coeffs().allFinite() &&
                       mark.range_m > 0.0 && mark.range_m < 1e9 && std::isfinite(mark.horizontal_fov) &&
                       std::isfinite(mark.vertical_fov);
    if (!shown) return;
    const double half_width = std::clamp(0.5 * mark.horizontal_fov, 0.0, std::numbers::pi);
    const double half_height = std::clamp(0.5 * mark.vertical_fov, 0.0, 0.5 * std::numbers::pi);
    paint_field(canvas, mark, half_width);
    if (camera_.kind() == ViewKind::kTop) {
      paint_field_rim(canvas, mark, half_width, 0.0);
      return;
    }
    for (const double up : {-half_height, half_height}) paint_field_rim(canvas, mark, half_width, up);
    paint_field_sides(canvas, mark, half_width, half_height);
  }

  static constexpr int kArcSteps = 24;

  Vec3 field_point(const FrustumMark& mark, double left, double up) const {
    return mark.T_world_sensor * Vec3(mark.range_m * direction(left, up));
  }

  /// The level middle of the field of view, filled, in pieces narrow enough to be convex.
  void paint_field(Canvas& canvas, const FrustumMark& mark, double half_width) const {
    constexpr int kPieces = 4;
    const int pieces = half_width > 1.5 ? kPieces : 1;
    for (int piece = 0; piece < pieces; ++piece) {
      std::vector<ScreenPoint> corners;
      const auto add = [&](const Vec3& world) {
        if (const auto at = camera_.project(world)) corners.push_back(*at);
      };
      add(mark.T_world_sensor.t);
      for (int i = 0; i <= kArcSteps; ++i) {
        const double share = (piece + static_cast<double>(i) / kArcSteps) / pieces;
        add(field_point(mark, half_width * (2.0 * share - 1.0), 0.0));
      }
      if (corners.size() == kArcSteps + 2) canvas.fill_convex(corners, mark.colour, 0.13);
    }
  }

  void paint_field_rim(Canvas& canvas, const FrustumMark& mark, double half_width, double up) const {
    std::vector<Vec3> rim{mark.T_world_sensor.t};
    for (int i = 0; i <= 2 * kArcSteps; ++i) {
      rim.push_back(field_point(mark, half_width * (static_cast<double>(i) / kArcSteps - 1.0), up));
    }
    rim.push_back(mark.T_world_sensor.t);
    canvas.stroke(project_line(camera_, rim), {mark.colour, 1.3, 0.75, 0.0});
  }

  void paint_field_sides(Canvas& canvas, const FrustumMark& mark, double half_width,
                         double half_height) const {
    for (const double left : {-half_width, half_width}) {
      std::vector<Vec3> side;
      for (int i = 0; i <= kArcSteps; ++i) {
        side.push_back(field_point(mark, left, half_height * (2.0 * i / kArcSteps - 1.0)));
      }
      canvas.stroke(project_line(camera_, side), {mark.colour, 1.3, 0.75, 0.0});
    }
  }

  /// A dart that points where the robot looks; its size on the picture is fixed.
  void paint_robot(Canvas& canvas) const {
    if (picture_.frustums.empty() || !picture_.frustums.front().T_world_sensor.q.coeffs().allFinite()) return;
    const FrustumMark& mark = picture_.frustums.front();
    const auto at = camera_.project(mark.T_world_sensor.t);
    if (!at) return;
    const double step_m = 1e-3 / camera_.pixels_per_metre(at->distance_m);
    const auto ahead = camera_.project(mark.T_world_sensor * Vec3(step_m, 0.0, 0.0));
    Vec2 forward = ahead ? Vec2((ahead->pixel - at->pixel) / 1e-3) : Vec2(Vec2::Zero());
    if (forward.norm() < 0.25) {
      canvas.mark(*at, MarkerShape::kDot, palette::kInk, 11.0 * layout_.unit);
      return;
    }
    forward.normalize();
    const Vec2 side(-forward.y(), forward.x());
    paint_dart(canvas, *at, forward, side, 15.0 * layout_.unit, palette::kPaper);
    paint_dart(canvas, *at, forward, side, 11.0 * layout_.unit, palette::kInk);
  }

  static void paint_dart(Canvas& canvas, const ScreenPoint& at, const Vec2& forward, const Vec2& side,
                         double size, Rgb colour) {
    const double distance = at.distance_m;
    const Vec2 nose = at.pixel + size * forward;
    const Vec2 notch = at.pixel - 0.35 * size * forward;
    for (const double hand : {-1.0, 1.0}) {
      const Vec2 tail = at.pixel - 0.8 * size * forward + hand * 0.7 * size * side;
      const std::array<ScreenPoint, 3> half{{{nose, distance}, {notch, distance}, {tail, distance}}};
      canvas.fill_convex(half, colour, 1.0);
    }
  }

  void paint_labels(Canvas& canvas) const {
    if (!layout_.furniture) return;
    std::vector<Eigen::AlignedBox2d> taken;
    for (const Label& label : picture_.labels) {
      const auto at = camera_.project(label.position);
      const std::string text = printable(label.text, 80);
      if (!at || text.empty()) continue;
      const double width = fonts_.bold.width_px(text, layout_.text_px);
      if (const auto box = free_box(at->pixel, width, taken)) {
        const Vec2 base(box->min().x(), box->max().y() - 0.28 * layout_.text_px);
        canvas.text(fonts_.bold, text, layout_.text_px, base, label.colour);
        taken.push_back(*box);
      }
    }
  }

  /// The first place around an anchor where a text covers no other one and stays in the map area.
  std::optional<Eigen::AlignedBox2d> free_box(const Vec2& anchor, double width,
                                              const std::vector<Eigen::AlignedBox2d>& taken) const {
    const Vec2 half(0.5 * width, 0.65 * layout_.text_px);
    const double gap = 8.0 * layout_.unit;
    const Vec2 beside(half.x() + gap, 0.0);
    const Vec2 above(0.0, -half.y() - gap);
    const std::array<Vec2, 8> offsets{above,          -above,         beside,         -beside,
                                      above + beside, above - beside, beside - above, -above - beside};
    const Eigen::AlignedBox2d map(Vec2(layout_.map.left, layout_.map.top),
                                  Vec2(layout_.map.right, layout_.map.bottom));
    for (const Vec2& offset : offsets) {
      const Eigen::AlignedBox2d box(anchor + offset - half, anchor + offset + half);
      const bool is_free =
          map.contains(box) &&
          std::none_of(taken.begin(), taken.end(), [&](const auto& other) { return other.intersects(box); });
      if (is_free) return box;
    }
    return std::nullopt;
  }

  void paint_nothing(Canvas& canvas) const {
    if (!layout_.furniture) return;
    constexpr std::string_view kText = "nothing to show";
    const Vec2 middle(0.5 * (layout_.map.left + layout_.map.right),
                      0.5 * (layout_.map.top + layout_.map.bottom));
    const double width = fonts_.regular.width_px(kText, layout_.text_px);
    canvas.text(fonts_.regular, kText, layout_.text_px, middle - Vec2(0.5 * width, 0.0), palette::kMutedInk);
  }

  const Picture& picture_;
  const View& view_;
  Fonts fonts_;
  Layout layout_;
  std::vector<Vec3> content_;
  Camera camera_;
  Occluders occluders_;
};

}  // namespace

Image draw(const Picture& picture, const View& view, int width_px, int height_px) {
  check_image_size(width_px, height_px);
  return Drawing(picture, view, width_px, height_px).paint(width_px, height_px);
}

PixelRect map_area(const Picture& picture, int width_px, int height_px) {
  check_image_size(width_px, height_px);
  return make_layout(picture, width_px, height_px, Fonts()).map;
}

Camera picture_camera(const Picture& picture, const View& view, int width_px, int height_px) {
  check_image_size(width_px, height_px);
  return Drawing(picture, view, width_px, height_px).camera();
}

}  // namespace hallway::render
