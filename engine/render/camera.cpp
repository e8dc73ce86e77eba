// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.hpp"

namespace hallway::render {
namespace {

constexpr double kFarthestCoordinate_m = 1e9;
/// Room left free on each side of the map area by automatic framing.
constexpr double kMarginShare = 0.045;
/// Half the smallest extent that is framed, so that one point alone still has a scale.
constexpr double kSmallestHalfExtent_m = 0.5;

Error bad_view(const char* message) {
  return Error(ErrorCode::kBadInput, message, {"", 0, "view"});
}

Vec2 middle(const PixelRect& area) {
  return {0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom)};
}

/// Rows right, down, forward of a viewer who looks along `forward` (unit) and keeps the horizon level; straight up or
/// down, the picture's right is the world's x.
Eigen::Matrix3d level_axes(const Vec3& forward) {
  Vec3 right = forward.cross(Vec3::UnitZ());
  right = right.norm() < 1e-9 ? Vec3::UnitX() : Vec3(right.normalized());
  Eigen::Matrix3d axes;
  axes.row(0) = right;
  axes.row(1) = forward.cross(right);
  axes.row(2) = forward;
  return axes;
}

Camera make_top_camera(const View& view, const PixelRect& area, std::span<const Vec3> content) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : content) box.extend(point);
  if (box.isEmpty()) box.extend(Vec3(Vec3::Zero()));
  const double usable = 1.0 - 2.0 * kMarginShare;
  Vec2 centre = box.center().head<2>();
  double metres_per_pixel = std::max(
      std::max(box.sizes().x(), 2.0 * kSmallestHalfExtent_m) / (usable * std::max(1, area.width())),
      std::max(box.sizes().y(), 2.0 * kSmallestHalfExtent_m) / (usable * std::max(1, area.height())));
  if (view.crop) {
    centre = view.crop->centre;
    metres_per_pixel = view.crop->width_m / std::max(1, area.width());
  }
  const double top = box.max().z() + 1.0;
  return Camera(ViewKind::kTop, {centre.x(), centre.y(), top}, level_axes(-Vec3::UnitZ()),
                1.0 / metres_per_pixel, middle(area));
}

/// How far along an axis, and how far back, the viewer must stand for the content to fit between two planes through the
/// eye: solves |side - shift| <= slope * (depth + back) for the smallest `back`.
struct Fit {
  double shift = 0.0, back = 0.0;
};

Fit fit_between(std::span<const Vec3> points, int axis, double slope) {
  double positive = -1e300;
  double negative = -1e300;
  for (const Vec3& p : points) {
    positive = std::max(positive, p[axis] - slope * p.z());
    negative = std::max(negative, -p[axis] - slope * p.z());
  }
  return {0.5 * (positive - negative), 0.5 * (positive + negative) / slope};
}

Camera make_perspective_camera(const View& view, const PixelRect& area, std::span<const Vec3> content) {
  const double focal_px = 0.5 * std::max(1, area.height()) / std::tan(0.5 * view.vertical_fov);
  if (view.eye) {
    const Vec3 forward = (*view.target - *view.eye).normalized();
    return Camera(ViewKind::kPerspective, *view.eye, level_axes(forward), focal_px, middle(area));
  }
  const Vec3 forward(-std::cos(view.elevation) * std::cos(view.azimuth),
                     -std::cos(view.elevation) * std::sin(view.azimuth), -std::sin(view.elevation));
  const Eigen::Matrix3d axes = level_axes(forward);
  Eigen::AlignedBox3d box;
  for (const Vec3& point : content) box.extend(point);
  if (box.isEmpty()) box.extend(Vec3(Vec3::Zero()));
  const Vec3 target = view.target ? *view.target : Vec3(box.center());
  std::vector<Vec3> turned;
  turned.reserve(content.size() + 1);
  for (const Vec3& point : content) turned.push_back(axes * (point - target));
  if (turned.empty()) turned.push_back(Vec3::Zero());

  const double usable = 1.0 - 2.0 * kMarginShare;
  const Fit right = fit_between(turned, 0, usable * 0.5 * std::max(1, area.width()) / focal_px);
  const Fit down = fit_between(turned, 1, usable * 0.5 * std::max(1, area.height()) / focal_px);
  const double back = std::max({right.back, down.back, 2.0 * kSmallestHalfExtent_m});
  const Vec3 offset(view.target ? 0.0 : right.shift, view.target ? 0.0 : down.shift, -back);
  return Camera(ViewKind::kPerspective, target + axes.transpose() * offset, axes, focal_px, middle(area));
}

void check_view(const View& view) {
  if (view.cut_z_m && !std::isfinite(*view.cut_z_m))
    throw bad_view("the height of the cut is not a finite number");
  if (view.crop) {
    const Vec3 centre(view.crop->centre.x(), view.crop->centre.y(), 0.0);
    if (!drawable(centre)) throw bad_view("the centre of the crop is not a finite place");
    const double width = view.crop->width_m;
    if (!(width >= 1e-3 && width <= kFarthestCoordinate_m)) {
      throw bad_view("the width of the crop must be between 0.001 and 1e9 m");
    }
  }
  if (view.kind != ViewKind::kPerspective) return;
  if (!(view.vertical_fov > 1e-3 && view.vertical_fov < 3.1)) {
    throw bad_view("the vertical angle of view must be between 0.001 and 3.1 rad");
  }
  if (!(std::abs(view.azimuth) <= 1e6 && std::abs(view.elevation) <= 1e6)) {
    throw bad_view("azimuth and elevation must be finite");
  }
  if (view.eye && !view.target) throw bad_view("an eye needs a target to look at");
  if (view.eye && !drawable(*view.eye)) throw bad_view("the eye is not a finite place");
  if (view.target && !drawable(*view.target)) throw bad_view("the target is not a finite place");
  if (view.eye && (*view.target - *view.eye).norm() < 1e-9)
    throw bad_view("eye and target are the same place");
}

}  // namespace

Camera::Camera(ViewKind kind, const Vec3& eye, const Eigen::Matrix3d& right_down_forward, double scale,
               const Vec2& centre_px)
    : kind_(kind), eye_(eye), axes_(right_down_forward), scale_(scale), centre_px_(centre_px) {}

ScreenPoint Camera::from_camera(const Vec3& camera) const {
  const double scale = pixels_per_metre(camera.z());
  return {centre_px_ + scale * camera.head<2>(), camera.z()};
}

std::optional<ScreenPoint> Camera::project(const Vec3& world) const {
  if (!drawable(world)) return std::nullopt;
  const Vec3 camera = to_camera(world);
  if (kind_ == ViewKind::kPerspective && camera.z() < near_m()) return std::nullopt;
  return from_camera(camera);
}

Vec3 Camera::unproject(const ScreenPoint& screen) const {
  const Vec2 side = (screen.pixel - centre_px_) / pixels_per_metre(screen.distance_m);
  return eye_ + axes_.transpose() * Vec3(side.x(), side.y(), screen.distance_m);
}

double Camera::pixels_per_metre(double distance_m) const {
  return kind_ == ViewKind::kTop ? scale_ : scale_ / distance_m;
}

bool drawable(const Vec3& point) {
  // Written so that NaN fails.
  return point.cwiseAbs().maxCoeff() <= kFarthestCoordinate_m && point.allFinite();
}

Camera make_camera(const View& view, const PixelRect& area, std::span<const Vec3> content) {
  check_view(view);
  return view.kind == ViewKind::kTop ? make_top_camera(view, area, content)
                                     : make_perspective_camera(view, area, content);
}

}  // namespace hallway::render
