// SPDX-License-Identifier: MIT
#include "sense/face_landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "base/error.hpp"
#include "base/random.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "sense/landmarks.hpp"
#include "sense/surface_clearance.hpp"

namespace hallway::sense {
namespace {

constexpr double kMaxPointsPerM2 = 1e6;

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

  /// Numbers of the squares that polygons with these vertices may touch, along both axes.
  struct Range {
    Eigen::Array2d first;
    Eigen::Array2d last;
    double count() const { return (last - first + 1.0).prod(); }
  };
  Range range(const std::vector<Vec3>& vertices) const {
    Eigen::Array2d low = Eigen::Array2d::Constant(HUGE_VAL);
    Eigen::Array2d high = -low;
    for (const Vec3& vertex : vertices) {
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

/// What the surface shows of one face of a solid.
struct ShownFace {
  std::uint32_t solid = 0;
  std::uint32_t face = 0;
  Plane plane{};                 ///< the normal points into the empty side
  std::vector<Vec3> vertices{};  ///< of all its polygons
};

/// The faces that have polygons on the surface, in the order of the world.
std::vector<ShownFace> shown_faces(const map::World& world, const csg::Surface& surface,
                                   const PolygonFilter& wanted) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < surface.polygons.size(); ++i) {
    if (!surface.polygons[i].vertices.empty() && (!wanted || wanted(i))) order.push_back(i);
  }
  const auto key = [&](std::uint32_t i) {
    return std::tuple(surface.polygons[i].solid, surface.polygons[i].face, i);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<ShownFace> faces;
  for (const std::uint32_t i : order) {
    const csg::SurfacePolygon& polygon = surface.polygons[i];
    if (faces.empty() || faces.back().solid != polygon.solid || faces.back().face != polygon.face) {
      Plane plane = world.solids[polygon.solid].faces[polygon.face].polygon.plane;
      if (plane.normal.dot(polygon.plane.normal) < 0.0) plane = {-plane.normal, -plane.offset};
      faces.push_back({polygon.solid, polygon.face, plane, {}});
    }
    for (const std::uint32_t vertex : polygon.vertices)
      faces.back().vertices.push_back(surface.vertices[vertex]);
  }
  return faces;
}

class FaceLandmarks {
 public:
  FaceLandmarks(const map::Document& document, const map::World& world, const csg::Surface& surface,
                const PolygonFilter& wanted, std::vector<Vec3>& landmarks)
      : document_(document),
        world_(world),
        clearance_(surface),
        wanted_(wanted),
        defaults_(map::face_points(document)),
        landmarks_(landmarks) {}

  void add(const ShownFace& face) {
    const map::Solid& solid = world_.solids[face.solid];
    const map::EntityKeys keys(document_, document_.entities[static_cast<std::size_t>(solid.entity)]);
    const double per_m2 = keys.number_or("_points_per_m2", defaults_.per_m2, 0.0, kMaxPointsPerM2);
    if (per_m2 == 0.0) return;
    const Squares squares(face.plane, per_m2, defaults_.seed);
    const Squares::Range range = squares.range(face.vertices);
    squares_tried_ += range.count();
    if (squares_tried_ > static_cast<double>(kMaxLandmarks)) {
      throw keys.error("the brushes' faces would have more than " + std::to_string(kMaxLandmarks) + " points",
                       "_points_per_m2");
    }
    add_points(face, squares, range);
  }

 private:
  void add_points(const ShownFace& face, const Squares& squares, const Squares::Range& range) {
    const auto rows = static_cast<std::uint64_t>(range.last[1] - range.first[1]) + 1;
    const auto columns = static_cast<std::uint64_t>(range.last[0] - range.first[0]) + 1;
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::uint64_t column = 0; column < columns; ++column) {
        const Vec3 on_face = squares.point(range.first[0] + static_cast<double>(column),
                                           range.first[1] + static_cast<double>(row));
        const auto polygon = clearance_.polygon_at(on_face, face.solid, face.face);
        if (!polygon || (wanted_ && !wanted_(*polygon))) continue;
        if (!clearance_.is_clear(on_face, *polygon, kFaceClearance_m)) continue;
        landmarks_.push_back(on_face + kFaceClearance_m * face.plane.normal);
      }
    }
  }

  const map::Document& document_;
  const map::World& world_;
  SurfaceClearance clearance_;
  const PolygonFilter& wanted_;
  map::FacePoints defaults_;
  double squares_tried_ = 0.0;
  std::vector<Vec3>& landmarks_;
};

}  // namespace

void add_face_landmarks(const map::Document& document, const map::World& world, const csg::Surface& surface,
                        const PolygonFilter& wanted, std::vector<Vec3>& landmarks) {
  FaceLandmarks faces(document, world, surface, wanted, landmarks);
  for (const ShownFace& face : shown_faces(world, surface, wanted)) faces.add(face);
}

}  // namespace hallway::sense
