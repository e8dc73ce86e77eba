// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/random.hpp"
#include "em/core/types.hpp"

namespace hallway::em::test {

/// Points on finite planes, and outliers (label kNoPlane).
struct LabelledPoints {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> labels;
};

/// A rectangle with normal noise in all directions.
struct Sheet {
  Vec3 centre, u, v;  ///< u and v unit and perpendicular
  double half_u, half_v;
  std::size_t points;
  double sigma;
};

/// Adds the points of a sheet under the next free label.
inline void add(LabelledPoints& cloud, const Sheet& sheet, std::uint32_t label) {
  const Random random(label, stream_id("test.em.sheet"));
  for (std::uint64_t i = 0; i < sheet.points; ++i) {
    const Vec3 noise(random.normal(0, 3 * i), random.normal(0, 3 * i + 1), random.normal(0, 3 * i + 2));
    cloud.points.push_back(sheet.centre + random.uniform(1, 2 * i, -sheet.half_u, sheet.half_u) * sheet.u +
                           random.uniform(1, 2 * i + 1, -sheet.half_v, sheet.half_v) * sheet.v +
                           sheet.sigma * noise);
    cloud.labels.push_back(label);
  }
}

/// Adds points evenly in a cube of that side at the origin.
inline void add_outliers(LabelledPoints& cloud, std::size_t count, double side, std::uint64_t seed) {
  const Random random(seed, stream_id("test.em.outliers"));
  for (std::uint64_t i = 0; i < count; ++i) {
    cloud.points.emplace_back(random.uniform(0, 3 * i, 0.0, side), random.uniform(0, 3 * i + 1, 0.0, side),
                              random.uniform(0, 3 * i + 2, 0.0, side));
    cloud.labels.push_back(kNoPlane);
  }
}

/// In a cube of 10: a floor, two walls that stand on it and meet at a corner, a table, a close pair of
/// slanted boards, of which one crosses a wall; 5 % outliers.
inline LabelledPoints room(double sigma = 0.02) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Vec3 slant = Vec3(0.0, 0.8, 0.6);
  const Vec3 above = slant.cross(x);
  LabelledPoints cloud;
  add(cloud, {{3.0, 3.0, 1.0}, x, y, 2.0, 2.0, 1600, sigma}, 0);
  add(cloud, {{1.0, 3.0, 2.0}, y, z, 2.0, 1.0, 800, sigma}, 1);
  add(cloud, {{3.0, 1.0, 2.0}, x, z, 2.0, 1.0, 800, sigma}, 2);
  add(cloud, {{3.5, 3.5, 1.8}, x, y, 0.8, 0.6, 300, sigma}, 3);
  add(cloud, {{6.0, 6.0, 6.0}, x, slant, 1.5, 1.0, 900, sigma}, 4);
  add(cloud, {Vec3(6.0, 6.0, 6.0) + 0.25 * above, x, slant, 1.5, 1.0, 700, sigma}, 5);
  add_outliers(cloud, 250, 10.0, 1);
  return cloud;
}

/// Rectangles anywhere in a cube of 6, at any angle, of 150 points each on average: most cross others, and a
/// tenth of each lies within the noise of another one. Labels from `scene` x `planes` on.
inline LabelledPoints crowd(std::uint32_t scene, std::uint32_t planes) {
  LabelledPoints cloud;
  for (std::uint32_t k = 0; k < planes; ++k) {
    const Random random(scene, stream_id("test.em.crowd"));
    std::uint64_t next = 16 * k;
    const auto number = [&](double low, double high) { return random.uniform(2, next++, low, high); };
    const Vec3 centre{number(1.0, 6.0), number(1.0, 6.0), number(1.0, 6.0)};  // braces: in this order
    const Vec3 axis{number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0)};
    const Vec3 u = axis.normalized();
    const Vec3 v = Eigen::AngleAxisd(number(-3.0, 3.0), u) * u.unitOrthogonal();
    const auto points = static_cast<std::size_t>(number(60.0, 240.0));
    add(cloud, {centre, u, v, number(0.5, 1.5), number(0.5, 1.5), points, 0.035}, scene * planes + k);
  }
  return cloud;
}

/// The order that a seed gives to `count` things.
inline std::vector<std::size_t> shuffled_order(std::size_t count, std::uint64_t seed) {
  const Random random(seed, stream_id("test.em.order"));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.bits(0, i)[0] % i]);
  return order;
}

/// Intersection over union of a plane's members with a label's points.
inline double overlap(const LabelledPoints& cloud, const Plane& plane, std::uint32_t label) {
  std::size_t both = 0;
  for (const PointIndex i : plane.members) both += cloud.labels[i] == label ? 1u : 0u;
  const auto labelled = static_cast<std::size_t>(std::count(cloud.labels.begin(), cloud.labels.end(), label));
  return static_cast<double>(both) / static_cast<double>(labelled + plane.members.size() - both);
}

/// The best overlap that any plane found has with a label's points.
inline double best_overlap(const LabelledPoints& cloud, const Extraction& found, std::uint32_t label) {
  double best = 0.0;
  for (const Plane& plane : found.planes) best = std::max(best, overlap(cloud, plane, label));
  return best;
}

/// Share of points that are with the same others in both results: each plane of the first is matched to the
/// plane of the second that holds most of its members.
inline double equal_membership(const Extraction& first, const Extraction& second) {
  std::size_t equal = 0;
  for (std::size_t j = 0; j <= first.planes.size(); ++j) {
    const std::uint32_t label = j < first.planes.size() ? static_cast<std::uint32_t>(j) : kNoPlane;
    std::vector<std::size_t> counts(second.planes.size() + 1, 0);
    for (std::size_t i = 0; i < first.labels.size(); ++i) {
      if (first.labels[i] == label) ++counts[std::min<std::size_t>(second.labels[i], second.planes.size())];
    }
    equal += label == kNoPlane ? counts.back() : *std::max_element(counts.begin(), counts.end());
  }
  return static_cast<double>(equal) / static_cast<double>(first.labels.size());
}

}  // namespace hallway::em::test
