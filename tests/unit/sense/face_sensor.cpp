// SPDX-License-Identifier: MIT
#include "sense/face_sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "base/random.hpp"
#include "sense/convex.hpp"
#include "sense/face_view.hpp"

namespace hallway::sense {
namespace {

/// A convex face, counter-clockwise as seen from its empty side.
Polygon face(std::vector<Vec3> corners) {
  Polygon polygon;
  polygon.plane.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  polygon.plane.offset = polygon.plane.normal.dot(corners[0]);
  polygon.vertices = std::move(corners);
  return polygon;
}

/// An upright board at x, seen from smaller x.
Polygon board(double x, double y_right, double y_left, double z_low, double z_high) {
  return face({{x, y_left, z_low}, {x, y_right, z_low}, {x, y_right, z_high}, {x, y_left, z_high}});
}

FacePlan plan_of(std::vector<Polygon> faces) {
  return {faces, faces};
}

std::vector<VisibleFace> seen(const FacePlan& plan, const FaceViewSpec& spec = {}, const Pose& T = {}) {
  std::vector<VisibleFace> pieces;
  FaceView(spec, plan).find(T, pieces);
  return pieces;
}

double size_of(const Polygon& polygon) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.vertices.size(); ++i) {
    twice += (polygon.vertices[i - 1] - polygon.vertices[0]).cross(polygon.vertices[i] - polygon.vertices[0]);
  }
  return 0.5 * twice.norm();
}

TEST(Convex, WidthAreaAndDifference) {
  const Convex square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(polygon_area(square), 4.0);
  EXPECT_DOUBLE_EQ(width({{0, 0}, {5, 0}, {5, 1}, {0, 1}}), 1.0);
  std::vector<Convex> pieces{square};
  subtract(pieces, {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}});
  double left = 0.0;
  for (const Convex& piece : pieces) left += polygon_area(piece);
  EXPECT_NEAR(left, 3.0, 1e-12);
  subtract(pieces, {{-1, -1}, {3, -1}, {3, 3}, {-1, 3}});
  EXPECT_TRUE(pieces.empty());
}

TEST(FaceView, AFaceWithinTheViewIsSeenWhole) {
  const auto pieces = seen(plan_of({board(4, -1, 1, -0.5, 0.5)}));
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(size_of(pieces[0].seen), 2.0, 1e-12);
  EXPECT_LT(pieces[0].seen.plane.offset, 0.0);
}

TEST(FaceView, AFaceIsCutByThePyramidAndTheDepths) {
  EXPECT_NEAR(size_of(seen(plan_of({board(4, -9, 9, -9, 9)}))[0].seen),
              8.0 * 8.0 * std::tan(std::numbers::pi / 6.0), 1e-9);
  EXPECT_TRUE(seen(plan_of({board(13, -1, 1, -1, 1)})).empty());
  EXPECT_TRUE(seen(plan_of({board(-4, -1, 1, -1, 1)})).empty());
  const Polygon floor = face({{0, -1, -1}, {20, -1, -1}, {20, 1, -1}, {0, 1, -1}});
  const auto pieces = seen(plan_of({floor}));
  ASSERT_EQ(pieces.size(), 1u);
  for (const Vec3& p : pieces[0].seen.vertices) EXPECT_LE(p.x(), 12.0 + 1e-9);
}

TEST(FaceView, FacesAreSeenFromTheirEmptySideAlone) {
  Polygon away = board(4, -1, 1, -0.5, 0.5);
  std::reverse(away.vertices.begin(), away.vertices.end());
  EXPECT_TRUE(seen(plan_of({face(away.vertices)})).empty());
}

TEST(FaceView, WhatIsNearerHides) {
  const Polygon far = board(4, -1, 1, -0.5, 0.5), near = board(2, -2, 0, -1, 1);
  const auto pieces = seen(plan_of({far, near}));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(size_of(pieces[0].seen), 1.0, 1e-9) << "the right half is hidden";
  EXPECT_NEAR(size_of(pieces[1].seen), 2.0 * 4.0 / 2.0, 1e-9);
  FaceViewSpec through;
  through.occlusion = false;
  EXPECT_NEAR(size_of(seen(plan_of({far, near}), through)[0].seen), 2.0, 1e-9);
}

TEST(FaceView, OfWhatIsSeenInTwoPartsTheHullIsGiven) {
  const auto pieces = seen(plan_of({board(4, -1, 1, -0.5, 0.5), board(2, -0.1, 0.1, -1, 1)}));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(size_of(pieces[0].seen), 2.0, 1e-9);
}

/// Faces of boxes that lie about, seen from any pose, against points of them and rays.
TEST(FaceView, SeesWhatRaysSee) {
  const Random random(11, stream_id("faces"));
  std::uint64_t next = 0;
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random.bits(1, next++)[0]) / 4294967296.0;
  };
  std::vector<Polygon> faces;
  for (int box = 0; box < 12; ++box) {
    const Pose T{from_yaw_pitch_roll(uniform(-3, 3), uniform(-1, 1), uniform(-3, 3)),
                 Vec3(uniform(-5, 5), uniform(-5, 5), uniform(-3, 3))};
    const Vec3 half(uniform(0.2, 1.2), uniform(0.2, 1.2), uniform(0.2, 1.2));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        std::vector<Vec3> corners;
        for (const auto& [s, t] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
          Vec3 p = half;
          p[axis] *= side;
          p[(axis + 1) % 3] *= s;
          p[(axis + 2) % 3] *= t;
          corners.push_back(T * p);
        }
        if (side < 0.0) std::reverse(corners.begin(), corners.end());
        faces.push_back(face(std::move(corners)));
      }
    }
  }
  const FacePlan plan = plan_of(faces);
  const auto blocked = [&](const Vec3& from, const Vec3& to) {
    return std::any_of(faces.begin(), faces.end(), [&](const Polygon& other) {
      const double a = other.plane.distance(from), b = other.plane.distance(to);
      if ((a < 0.0) == (b < 0.0) || std::abs(b) < 1e-9) return false;
      const Vec3 at = from + a / (a - b) * (to - from);
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 way = other.vertices[(i + 1) % 4] - other.vertices[i];
        if (other.plane.normal.dot(way.cross(at - other.vertices[i])) < 0.0) return false;
      }
      return true;
    });
  };
  FaceViewSpec spec;
  spec.min_length_m = 0.0;
  int visible = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Pose T{from_yaw_pitch_roll(uniform(-3, 3), uniform(-1.5, 1.5), uniform(-3, 3)),
                 Vec3(uniform(-7, 7), uniform(-7, 7), uniform(-4, 4))};
    const std::vector<VisibleFace> pieces = seen(plan, spec, T);
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const auto piece =
          std::find_if(pieces.begin(), pieces.end(), [&](const VisibleFace& p) { return p.face == i; });
      for (int sample = 0; sample < 20; ++sample) {
        const std::vector<Vec3>& v = faces[i].vertices;
        const Vec3 at = v[0] + uniform(0, 1) * (v[1] - v[0]) + uniform(0, 1) * (v[3] - v[0]);
        const Vec3 local = T.inverse() * at;
        const bool in_view = local.x() > 0.0 && local.x() < spec.max_range_m &&
                             std::abs(local.y()) < local.x() * std::tan(0.5 * spec.horizontal_fov) &&
                             std::abs(local.z()) < local.x() * std::tan(0.5 * spec.vertical_fov);
        if (!in_view || faces[i].plane.distance(T.t) <= 0.0 || blocked(T.t, at)) continue;
        ++visible;
        ASSERT_NE(piece, pieces.end()) << "face " << i << " of trial " << trial;
        const Polygon& hull = piece->seen;
        for (std::size_t k = 0; k < hull.vertices.size(); ++k) {
          const Vec3& a = hull.vertices[k];
          const Vec3 way = (hull.vertices[(k + 1) % hull.vertices.size()] - a).normalized();
          EXPECT_GT(hull.plane.normal.dot(way.cross(local - a)), -1e-6);
        }
      }
    }
    for (const VisibleFace& piece : pieces) {
      for (const Vec3& p : piece.seen.vertices) {
        EXPECT_NEAR(piece.seen.plane.distance(p), 0.0, 1e-9);
        EXPECT_LE(std::abs(p.y()), p.x() * std::tan(0.5 * spec.horizontal_fov) + 1e-9);
      }
    }
  }
  EXPECT_GT(visible, 300);
}

PlaneSensorSpec spec_of(double noise_m, double noise_angle, double noise_end_m) {
  PlaneSensorSpec spec;
  spec.name = "faces";
  spec.shape = PlaneShape::faces;
  spec.noise_m = noise_m;
  spec.noise_angle = noise_angle;
  spec.noise_end_m = noise_end_m;
  return spec;
}

TEST(FaceSensor, NoiseIsAsLargeAsItIsSaid) {
  const FacePlan plan = plan_of({board(4, -1, 1, -0.5, 0.5)});
  const FaceSensor sensor(spec_of(0.02, 0.005, 0.01), plan, 3);
  double place = 0.0, tilt = 0.0, end = 0.0;
  constexpr int kSteps = 2000;
  std::vector<PlaneObservation> out;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    sensor.observe(Pose{}, i, out);
    ASSERT_EQ(out.size(), 1u);
    ASSERT_EQ(out[0].hull.size(), 4u);
    place += std::pow(out[0].plane.distance(Vec3(4, 0, 0)), 2);
    tilt += std::pow(out[0].plane.normal.z(), 2);
    const auto lowest = std::min_element(out[0].hull.begin(), out[0].hull.end(),
                                         [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    end += std::pow(lowest->z() + 0.5, 2);
    for (const Vec3& p : out[0].hull) EXPECT_NEAR(out[0].plane.distance(p), 0.0, 1e-9);
  }
  EXPECT_NEAR(std::sqrt(place / kSteps), 0.02, 0.002);
  EXPECT_NEAR(std::sqrt(tilt / kSteps), 0.005, 0.0005);
  EXPECT_NEAR(std::sqrt(end / kSteps), 0.01, 0.003) << "the lower one of two ends";
}

TEST(FaceSensor, SameSeedSameBits) {
  const FacePlan plan = plan_of({board(4, -1, 1, -0.5, 0.5), board(6, -4, 4, -2, 2)});
  const FaceSensor a(spec_of(0.02, 0.005, 0.01), plan, 3), b(spec_of(0.02, 0.005, 0.01), plan, 3);
  std::vector<PlaneObservation> first, second;
  a.observe(Pose{}, 7, first);
  b.observe(Pose{}, 7, second);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].plane.offset, second[i].plane.offset);
    EXPECT_EQ(first[i].hull, second[i].hull);
  }
}

TEST(FaceSensor, WhatItCannotBeIsRefused) {
  const FacePlan plan = plan_of({board(4, -1, 1, -0.5, 0.5)});
  PlaneSensorSpec wide = spec_of(0, 0, 0);
  wide.view.horizontal_fov = std::numbers::pi;
  EXPECT_THROW(FaceSensor(wide, plan, 1), Error);
  PlaneSensorSpec round = spec_of(0, 0, 0);
  round.view.bounded_sides = true;
  EXPECT_THROW(FaceSensor(round, plan, 1), Error);
}

}  // namespace
}  // namespace hallway::sense
