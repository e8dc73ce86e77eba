// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::test {

/// Random numbers one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, stream_id("test")) {}
  double uniform(double low, double high) { return random_.uniform(0, next_++, low, high); }
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(uniform(0.0, static_cast<double>(count)));
  }
  Vec3 point(double half_size) {
    const double x = uniform(-half_size, half_size);
    const double y = uniform(-half_size, half_size);
    return {x, y, uniform(-half_size, half_size)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 inside = point(1.0);
      if (inside.norm() > 0.1 && inside.norm() < 1.0) return inside.normalized();
    }
  }
  Quat rotation() { return Quat(Eigen::AngleAxisd(uniform(0.0, 3.14), direction())); }

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

inline Plane plane_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).normalized();
  return {normal, normal.dot(a)};
}

/// A convex body by its faces, counter-clockwise from outside.
using Body = std::vector<Polygon>;

/// A prism over a regular polygon, about the pose's z axis and centred on it.
inline Body prism(int sides, double radius, double height, const Pose& pose) {
  std::vector<Vec3> low;
  std::vector<Vec3> high;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / sides;
    const Vec3 rim(radius * std::cos(angle), radius * std::sin(angle), 0.5 * height);
    high.push_back(pose * rim);
    low.push_back(pose * Vec3(rim.x(), rim.y(), -rim.z()));
  }
  Body body;
  body.push_back({high, plane_through(high[0], high[1], high[2])});
  body.push_back({{low.rbegin(), low.rend()}, plane_through(low[2], low[1], low[0])});
  for (std::size_t i = 0; i < low.size(); ++i) {
    const std::size_t j = (i + 1) % low.size();
    body.push_back({{low[i], low[j], high[j], high[i]}, plane_through(low[i], low[j], high[j])});
  }
  return body;
}

/// A box between two corners.
inline Body box(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int x, int y, int z) {
    return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  const auto face = [](const std::vector<Vec3>& v) { return Polygon{v, plane_through(v[0], v[1], v[2])}; };
  return {face({corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)}),
          face({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}),
          face({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}),
          face({corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)}),
          face({corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}),
          face({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)})};
}

inline trace::TriangleMesh mesh_of(const std::vector<Body>& bodies) {
  trace::TriangleMesh mesh;
  for (const Body& body : bodies) {
    for (const Polygon& face : body) mesh.add_polygon(face);
  }
  return mesh;
}

/// Prisms of all kinds, a third of them plates of 2 mm, within `size` metres of `centre`.
inline std::vector<Body> clutter(Draw& draw, int count, double size, const Vec3& centre) {
  std::vector<Body> bodies;
  for (int i = 0; i < count; ++i) {
    const Pose pose{draw.rotation(), centre + draw.point(size)};
    const int sides = 3 + static_cast<int>(draw.index(6));
    const double radius = size * draw.uniform(0.01, 0.2);
    const double height = i % 3 == 0 ? 0.002 : size * draw.uniform(0.01, 0.4);
    bodies.push_back(prism(sides, radius, height, pose));
  }
  return bodies;
}

}  // namespace hallway::test
