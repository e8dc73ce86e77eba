// SPDX-License-Identifier: MIT
#include "render/canvas.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace hallway::render {
namespace {

/// Opacity of what faces hide, as a share of its own.
constexpr double kHiddenShare = 0.24;
constexpr double kHaloOpacity = 0.75;
/// A line this much behind a face, in metres and as a share of the distance, still counts as lying on it.
constexpr double kOnFace_m = 0.03;
constexpr double kOnFaceShare = 0.004;

/// Levels of coverage: enough for smooth edges, and few enough for pictures to compress well.
constexpr double kCoverageLevels = 10.0;

double coverage_of(double signed_distance_px) {
  return std::round(kCoverageLevels * std::clamp(0.5 - signed_distance_px, 0.0, 1.0)) / kCoverageLevels;
}

double capsule(const Vec2& p, const Vec2& a, const Vec2& b, double radius) {
  const Vec2 ab = b - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm() - radius;
}

/// Signed distance to the rim of a square around the origin.
double square_rim(const Vec2& p, double radius) {
  const double half_line = std::clamp(0.1 * radius, 0.5, 2.0);
  return std::abs(p.cwiseAbs().maxCoeff() - (0.8 * radius - half_line)) - half_line;
}

/// Signed distance to a triangle around the origin with a corner at the top, of this inscribed circle; at its corners that to the corner's sides.
double triangle(const Vec2& p, double inner_radius) {
  constexpr double kCos30 = 0.86603;
  return std::max(p.y(), kCos30 * std::abs(p.x()) - 0.5 * p.y()) - inner_radius;
}

/// Signed distance to a mark around the origin, negative inside.
double mark_distance(MarkerShape shape, const Vec2& p, double radius) {
  switch (shape) {
    case MarkerShape::kDot:
      return p.norm() - radius;
    case MarkerShape::kRing: {
      const double half_line = std::clamp(0.16 * radius, 0.6, 3.0);
      return std::abs(p.norm() - (radius - half_line)) - half_line;
    }
    case MarkerShape::kCross: {
      const double half_line = std::clamp(0.2 * radius, 0.7, 3.0);
      const Vec2 arm = Vec2(0.7071, 0.7071) * (radius - half_line);
      const Vec2 other(arm.x(), -arm.y());
      return std::min(capsule(p, -arm, arm, half_line), capsule(p, -other, other, half_line));
    }
    case MarkerShape::kDiamond:
      return (std::abs(p.x()) + std::abs(p.y()) - radius) * 0.70711;
    case MarkerShape::kSquare:
      return std::max(std::abs(p.x()), std::abs(p.y())) - 0.8 * radius;
    case MarkerShape::kSquareWithCircle:
      return std::min(square_rim(p, radius), p.norm() - 0.38 * radius);
    case MarkerShape::kSquareWithTriangle:
      return std::min(square_rim(p, radius), triangle(p - Vec2(0.0, 0.08 * radius), 0.24 * radius));
  }
  return radius;
}

/// The part of the segment within `reach` of the rectangle, after Liang and Barsky; false if there is none.
bool clip_to(const PixelRect& rect, double reach, Vec2& a, Vec2& b, double& t0, double& t1) {
  t0 = 0.0;
  t1 = 1.0;
  const Vec2 d = b - a;
  const auto cut = [&](double p, double q) {
    if (p == 0.0) return q >= 0.0;
    const double t = q / p;
    if (p < 0.0)
      t0 = std::max(t0, t);
    else
      t1 = std::min(t1, t);
    return t0 <= t1;
  };
  const bool inside = cut(-d.x(), a.x() - (rect.left - reach)) && cut(d.x(), rect.right + reach - a.x()) &&
                      cut(-d.y(), a.y() - (rect.top - reach)) && cut(d.y(), rect.bottom + reach - a.y());
  if (!inside) return false;
  const Vec2 start = a;
  a = start + t0 * d;
  b = start + t1 * d;
  return true;
}

/// The distance at parameter t of a segment: its reciprocal is linear in the picture (a top view, where the distance
/// itself is, has nothing that hides).
double distance_at(const ScreenSegment& s, double t) {
  return 1.0 / ((1.0 - t) / s.from.distance_m + t / s.to.distance_m);
}

Vec2 pixel_centre(int x, int y) {
  return {x + 0.5, y + 0.5};
}

/// The distance of a plane of the world over the picture: its reciprocal is linear there.
class InverseDistance {
 public:
  /// From at least three corners of a polygon in the plane.
  explicit InverseDistance(std::span<const ScreenPoint> corners) {
    Eigen::Matrix3d places;
    Vec3 values;
    for (int i = 0; i < 3; ++i) {
      const ScreenPoint& corner = corners[static_cast<std::size_t>(i) * (corners.size() - 1) / 2];
      places.row(i) << corner.pixel.x(), corner.pixel.y(), 1.0;
      values[i] = 1.0 / corner.distance_m;
    }
    // Seen edge-on the polygon is a line, over which the least-squares answer is as good as any.
    linear_ = places.completeOrthogonalDecomposition().solve(values);
  }

  double distance_at(const Vec2& pixel) const { return 1.0 / linear_.dot(Vec3(pixel.x(), pixel.y(), 1.0)); }

 private:
  Vec3 linear_;
};

/// Signed distance in pixels from a convex polygon, negative inside; `sense` is the sign of its area.
double outside_of(std::span<const ScreenPoint> corners, double sense, const Vec2& place) {
  double outside = -1e300;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()].pixel - corners[i].pixel;
    const double length = edge.norm();
    if (length <= 0.0) continue;
    const Vec2 p = place - corners[i].pixel;
    outside = std::max(outside, sense * (edge.y() * p.x() - edge.x() * p.y()) / length);
  }
  return outside;
}

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

PixelRect pixels_around(const Vec2& low, const Vec2& high, double reach) {
  return {static_cast<int>(std::floor(low.x() - reach)), static_cast<int>(std::floor(low.y() - reach)),
          static_cast<int>(std::ceil(high.x() + reach)) + 1,
          static_cast<int>(std::ceil(high.y() + reach)) + 1};
}

PixelRect hull(const PixelRect& a, const PixelRect& b) {
  if (a.width() <= 0) return b;
  if (b.width() <= 0) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

}  // namespace

bool Occluders::hides(int x, int y, double distance) const {
  if (distance_m.empty() || x < area.left || y < area.top || x >= area.right || y >= area.bottom)
    return false;
  const std::size_t i = pixel_index(x - area.left, y - area.top, area.width());
  return distance * (1.0 - kOnFaceShare) - kOnFace_m > static_cast<double>(distance_m[i]);
}

Canvas::Canvas(Image& image) : image_(image), clip_{0, 0, image.width_px, image.height_px} {
  visible_.assign(image.bytes.size() / 3, 0.0f);
  hidden_ = visible_;
}

void Canvas::set_clip(const PixelRect& clip) {
  clip_ = intersection(clip, {0, 0, image_.width_px, image_.height_px});
}

void Canvas::blend(int x, int y, Rgb colour, double opacity) {
  image_.set(x, y, mix(image_.at(x, y), colour, opacity));
}

void Canvas::cover(const ScreenSegment& segment, double radius_px) {
  // A line thinner than a pixel is a fainter line of one pixel: it stays even instead of breaking into dots.
  const double radius = std::max(radius_px, 0.5);
  const float strength = static_cast<float>(std::min(1.0, 2.0 * radius_px));
  const Vec2 a = segment.from.pixel;
  const Vec2 ab = segment.to.pixel - a;
  const double squared = ab.squaredNorm();
  const PixelRect box = intersection(
      clip_, pixels_around(a.cwiseMin(segment.to.pixel), a.cwiseMax(segment.to.pixel), radius + 1.0));
  for_each_pixel(box, [&](int x, int y) {
    const Vec2 ap = pixel_centre(x, y) - a;
    const double t = squared > 0.0 ? std::clamp(ap.dot(ab) / squared, 0.0, 1.0) : 0.0;
    const double gap = (ap - t * ab).squaredNorm();
    if (gap >= (radius + 0.5) * (radius + 0.5)) return;
    const float coverage = strength * static_cast<float>(coverage_of(std::sqrt(gap) - radius));
    const bool behind = occluders_ != nullptr && occluders_->hides(x, y, distance_at(segment, t));
    float& value = (behind ? hidden_ : visible_)[pixel_index(x, y, image_.width_px)];
    value = std::max(value, coverage);
  });
}

void Canvas::composite(Rgb colour, double opacity, double hidden_share, const PixelRect& touched) {
  for_each_pixel(touched, [&](int x, int y) {
    const std::size_t i = pixel_index(x, y, image_.width_px);
    const double shown =
        std::max(static_cast<double>(visible_[i]), hidden_share * static_cast<double>(hidden_[i]));
    if (shown > 0.0) blend(x, y, colour, opacity * shown);
    visible_[i] = hidden_[i] = 0.0f;
  });
}

void Canvas::stroke_layer(std::span<const ScreenSegment> segments, const StrokeStyle& style,
                          double hidden_share) {
  const double radius = 0.5 * style.width_px;
  PixelRect touched;
  for (const ScreenSegment& segment : segments) {
    ScreenSegment part = segment;
    double t0 = 0.0;
    double t1 = 1.0;
    if (!clip_to(clip_, radius + 2.0, part.from.pixel, part.to.pixel, t0, t1)) continue;
    if (occluders_ != nullptr) {
      part.from.distance_m = distance_at(segment, t0);
      part.to.distance_m = distance_at(segment, t1);
    }
    // Long slanted lines are covered piece by piece, so that the cost follows the length and not the bounding box.
    const double length = (part.to.pixel - part.from.pixel).norm();
    const int pieces = 1 + static_cast<int>(length / 24.0);
    for (int k = 0; k < pieces; ++k) {
      const double s0 = static_cast<double>(k) / pieces;
      const double s1 = static_cast<double>(k + 1) / pieces;
      const Vec2 along = part.to.pixel - part.from.pixel;
      ScreenSegment piece{{part.from.pixel + s0 * along, part.from.distance_m},
                          {part.from.pixel + s1 * along, part.to.distance_m}};
      if (occluders_ != nullptr) {
        piece.from.distance_m = distance_at(part, s0);
        piece.to.distance_m = distance_at(part, s1);
      }
      cover(piece, radius);
    }
    const Vec2 low = part.from.pixel.cwiseMin(part.to.pixel);
    const Vec2 high = part.from.pixel.cwiseMax(part.to.pixel);
    touched = hull(touched, intersection(clip_, pixels_around(low, high, radius + 2.0)));
  }
  composite(style.colour, style.opacity, hidden_share, touched);
}

void Canvas::stroke(std::span<const ScreenSegment> segments, const StrokeStyle& style) {
  if (style.halo_px > 0.0) {
    // Behind faces a rim would only bleach them.
    stroke_layer(segments,
                 {palette::kPaper, style.width_px + 2.0 * style.halo_px, kHaloOpacity * style.opacity}, 0.0);
  }
  stroke_layer(segments, style, kHiddenShare);
}

void Canvas::fill_convex(std::span<const ScreenPoint> corners, Rgb colour, double opacity) {
  if (corners.size() < 3) return;
  double area = 0.0;
  Vec2 low = corners[0].pixel;
  Vec2 high = low;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i].pixel;
    const Vec2& b = corners[(i + 1) % corners.size()].pixel;
    area += a.x() * b.y() - a.y() * b.x();
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
  }
  const double sense = area < 0.0 ? -1.0 : 1.0;
  const Vec2 outer_low(clip_.left - 2.0, clip_.top - 2.0);
  const Vec2 outer_high(clip_.right + 2.0, clip_.bottom + 2.0);
  const PixelRect box =
      intersection(clip_, pixels_around(low.cwiseMax(outer_low).cwiseMin(outer_high),
                                        high.cwiseMax(outer_low).cwiseMin(outer_high), 1.0));
  const InverseDistance inverse(corners);
  for_each_pixel(box, [&](int x, int y) {
    const Vec2 centre = pixel_centre(x, y);
    const double coverage = coverage_of(outside_of(corners, sense, centre));
    if (coverage <= 0.0) return;
    const bool behind = occluders_ != nullptr && occluders_->hides(x, y, inverse.distance_at(centre));
    blend(x, y, colour, opacity * coverage * (behind ? kHiddenShare : 1.0));
  });
}

void Canvas::mark(const ScreenPoint& at, MarkerShape shape, Rgb colour, double size_px) {
  const double radius = 0.5 * size_px;
  const double reach = radius + 3.0;
  const Vec2& c = at.pixel;
  if (c.x() < clip_.left - reach || c.y() < clip_.top - reach || c.x() > clip_.right + reach ||
      c.y() > clip_.bottom + reach) {
    return;
  }
  const bool hidden =
      occluders_ != nullptr && occluders_->hides(static_cast<int>(std::floor(c.x())),
                                                 static_cast<int>(std::floor(c.y())), at.distance_m);
  const double opacity = hidden ? kHiddenShare : 1.0;
  const bool rim = size_px >= 4.0;
  const PixelRect box = intersection(clip_, pixels_around(c, c, radius + 2.0));
  for_each_pixel(box, [&](int x, int y) {
    const double distance = mark_distance(shape, pixel_centre(x, y) - c, radius);
    const double halo = coverage_of(distance - 1.0);
    if (rim && halo > 0.0) blend(x, y, palette::kPaper, kHaloOpacity * opacity * halo);
    const double coverage = coverage_of(distance);
    if (coverage > 0.0) blend(x, y, colour, opacity * coverage);
  });
}

void Canvas::text(const Font& font, std::string_view utf8, double size_px, const Vec2& origin_px,
                  Rgb colour) {
  const TextBitmap bitmap = font.render(utf8, size_px);
  const int left = static_cast<int>(std::lround(origin_px.x())) + bitmap.left;
  const int top = static_cast<int>(std::lround(origin_px.y())) + bitmap.top;
  const auto coverage_at = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= bitmap.width || row >= bitmap.height) return 0;
    return int{bitmap.coverage[pixel_index(column, row, bitmap.width)]};
  };
  const PixelRect box =
      intersection(clip_, {left - 2, top - 2, left + bitmap.width + 2, top + bitmap.height + 2});
  for_each_pixel(box, [&](int x, int y) {
    int rim = 0;
    for_each_pixel({-2, -2, 3, 3}, [&](int dx, int dy) {
      if (dx * dx + dy * dy <= 5) rim = std::max(rim, coverage_at(x - left + dx, y - top + dy));
    });
    if (rim > 0) blend(x, y, palette::kPaper, kHaloOpacity * rim / 255.0);
  });
  for_each_pixel(box, [&](int x, int y) {
    const int coverage = coverage_at(x - left, y - top);
    if (coverage > 0) blend(x, y, colour, coverage / 255.0);
  });
}

}  // namespace hallway::render
