// SPDX-License-Identifier: MIT
#include "contact/separation.hpp"

#include <gtest/gtest.h>

#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "support/overlap_oracle.hpp"
#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

/// Distance between the segments a and b: the least of a quadratic on the unit square, its edges included.
double segment_distance(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const Vec3 u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const auto at = [&](double s, double t) { return (w + s * u - t * v).norm(); };
  const auto best_t = [&](double s) { return std::clamp((w + s * u).dot(v) / v.squaredNorm(), 0.0, 1.0); };
  const auto best_s = [&](double t) { return std::clamp((t * v - w).dot(u) / u.squaredNorm(), 0.0, 1.0); };
  double least = std::min({at(0, best_t(0)), at(1, best_t(1)), at(best_s(0), 0), at(best_s(1), 1)});
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), determinant = uu * vv - uv * uv;
  if (determinant > 1e-12 * uu * vv) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
    if (s >= 0.0 && s <= 1.0) least = std::min(least, at(s, best_t(s)));
  }
  return least;
}

/// Distance of a point from the plane region of a triangle, infinite where it is not above it.
double face_distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  for (std::size_t i = 0; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).cross(p - t[i]).dot(n) < 0.0) return INFINITY;
  }
  return std::abs(n.dot(p - t[0]));
}

/// The surface of a box in triangles, for the oracle.
std::vector<std::array<Vec3, 3>> box_surface(const Vec3& low, const Vec3& high, const Pose& pose) {
  std::vector<std::array<Vec3, 3>> found;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {0.0, 1.0}) {
      const auto at = [&](double s, double t) {
        Vec3 share;
        share[axis] = end;
        share[(axis + 1) % 3] = s;
        share[(axis + 2) % 3] = t;
        return Vec3(pose * Vec3(low + share.cwiseProduct(high - low)));
      };
      found.push_back({at(0, 0), at(1, 0), at(1, 1)});
      found.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return found;
}

/// Distance of two triangles that do not meet: some pair of edges, or a corner and a face.
double triangle_distance(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  double least = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, face_distance(a[i], b), face_distance(b[i], a)});
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, segment_distance({a[i], a[(i + 1) % 3]}, {b[j], b[(j + 1) % 3]}));
  }
  return least;
}

TEST(Separation, BoxAgreesWithAllPairsOfFeatures) {
  Dice dice(1);
  const int cases = hallway::test::long_mode() ? 200000 : 10000;
  int apart = 0, overlapping = 0;
  for (int i = 0; i < cases; ++i) {
    const Vec3 low = Vec3(-dice.in(0.01, 1), -dice.in(0.01, 1), -dice.in(0.01, 1)),
               high = low + Vec3(dice.in(0.01, 2), dice.in(0.01, 2), dice.in(0.01, 2));
    const BodyShape shape = BodyShape::box(low, high);
    const Pose pose = dice.pose(1.0);
    const Vec3 middle = dice.point(3.0);
    const double size = std::pow(10.0, dice.in(-2, 1));
    const Triangle triangle{middle + dice.point(size), middle + dice.point(size), middle + dice.point(size)};
    double truth = INFINITY;
    for (const auto& face : box_surface(low, high, pose))
      truth = std::min(truth, triangle_distance(face, triangle));
    std::vector<Vec3> corners = shape.vertices();
    const Separation found = separate(shape, pose, triangle);
    // The corners of a box are enough for an oracle of overlap; its greatest gap is no distance.
    const bool is_apart = HullOracle(corners).gap(pose, triangle) > 0.0;
    if (!is_apart) {
      ++overlapping;
      EXPECT_EQ(found.gap, 0.0) << i;
      continue;
    }
    ++apart;
    EXPECT_LE(found.gap, truth * (1.0 + 1e-14) + 1e-15) << i;
    EXPECT_GE(found.gap, truth * (1.0 - 1e-9) - 1e-13) << i;
    EXPECT_NEAR(found.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR((found.on_body - found.on_triangle).norm(), truth, 1e-9 * (1.0 + truth)) << i;
    EXPECT_LE(gap_along(shape, pose, triangle, found.normal), truth * (1.0 + 1e-14) + 1e-15);
  }
  EXPECT_GT(apart, cases / 3);
  EXPECT_GT(overlapping, cases / 50);
}

TEST(Separation, CylinderAgainstClosedForms) {
  const BodyShape shape = BodyShape::cylinder(0.5, 0.1, 1.1);
  const Pose pose{Quat::Identity(), Vec3(2, 3, 0)};
  // A wall beside it, a level triangle above, a corner beside it, and an edge over its rim.
  const Triangle wall{Vec3(3, -50, -50), Vec3(3, 50, -50), Vec3(3, 3, 80)};
  EXPECT_NEAR(separate(shape, pose, wall).gap, 0.5, 1e-12);
  const Triangle above{Vec3(-9, -9, 1.35), Vec3(9, -9, 1.35), Vec3(2, 30, 1.35)};
  EXPECT_NEAR(separate(shape, pose, above).gap, 0.25, 1e-13);
  const Triangle corner{Vec3(2 + 0.6, 3 + 0.8, 0.5), Vec3(8, 9, 0.5), Vec3(9, 8, 0.7)};
  EXPECT_NEAR(separate(shape, pose, corner).gap, 0.5, 1e-10);
  const Triangle rim{Vec3(2.8, -40, 1.5), Vec3(2.8, 40, 1.5), Vec3(30, 0, 30)};
  EXPECT_NEAR(separate(shape, pose, rim).gap, 0.5, 1e-10);
}

TEST(Separation, TiltedCylinderIsNeverFartherThanItsSamples) {
  Dice dice(2);
  for (int i = 0; i < 2000; ++i) {
    const double radius = dice.in(0.05, 1.0), height = dice.in(0.05, 1.0);
    const BodyShape shape = BodyShape::cylinder(radius, 0.1, 0.1 + height);
    const Pose pose = dice.pose(1.0);
    const Triangle triangle{dice.point(3), dice.point(3), dice.point(3)};
    const Separation found = separate(shape, pose, triangle);
    // Points of both on a grid: the distance of any two is an upper bound. The two nearest are where the library says.
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.0981747704 * k;
      const Vec3 p = pose * Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.1 + (k % 2) * height);
      Vec3 share(dice.in(0, 1), dice.in(0, 1), dice.in(0, 1));
      share /= share.sum();
      const Vec3 q = share.x() * triangle[0] + share.y() * triangle[1] + share.z() * triangle[2];
      EXPECT_TRUE(found.gap == 0.0 || found.normal.dot(p - q) >= found.gap) << i;
    }
    if (found.gap == 0.0) continue;
    // Both nearest points are on their bodies, so their distance is an upper bound: the bounds meet.
    const Vec3 local = pose.inverse() * found.on_body;
    EXPECT_LE(local.head<2>().norm(), radius * (1 + 1e-12));
    EXPECT_GE(local.z(), 0.1 - 1e-12);
    EXPECT_LE(local.z(), 0.1 + height + 1e-12);
    EXPECT_NEAR((found.on_body - found.on_triangle).norm(), found.gap, 1e-9 * found.gap + 1e-10) << i;
  }
}

TEST(Separation, FarFromTheOriginAndHugeTriangles) {
  const BodyShape shape = BodyShape::box({-1, -1, 0}, {1, 1, 1});
  const Vec3 far(1e4, -2e4, 3e3);
  const Triangle triangle{far + Vec3(1.5, -1e4, -1e4), far + Vec3(1.5, 1e4, -1e4), far + Vec3(1.5, 0, 2e4)};
  const Separation found = separate(shape, {Quat::Identity(), far}, triangle);
  EXPECT_LE(found.gap, 0.5);
  EXPECT_GE(found.gap, 0.5 - 1e-9);
}

TEST(Separation, TrianglesWithoutArea) {
  const BodyShape shape = BodyShape::box({-1, -1, 0}, {1, 1, 1});
  const Vec3 p(3, 0, 0.5), q(3, 2, 0.5);
  EXPECT_NEAR(separate(shape, Pose{}, {p, p, p}).gap, 2.0, 1e-13);
  EXPECT_NEAR(separate(shape, Pose{}, {p, q, p}).gap, 2.0, 1e-13);
  EXPECT_NEAR(separate(shape, Pose{}, {p, 0.5 * (p + q), q}).gap, 2.0, 1e-13);
  const Vec3 inside(0, 0, 0.5);
  EXPECT_EQ(separate(shape, Pose{}, {inside, inside, inside}).gap, 0.0);
  EXPECT_EQ(separate(shape, Pose{}, {inside, p, p}).gap, 0.0);
}

TEST(Separation, TouchingIsNoGap) {
  const BodyShape shape = BodyShape::box({-1, -1, 0}, {1, 1, 1});
  EXPECT_EQ(separate(shape, Pose{}, {Vec3(1, -5, -5), Vec3(1, 5, -5), Vec3(1, 0, 5)}).gap, 0.0);
  EXPECT_EQ(separate(shape, Pose{}, {Vec3(1, 1, 1), Vec3(5, 1, 1), Vec3(1, 5, 5)}).gap, 0.0);
  for (const double gap : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const double x = 1.0 + gap;
    const double found = separate(shape, Pose{}, {Vec3(x, -5, -5), Vec3(x, 5, -5), Vec3(x, 0, 5)}).gap;
    EXPECT_LE(found, x - 1.0);
    EXPECT_GE(found, x - 1.0 - 3e-14);
  }
}

TEST(BodyShape, RefusesWhatIsNoBody) {
  const auto refused = [](auto make) {
    const auto error = hallway::test::error_of(make);
    return error && error->code() == ErrorCode::kBadInput;
  };
  EXPECT_TRUE(refused([] { BodyShape::polytope({}); }));
  EXPECT_TRUE(refused([] { BodyShape::polytope({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}); }));
  EXPECT_TRUE(refused([] {
    BodyShape::polytope({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 1e-4)});
  }));
  EXPECT_TRUE(refused([] { BodyShape::box({0, 0, 0}, {1, 1, NAN}); }));
  EXPECT_TRUE(refused([] { BodyShape::box({0, 0, 0}, {1, 1, 1e4}); }));
  EXPECT_TRUE(refused([] { BodyShape::cylinder(NAN, 0, 1); }));
  EXPECT_TRUE(refused([] { BodyShape::cylinder(0.1, 0, NAN); }));
  EXPECT_TRUE(refused([] { BodyShape::cylinder(0.1, 1, 0); }));
  EXPECT_TRUE(refused([] { BodyShape::cylinder(1e9, 0, 1); }));
  EXPECT_FALSE(refused([] { BodyShape::cylinder(0.1, 0, 1); }));
}

TEST(BodyShape, BoxAtAPoseHoldsTheBodyTightly) {
  Dice dice(3);
  const BodyShape shape = BodyShape::cylinder(0.5, 0.2, 1.0, {0.3, -0.1});
  for (int i = 0; i < 100; ++i) {
    const Pose pose = dice.pose(5.0);
    const Box box = shape.box_at(pose);
    Box sampled;
    for (int k = 0; k < 720; ++k) {
      const double angle = 0.00872664626 * k;
      for (const double z : {0.2, 1.0})
        sampled.extend(Vec3(pose * Vec3(0.3 + 0.5 * std::cos(angle), -0.1 + 0.5 * std::sin(angle), z)));
    }
    EXPECT_LT((box.min() - sampled.min()).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((box.max() - sampled.max()).cwiseAbs().maxCoeff(), 1e-4);
  }
  EXPECT_DOUBLE_EQ(shape.bottom(), 0.2);
}

}  // namespace
}  // namespace hallway::contact::test
