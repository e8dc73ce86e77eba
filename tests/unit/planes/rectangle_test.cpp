// SPDX-License-Identifier: MIT
#include "planes/rectangle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace hallway::planes {
namespace {

Corners square(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {corner, corner + u, corner + u + v, corner + v};
}

const Corners kFloor = square(Vec3::Zero(), 2 * Vec3::UnitX(), 2 * Vec3::UnitY());

TEST(RectangleDistance, OfSimplePlaces) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(0.5, 0.5, 3), x, y)), 3) << "above";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(5, 0, 0), x, y)), 3) << "beside";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(1, 1, 0.5), x, z)), 0.5)
      << "an edge over the middle";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(1, 1, -0.5), x, z)), 0) << "through it";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(0, 0, 0), x, z)), 0) << "on its edge";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(3, 3, 0), x, z)), std::sqrt(2.0))
      << "corner to corner";
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, square(Vec3(1, -1, 1), Vec3(0, -1, 0), Vec3(2, 0, 0))),
                   std::sqrt(2.0))
      << "edges that cross in the view from above";
}

TEST(RectangleDistance, IsNeverMoreThanThatOfAnyTwoPoints) {
  const Random random(1, stream_id("rectangles"));
  for (std::uint32_t step = 0; step < 300; ++step) {
    std::uint64_t next = 0;
    const auto vector = [&](double size) {
      const double a = random.normal(step, next++), b = random.normal(step, next++);
      return Vec3(size * a, size * b, size * random.normal(step, next++));
    };
    const auto rectangle = [&] {
      const Vec3 u = vector(1.0), v = u.cross(vector(1.0));
      return square(vector(2.0), u, v);
    };
    const Corners a = rectangle(), b = rectangle();
    double sampled = 1e9;
    for (int i = 0; i <= 12; ++i) {
      for (int j = 0; j <= 12; ++j) {
        const Vec3 p = a[0] + i / 12.0 * (a[1] - a[0]) + j / 12.0 * (a[3] - a[0]);
        for (int k = 0; k <= 12; ++k) {
          for (int l = 0; l <= 12; ++l)
            sampled =
                std::min(sampled, (b[0] + k / 12.0 * (b[1] - b[0]) + l / 12.0 * (b[3] - b[0]) - p).norm());
        }
      }
    }
    const double size = (a[2] - a[0]).norm() + (b[2] - b[0]).norm();
    const double distance = rectangle_distance(a, b);
    EXPECT_LE(distance, sampled + 1e-12) << step;
    EXPECT_GE(distance, sampled - size / 12) << step;
    EXPECT_NEAR(rectangle_distance(b, a), distance, 1e-12);
  }
}

TEST(RectangleDistance, OfOnesWithoutWidth) {
  const Corners line = square(Vec3(0, 0, 1), Vec3::UnitX(), Vec3::Zero());
  EXPECT_DOUBLE_EQ(rectangle_distance(kFloor, line), 1);
  EXPECT_DOUBLE_EQ(rectangle_distance(line, line), 0);
}

}  // namespace
}  // namespace hallway::planes
