// SPDX-License-Identifier: MIT
#include "sense/false_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/convex2.hpp"

namespace hallway::sense {
namespace {

constexpr double kMostSlant = std::numbers::pi / 3.0;
constexpr double kLeastSide_m = 0.1;
constexpr double kSides_m = 2.0;  ///< between the shortest and the longest

/// The numbers of one false plane.
class Draws {
 public:
  Draws(const Detection& detection, std::uint32_t reading, std::uint32_t element)
      : detection_(detection), reading_(reading), element_(element) {}

  double operator()(std::uint32_t which, double low, double high) const {
    return detection_.uniform(reading_, element_, which, low, high);
  }

 private:
  const Detection& detection_;
  std::uint32_t reading_, element_;
};

double side_of(const Draws& draw, const FalsePlaneSpec& spec) {
  const double least = std::max(spec.min_length_m, kLeastSide_m);
  return draw(3, least, least + kSides_m);
}

Vec3 middle_of(const Draws& draw, const FalsePlaneSpec& spec, const Vec3& direction) {
  const double range_m = draw(2, spec.view.min_range_m(), spec.view.max_range_m());
  return range_m / (spec.depths ? direction.x() : 1.0) * direction;
}

void set_plane(PlaneObservation& seen, const Vec3& middle, const Vec3& normal) {
  seen.true_plane = PlaneObservation::kNoPlane;
  seen.plane = {normal, std::min(normal.dot(middle), 0.0)};
  seen.centroid = middle;
}

}  // namespace

PlaneObservation false_wall(const Detection& detection, const FalsePlaneSpec& spec, std::uint32_t reading,
                            std::uint32_t element) {
  const Draws draw(detection, reading, element);
  const Vec3 direction = direction_in(spec.view, draw(0, 0.0, 1.0), 0.5);
  const Vec3 middle = middle_of(draw, spec, direction);
  const Eigen::Rotation2Dd slant(draw(4, -kMostSlant, kMostSlant));
  const Vec2 normal = (slant * Vec2(-direction.head<2>())).normalized();
  const Vec3 half_way = 0.5 * side_of(draw, spec) * Vec3(-normal.y(), normal.x(), 0.0);
  const Vec3 half_up = 0.5 * kSides_m * Vec3::UnitZ();
  PlaneObservation seen;
  set_plane(seen, middle, {normal.x(), normal.y(), 0.0});
  seen.corners = {middle - half_way - half_up, middle + half_way - half_up, middle + half_way + half_up,
                  middle - half_way + half_up};
  return seen;
}

PlaneObservation false_face(const Detection& detection, const FalsePlaneSpec& spec, std::uint32_t reading,
                            std::uint32_t element) {
  const Draws draw(detection, reading, element);
  const Vec3 direction = direction_in(spec.view, draw(0, 0.0, 1.0), draw(1, 0.0, 1.0));
  const Vec3 middle = middle_of(draw, spec, direction);
  const double slant = draw(4, 0.0, kMostSlant);
  const auto turned = [](const PlaneAxes& axes, double angle) {
    return Vec3(std::cos(angle) * axes.u + std::sin(angle) * axes.v);
  };
  const double turn = draw(5, 0.0, 2.0 * std::numbers::pi);
  const Vec3 normal =
      (-std::cos(slant) * direction + std::sin(slant) * turned(PlaneAxes(-direction), turn)).normalized();
  const Vec3 along = turned(PlaneAxes(normal), draw(6, 0.0, 2.0 * std::numbers::pi));
  const double half_m = 0.5 * side_of(draw, spec);
  const Vec3 u = half_m * along, v = half_m * normal.cross(along);
  PlaneObservation seen;
  set_plane(seen, middle, normal);
  seen.corners = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  seen.hull.assign(seen.corners.begin(), seen.corners.end());
  return seen;
}

}  // namespace hallway::sense
