// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "geometry/se3.hpp"
#include "render/image.hpp"
#include "render/view.hpp"

namespace hallway::render {

/// A place in a picture. Pixel (i, j) covers [i, i+1) x [j, j+1); y runs down.
struct ScreenPoint {
  Vec2 pixel = Vec2::Zero();
  double distance_m = 0.0;  ///< along the viewing direction, from the eye or from the camera's plane
};

/// Maps world points to pixels.
class Camera {
 public:
  /// A camera at `eye` (world). The rows of `right_down_forward` are its axes in the world. Parallel: `scale` is pixels per
  /// metre; else it is the focal length in pixels. `centre_px` is where the viewing axis meets the picture.
  Camera(ViewKind kind, const Vec3& eye, const Eigen::Matrix3d& right_down_forward, double scale,
         const Vec2& centre_px);

  ViewKind kind() const { return kind_; }
  const Vec3& eye() const { return eye_; }
  const Eigen::Matrix3d& axes() const { return axes_; }
  double scale() const { return scale_; }
  const Vec2& centre_px() const { return centre_px_; }

  /// Coordinates in the camera's frame: right, down, forward; metres.
  Vec3 to_camera(const Vec3& world) const { return axes_ * (world - eye_); }
  /// A point in the camera's frame to the picture; in perspective `camera.z()` must be positive.
  ScreenPoint from_camera(const Vec3& camera) const;
  /// The place of a world point; empty if it is not finite or, in perspective, nearer than near_m() or behind the eye.
  std::optional<ScreenPoint> project(const Vec3& world) const;
  /// The world point at a place of the picture; inverse of project().
  Vec3 unproject(const ScreenPoint& screen) const;
  /// Pixels per metre at a distance (anywhere in a top view).
  double pixels_per_metre(double distance_m) const;
  /// Nearest distance that a perspective shows, metres.
  static constexpr double near_m() { return 0.02; }

 private:
  ViewKind kind_;
  Vec3 eye_;
  Eigen::Matrix3d axes_;
  double scale_;
  Vec2 centre_px_;
};

/// The camera for a view into the rectangle `area`, framed around `content` (world points) where the view leaves it open.
/// Throws Error{kBadInput} for a view that shows nothing: a target equal to the eye, an eye without a target, an angle of
/// view outside (0, pi), a crop without width, a number that is not finite.
Camera make_camera(const View& view, const PixelRect& area, std::span<const Vec3> content);

/// True for points that can be drawn: finite and within 1e9 m of the origin.
bool drawable(const Vec3& point);

}  // namespace hallway::render
