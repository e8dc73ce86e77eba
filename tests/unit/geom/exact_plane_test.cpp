// SPDX-License-Identifier: MIT
#include "geom/exact_plane.hpp"

#include <gtest/gtest.h>

#include <map>

#include "random_planes.hpp"
#include "rational.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using test::kPlaneKinds;
using test::PlaneKind;
using test::RandomPoints;
using test::rational;
using test::Rational3;
using Side = PlaneSet::Side;

/// A set of planes of one kind, and points that three of them share.
struct Scene {
  PlaneSet planes;
  std::vector<ExactPoint> points;
  std::vector<Rational3> places;  ///< of the points
};

Scene make_scene(PlaneKind kind, std::uint64_t seed, int planes, int points) {
  Scene scene;
  RandomPoints triples(kind, seed);
  for (int i = 0; i < planes; ++i) scene.planes.add(triples.three(), {}, 0.0);
  std::mt19937_64 random(seed);
  const auto any = [&] { return static_cast<std::uint32_t>(random() % scene.planes.size()); };
  for (int tries = 0; tries < 50 * points && static_cast<int>(scene.points.size()) < points; ++tries) {
    const std::uint32_t a = any(), b = any(), c = any();
    if (!test::independent(scene.planes[a], scene.planes[b], scene.planes[c])) continue;
    scene.points.push_back(scene.planes.intersect(a, b, c));
    scene.places.push_back(test::shared_point(scene.planes, scene.points.back()));
  }
  return scene;
}

class EveryKind : public testing::TestWithParam<PlaneKind> {};
INSTANTIATE_TEST_SUITE_P(Planes, EveryKind, testing::ValuesIn(kPlaneKinds));

TEST_P(EveryKind, SideHasTheSignOfRationalArithmetic) {
  int on = 0, compared = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(3, 60)); ++seed) {
    const Scene scene = make_scene(GetParam(), seed, 24, 60);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      for (std::uint32_t plane = 0; plane < scene.planes.size(); ++plane) {
        const int wanted = sgn(test::height(scene.planes[plane], scene.places[i]));
        ASSERT_EQ(static_cast<int>(scene.planes.side(plane, scene.points[i])), wanted)
            << "seed " << seed << ", point " << i << " at " << scene.points[i].at.transpose() << ", plane "
            << plane;
        ++compared;
        const auto& own = scene.points[i].planes;
        on += wanted == 0 && std::find(own.begin(), own.end(), plane) == own.end() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 1000);
  if (GetParam() == PlaneKind::kFewWholes) {
    EXPECT_GT(on, 50) << "no degenerate case was tried";
  }
}

TEST_P(EveryKind, ThePointIsNoFartherOffThanItsErrorSays) {
  for (std::uint64_t seed = 11; seed <= static_cast<std::uint64_t>(test::sized(14, 60)); ++seed) {
    const Scene scene = make_scene(GetParam(), seed, 24, 100);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const ExactPoint& point = scene.points[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const mpq_class off = abs(rational(point.at[static_cast<Eigen::Index>(k)]) - scene.places[i][k]);
        if (!std::isfinite(point.error)) continue;
        ASSERT_TRUE(off <= rational(point.error)) << "seed " << seed << ", point " << i;
        if (point.on_grid) {
          ASSERT_EQ(sgn(off), 0);
        }
      }
    }
  }
}

TEST_P(EveryKind, SamePointsAreThoseOfRationalArithmetic) {
  int same = 0;
  for (std::uint64_t seed = 21; seed <= static_cast<std::uint64_t>(test::sized(22, 40)); ++seed) {
    const Scene scene = make_scene(GetParam(), seed, 12, 120);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const bool wanted = scene.places[i] == scene.places[k];
        same += wanted && scene.points[i].planes != scene.points[k].planes ? 1 : 0;
        ASSERT_EQ(scene.planes.same(scene.points[i], scene.points[k]), wanted)
            << "seed " << seed << ": " << scene.points[i].at.transpose() << " and "
            << scene.points[k].at.transpose();
      }
    }
  }
  if (GetParam() == PlaneKind::kFewWholes) {
    EXPECT_GT(same, 50);
  }
}

TEST_P(EveryKind, ThePlaneGoesThroughItsPointsAndLooksOutward) {
  RandomPoints triples(GetParam(), 5);
  for (int i = 0; i < 200; ++i) {
    PlaneSet planes;
    const auto points = triples.three();
    const OrientedPlane plane = planes.add(points, {}, 0.0);
    const Vec3 outward = (points[2] - points[0]).cross(points[1] - points[0]).normalized();
    EXPECT_GT(planes.unit(plane).normal.dot(outward), 0.999);
    for (const Vec3& point : points) {
      const mpq_class off = test::height(planes[plane.index], test::rational_point(point));
      const bool exact = GetParam() == PlaneKind::kFewWholes || GetParam() == PlaneKind::kGrid;
      if (exact) {
        ASSERT_EQ(sgn(off), 0) << "points of a grid have whole planes";
      } else {
        ASSERT_LE(std::abs(planes.unit(plane).distance(point)), 1e-15 * (1.0 + 64.0 * point.norm()) * 16.0);
      }
    }
  }
}

/// Planes so nearly dependent that even their determinant's sign is beyond rounded arithmetic.
TEST(ExactPlane, SideIsRightWhereTheDeterminantIsBelowRounding) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int compared = 0, beyond = 0;
  for (int round = 0; round < test::sized(400, 20000); ++round) {
    PlaneSet planes;
    const Vec3 u(normal(random), normal(random), normal(random));
    const Vec3 v(normal(random), normal(random), normal(random));
    const auto with_normal = [&](const Vec3& n, double distance) {
      const Vec3 unit = n.normalized();
      const Vec3 a = unit.unitOrthogonal();
      const Vec3 p = distance * unit;
      return std::array<Vec3, 3>{p, Vec3(p + unit.cross(a)), Vec3(p + a)};
    };
    // The third normal is a sum of the other two, up to the rounding of doubles.
    planes.add(with_normal(u, normal(random)), {}, 0.0);
    planes.add(with_normal(v, normal(random)), {}, 0.0);
    planes.add(with_normal(u.normalized() + v.normalized(), normal(random)), {}, 0.0);
    planes.add(with_normal(Vec3(v + 1e-17 * u), 1e6 * normal(random)), {}, 0.0);
    planes.add(with_normal(Vec3(normal(random), normal(random), normal(random)), 1e7), {}, 0.0);
    planes.add_axial(0, 16777216.0);
    if (planes.size() < 6 || !test::independent(planes[0], planes[1], planes[2])) continue;
    const ExactPoint point = planes.intersect(0, 1, 2);
    const Rational3 place = test::shared_point(planes, point);
    beyond += point.at.norm() > 1e12 ? 1 : 0;
    ASSERT_LE(point.error, 1e-13 * (1.0 + point.at.norm()))
        << "coordinates are right to their last bits, however flat the angle";
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class off = abs(rational(point.at[static_cast<Eigen::Index>(k)]) - place[k]);
      ASSERT_TRUE(off <= rational(point.error))
          << "round " << round << ": " << off.get_d() << " off, not " << point.error;
    }
    for (std::uint32_t plane = 0; plane < planes.size(); ++plane) {
      ASSERT_EQ(static_cast<int>(planes.side(plane, point)), sgn(test::height(planes[plane], place)))
          << "round " << round << ", plane " << plane;
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(beyond, 20) << "no case was hard";
}

std::vector<Vec3> square_at(double x, double size) {
  return {{x, 0, 0}, {x, size, 0}, {x, size, size}, {x, 0, size}};
}

OrientedPlane add_square(PlaneSet& planes, const std::vector<Vec3>& corners, double merge = 1e-6) {
  return planes.add({corners[0], corners[2], corners[1]}, corners, merge);
}

TEST(ExactPlane, NearlySamePlanesMergeByHowFarTheyAreApartOverTheFace) {
  PlaneSet planes;
  const auto first = add_square(planes, square_at(0.1, 100.0));
  EXPECT_EQ(add_square(planes, square_at(0.1 + 5e-7, 100.0)), first);
  EXPECT_EQ(add_square(planes, square_at(0.1 - 9e-7, 100.0)), first);
  EXPECT_NE(add_square(planes, square_at(0.1 + 5e-6, 100.0)).index, first.index);
  std::vector<Vec3> tilted = square_at(0.1, 100.0);
  tilted[1].x() += 8e-7;
  tilted[2].x() += 8e-7;
  EXPECT_EQ(add_square(planes, tilted), first);
  for (Vec3& corner : tilted) corner = Vec3(0.1 + 1e-6 * (corner.y() / 10.0), corner.y(), corner.z());
  EXPECT_NE(add_square(planes, tilted).index, first.index) << "1e-5 off at its far end";
  EXPECT_NE(planes.add({tilted[0], tilted[2], tilted[1]}, {}, 0.0).index, first.index)
      << "without an extent only equal planes are one";
}

TEST(ExactPlane, OppositeFacesShareAPlane) {
  PlaneSet planes;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.8, 0.3, 0.2, -0.4).normalized();
  for (double x = -100.0; x <= 100.0; x += 12.7) {
    std::vector<Vec3> corners = square_at(x, 50.0);
    for (Vec3& corner : corners) corner = turn * corner;
    const OrientedPlane there = add_square(planes, corners);
    std::vector<Vec3> other = square_at(x, 70.0);
    for (Vec3& corner : other) corner = turn * (corner + Vec3(0.0, 33.3, -7.7));
    std::reverse(other.begin(), other.end());
    const OrientedPlane back = add_square(planes, other);
    EXPECT_EQ(there.index, back.index);
    EXPECT_NE(there.flipped, back.flipped);
    EXPECT_LT((planes.unit(there).normal + planes.unit(back).normal).norm(), 1e-12);
  }
}

TEST(ExactPlane, AWholePlaneIsTheSameFromAnyOfItsPoints) {
  PlaneSet planes;
  const Vec3 a(3, 0, 0), b(0, 4, 0), c(0, 0, 5);  // 20 x + 15 y + 12 z = 60
  const OrientedPlane first = planes.add({a, b, c}, {}, 0.0);
  EXPECT_EQ(planes.add({b, c, a}, {}, 0.0), first);
  EXPECT_EQ(planes.add({Vec3(2 * a - b), Vec3(2 * b - c), Vec3(2 * c - a)}, {}, 0.0), first);
  const OrientedPlane back = planes.add({a, c, b}, {}, 0.0);
  EXPECT_EQ(back.index, first.index);
  EXPECT_NE(back.flipped, first.flipped);
  EXPECT_EQ(planes.size(), 1u);
  EXPECT_TRUE(planes[0].short_numbers);
}

}  // namespace
}  // namespace hallway
