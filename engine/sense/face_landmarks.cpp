// SPDX-License-Identifier: MIT
#include "sense/face_landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "sense/landmarks.hpp"

namespace hallway::sense {
namespace {

constexpr double kMaxPointsPerM2 = 1e6;

/// A point of a face stands exactly kFaceClearance_m off a coinciding face of another solid: a hair more for
/// solids before its own and a hair less for those after it gives such points to the first solid.
constexpr double kHair_m = 1e-6;

/// A number that a plane keeps however its brush is edited otherwise.
std::uint32_t plane_number(const Plane& plane) {
  constexpr double kNormalStep = 1e-6;
  constexpr double kOffsetStep_m = 1e-4;
  std::string name;
  for (const double component : plane.normal)
    name += std::to_string(std::llround(component / kNormalStep)) + " ";
  return stream_id(name + std::to_string(std::llround(plane.offset / kOffsetStep_m)));
}

double unit_interval(std::uint32_t high, std::uint32_t low) {
  return static_cast<double>((std::uint64_t{high} << 21) | (low >> 11)) * 0x1.0p-53;
}

/// The squares that cover a plane, with a random point in each.
class Squares {
 public:
  Squares(const Plane& plane, double per_m2, std::uint64_t seed)
      : plane_(plane),
        u_((std::abs(plane.normal.z()) > 0.9 ? Vec3::UnitY() : Vec3::UnitZ())
               .cross(plane.normal)
               .normalized()),
        v_(plane.normal.cross(u_)),
        side_m_(1.0 / std::sqrt(per_m2)),
        random_(seed, stream_id("landmarks.face")),
        plane_number_(plane_number(plane)) {}

  /// Numbers of the squares that a polygon of the plane may touch, along both axes.
  struct Range {
    Eigen::Array2d first;
    Eigen::Array2d last;
    double count() const { return (last - first + 1.0).prod(); }
  };
  Range range(const Polygon& polygon) const {
    Eigen::Array2d low = Eigen::Array2d::Constant(HUGE_VAL);
    Eigen::Array2d high = -low;
    for (const Vec3& vertex : polygon.vertices) {
      const Eigen::Array2d at(u_.dot(vertex), v_.dot(vertex));
      low = low.min(at);
      high = high.max(at);
    }
    return {(low / side_m_).floor(), (high / side_m_).floor()};
  }

  /// The random point of a square, on the plane.
  Vec3 point(double column, double row) const {
    const auto low_bits = [](double number) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(number)) & 0xFFFFFFFFu;
    };
    const auto bits = random_.bits(plane_number_, low_bits(column) << 32 | low_bits(row));
    const double x = (column + unit_interval(bits[0], bits[1])) * side_m_;
    const double y = (row + unit_interval(bits[2], bits[3])) * side_m_;
    return x * u_ + y * v_ + plane_.offset * plane_.normal;
  }

 private:
  Plane plane_;
  Vec3 u_;
  Vec3 v_;
  double side_m_;
  Random random_;
  std::uint32_t plane_number_;
};

/// Whether a point of the polygon's plane is inside and clear of its edges.
bool clear_of_edges(const Polygon& polygon, const Vec3& point) {
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec3& from = polygon.vertices[i];
    const Vec3 edge = polygon.vertices[(i + 1) % polygon.vertices.size()] - from;
    if (polygon.plane.normal.cross(edge).dot(point - from) < kFaceClearance_m * edge.norm()) return false;
  }
  return true;
}

/// The other solids near enough to one to matter to its points.
class Neighbours {
 public:
  Neighbours(const map::World& world, std::size_t solid) : own_(&world.solids[solid]) {
    Box reach = own_->box;
    reach.min().array() -= 4.0 * kFaceClearance_m;
    reach.max().array() += 4.0 * kFaceClearance_m;
    for (const map::Solid& other : world.solids) {
      if (&other != own_ && reach.intersects(other.box)) near_.push_back(&other);
    }
  }

  bool block(const Vec3& point) const {
    return std::any_of(near_.begin(), near_.end(), [&](const map::Solid* other) {
      return other->contains(point, -(kFaceClearance_m + (other < own_ ? kHair_m : -kHair_m)));
    });
  }

 private:
  const map::Solid* own_;
  std::vector<const map::Solid*> near_;
};

class FaceLandmarks {
 public:
  FaceLandmarks(const map::Document& document, const map::World& world, std::vector<Vec3>& landmarks)
      : document_(document), world_(world), defaults_(map::face_points(document)), landmarks_(landmarks) {}

  void add_solid(std::size_t index) {
    const map::Solid& solid = world_.solids[index];
    const map::EntityKeys keys(document_, document_.entities[static_cast<std::size_t>(solid.entity)]);
    const double per_m2 = keys.number_or("_points_per_m2", defaults_.per_m2, 0.0, kMaxPointsPerM2);
    if (per_m2 == 0.0) return;
    const Neighbours neighbours(world_, index);
    for (const map::SolidFace& face : solid.faces) {
      const Squares squares(face.polygon.plane, per_m2, defaults_.seed);
      const Squares::Range range = squares.range(face.polygon);
      squares_tried_ += range.count();
      if (squares_tried_ > static_cast<double>(kMaxLandmarks)) {
        throw keys.error(
            "the brushes' faces would have more than " + std::to_string(kMaxLandmarks) + " points",
            "_points_per_m2");
      }
      add_face(face.polygon, squares, range, neighbours);
    }
  }

 private:
  void add_face(const Polygon& polygon, const Squares& squares, const Squares::Range& range,
                const Neighbours& neighbours) {
    const auto rows = static_cast<std::uint64_t>(range.last[1] - range.first[1]) + 1;
    const auto columns = static_cast<std::uint64_t>(range.last[0] - range.first[0]) + 1;
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::uint64_t column = 0; column < columns; ++column) {
        const Vec3 on_face = squares.point(range.first[0] + static_cast<double>(column),
                                           range.first[1] + static_cast<double>(row));
        if (!clear_of_edges(polygon, on_face)) continue;
        const Vec3 landmark = on_face + kFaceClearance_m * polygon.plane.normal;
        if (!neighbours.block(landmark)) landmarks_.push_back(landmark);
      }
    }
  }

  const map::Document& document_;
  const map::World& world_;
  map::FacePoints defaults_;
  double squares_tried_ = 0.0;
  std::vector<Vec3>& landmarks_;
};

}  // namespace

void add_face_landmarks(const map::Document& document, const map::World& world,
                        std::vector<Vec3>& landmarks) {
  FaceLandmarks faces(document, world, landmarks);
  for (std::size_t i = 0; i < world.solids.size(); ++i) faces.add_solid(i);
}

}  // namespace hallway::sense
