// SPDX-License-Identifier: MIT
#include "sense/face_landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "sense/landmarks.hpp"
#include "support/errors.hpp"
#include "unit/sense/map_text.hpp"

namespace hallway::sense {
namespace {

using test::box_brush;
using test::entity;
using test::worldspawn;

struct Made {
  map::World world;
  std::vector<Vec3> landmarks;
};

Made make(const std::string& text) {
  const map::Document document = test::parse_map(text);
  Made made{map::build_world(document), {}};
  EXPECT_TRUE(made.world.problems.empty());
  made.landmarks = make_landmarks(document, made.world, csg::build_surface(made.world));
  return made;
}

/// How far a point is outside a convex solid, at least: the largest distance to its planes.
double outside_by(const map::Solid& solid, const Vec3& point) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : solid.planes) most = std::max(most, plane.distance(point));
  return most;
}

bool has(const std::vector<Vec3>& landmarks, const Vec3& point) {
  return std::any_of(landmarks.begin(), landmarks.end(), [&](const Vec3& other) { return other == point; });
}

TEST(FaceLandmarks, AreNoneWithoutADensity) {
  EXPECT_TRUE(make(worldspawn({}, {box_brush({0, 0, 0}, {10, 10, 10})})).landmarks.empty());
  EXPECT_TRUE(
      make(worldspawn({{"_points_per_m2", "0"}}, {box_brush({0, 0, 0}, {10, 10, 10})})).landmarks.empty());
}

TEST(FaceLandmarks, HaveTheDensityAskedFor) {
  const Made made =
      make(worldspawn({{"_points_per_m2", "4"}}, {box_brush({0.3, 0.1, 0.2}, {20.3, 10.1, 5.2})}));
  const double expected = 4.0 * 2.0 * (20 * 10 + 20 * 5 + 10 * 5);
  EXPECT_NEAR(static_cast<double>(made.landmarks.size()), expected, 0.02 * expected);
}

TEST(FaceLandmarks, CoverAFaceEvenly) {
  const Made made = make(worldspawn({{"_points_per_m2", "1"}}, {box_brush({0, 0, 0}, {40, 40, 1})}));
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      const auto count = std::count_if(made.landmarks.begin(), made.landmarks.end(), [&](const Vec3& p) {
        return p.z() > 1.0 && std::floor(p.x() / 10.0) == x && std::floor(p.y() / 10.0) == y;
      });
      EXPECT_NEAR(static_cast<double>(count), 100.0, 1.0) << x << " " << y;
    }
  }
}

TEST(FaceLandmarks, StandAMillimetreOffTheFaceAndClearOfItsEdges) {
  const Made made = make(worldspawn({{"_points_per_m2", "10000"}}, {box_brush({1, 2, 3}, {1.5, 2.4, 3.3})}));
  EXPECT_GT(made.landmarks.size(), 5000u);
  for (const Vec3& point : made.landmarks) {
    std::array<double, 6> distances{};
    for (std::size_t i = 0; i < 6; ++i) distances[i] = made.world.solids[0].planes[i].distance(point);
    std::sort(distances.begin(), distances.end());
    ASSERT_NEAR(distances[5], 0.001, 1e-12);
    ASSERT_LE(distances[4], -0.001 + 1e-12) << "the face's nearest edge";
  }
}

TEST(FaceLandmarks, LieOnSlantedFacesToo) {
  // A box cut by the plane x + z = 1, clockwise points from outside.
  std::string wedge = box_brush({0, 0, 0}, {1, 1, 1});
  wedge.insert(wedge.size() - 2, "( 1 0 0 ) ( 0 0 1 ) ( 1 1 0 ) wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n");
  const Made made = make(worldspawn({{"_points_per_m2", "1000"}}, {wedge}));
  int slanted = 0;
  for (const Vec3& point : made.landmarks) {
    ASSERT_NEAR(outside_by(made.world.solids[0], point), 0.001, 1e-12);
    slanted += std::abs(point.x() + point.z() - 1.0 - 0.001 * std::sqrt(2.0)) < 1e-12 ? 1 : 0;
  }
  EXPECT_NEAR(slanted, 1000.0 * std::sqrt(2.0), 60.0);
}

TEST(FaceLandmarks, AreNotWhereSolidsTouch) {
  const Made made = make(worldspawn({{"_points_per_m2", "100"}},
                                    {box_brush({-2, 0, 0}, {0, 2, 2}), box_brush({0, 0, 0}, {2, 2, 2})}));
  EXPECT_GT(made.landmarks.size(), 3000u);
  // None stands in the plane between the two; those above it stand on the face that the two form.
  const Box both(Vec3(-2, 0, 0), Vec3(2, 2, 2));
  for (const Vec3& point : made.landmarks) {
    ASSERT_NEAR(both.exteriorDistance(point), 0.001, 1e-12) << point.transpose();
  }
  EXPECT_TRUE(std::any_of(made.landmarks.begin(), made.landmarks.end(),
                          [](const Vec3& point) { return std::abs(point.x()) < 0.02; }));
}

TEST(FaceLandmarks, AreClearOfEverySolid) {
  std::vector<std::string> brushes;
  const Random random(5, stream_id("test"));
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Vec3 low(random.uniform(0, 6 * i, 0, 8), random.uniform(0, 6 * i + 1, 0, 8),
                   random.uniform(0, 6 * i + 2, 0, 2));
    const Vec3 size(random.uniform(0, 6 * i + 3, 0.1, 3), random.uniform(0, 6 * i + 4, 0.1, 3),
                    random.uniform(0, 6 * i + 5, 0.1, 1));
    brushes.push_back(box_brush(low, low + size));
  }
  const Made made = make(worldspawn({{"_points_per_m2", "50"}}, brushes));
  EXPECT_GT(made.landmarks.size(), 3000u);
  for (const Vec3& point : made.landmarks) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const map::Solid& solid : made.world.solids) nearest = std::min(nearest, outside_by(solid, point));
    ASSERT_NEAR(nearest, 0.001, 1.1e-6) << point.transpose();  // of its own solid, and no other is nearer
  }
}

TEST(FaceLandmarks, CoverContinuedFacesLikeOne) {
  const test::Keys keys = {{"_points_per_m2", "25"}};
  const Made whole = make(worldspawn(keys, {box_brush({0, 0, 0}, {20, 10, 3})}));
  const Made parts =
      make(worldspawn(keys, {box_brush({0, 0, 0}, {7.3, 10, 3}), box_brush({7.3, 0, 0}, {20, 10, 3})}));
  for (const Vec3& point : parts.landmarks) ASSERT_TRUE(has(whole.landmarks, point)) << point.transpose();
  for (const Vec3& point : whole.landmarks) ASSERT_TRUE(has(parts.landmarks, point)) << point.transpose();
  EXPECT_EQ(parts.landmarks.size(), whole.landmarks.size());
}

TEST(FaceLandmarks, AreNotDoubledWhereFacesCoincide) {
  const test::Keys keys = {{"_points_per_m2", "25"}};
  const Made whole = make(worldspawn(keys, {box_brush({0, 0, 0}, {20, 10, 3})}));
  const Made overlapping =
      make(worldspawn(keys, {box_brush({0, 0, 0}, {15, 10, 3}), box_brush({5, 0, 0}, {20, 10, 3})}));
  EXPECT_NEAR(static_cast<double>(overlapping.landmarks.size()), static_cast<double>(whole.landmarks.size()),
              3.0);
  for (std::size_t i = 0; i < overlapping.landmarks.size(); ++i) {
    const std::vector<Vec3> before(overlapping.landmarks.begin(),
                                   overlapping.landmarks.begin() + static_cast<long>(i));
    ASSERT_FALSE(has(before, overlapping.landmarks[i]));
  }
}

TEST(FaceLandmarks, StayWhenABrushElsewhereIsEdited) {
  const test::Keys keys = {{"_points_per_m2", "9"}};
  const std::string kept = box_brush({0, 0, 0}, {10, 5, 3});
  const Made before = make(worldspawn(keys, {box_brush({20, 0, 0}, {25, 5, 5}), kept}));
  const Made after =
      make(worldspawn(keys, {box_brush({20, 0, 0}, {25, 6, 5}), box_brush({30, 0, 0}, {31, 1, 1}), kept}));
  for (const Vec3& point : before.landmarks) {
    const bool edited = point.x() > 15.0;
    ASSERT_TRUE(edited || has(after.landmarks, point)) << point.transpose();
  }
}

TEST(FaceLandmarks, LoseNoPointsAtTheEdgesBetweenPolygonsOfAFace) {
  // A dense plate, and the same with pillars on it that cut its upper face into pieces.
  const test::Keys keys = {{"_points_per_m2", "10000"}};
  const std::string plate = box_brush({0, 0, 0}, {2, 2, 0.5});
  const Made plain = make(worldspawn(keys, {plate}));
  const Made cut = make(worldspawn(
      keys, {plate, box_brush({0.5, 0.4, 0.5}, {0.6, 1.1, 2}), box_brush({1.2, 1.3, 0.5}, {1.9, 1.5, 2})}));
  const auto on_top = [](const Made& made) {
    std::vector<Vec3> points;
    for (const Vec3& point : made.landmarks) {
      const auto beside = [&](double x0, double y0, double x1, double y1) {
        return point.x() < x0 - 0.001 || point.x() > x1 + 0.001 || point.y() < y0 - 0.001 ||
               point.y() > y1 + 0.001;
      };
      if (std::abs(point.z() - 0.501) < 1e-9 && beside(0.5, 0.4, 0.6, 1.1) && beside(1.2, 1.3, 1.9, 1.5)) {
        points.push_back(point);
      }
    }
    return points;
  };
  const std::vector<Vec3> expected = on_top(plain);
  EXPECT_GT(expected.size(), 37000u);
  EXPECT_EQ(on_top(cut), expected);
}

TEST(FaceLandmarks, StandInsideOfARoomCutOutOfSolid) {
  const Made made = make(worldspawn({{"_points_per_m2", "20"}}, {box_brush({-1, -1, -1}, {9, 7, 4})}) +
                         entity({{"classname", "hw_subtract"}}, {box_brush({0, 0, 0}, {8, 6, 3})}));
  const Box room(Vec3(0, 0, 0), Vec3(8, 6, 3));
  const Box block(Vec3(-1, -1, -1), Vec3(9, 7, 4));
  std::size_t inside = 0;
  for (const Vec3& point : made.landmarks) {
    if (!block.contains(point)) continue;
    ++inside;
    const Vec3 depth = (point - room.min()).cwiseMin(room.max() - point);
    std::array<double, 3> depths{depth.x(), depth.y(), depth.z()};
    std::sort(depths.begin(), depths.end());
    ASSERT_NEAR(depths[0], 0.001, 1e-12) << "off its wall";
    ASSERT_GE(depths[1], 0.001 - 1e-12) << "off the next wall";
  }
  const double expected = 20.0 * 2.0 * (8 * 6 + 8 * 3 + 6 * 3);
  EXPECT_NEAR(static_cast<double>(inside), expected, 0.03 * expected);
}

TEST(FaceLandmarks, AreOnlyOnPolygonsThatAreWanted) {
  const map::Document document =
      test::parse_map(worldspawn({{"_points_per_m2", "5"}}, {box_brush({0, 0, 0}, {10, 10, 10})}));
  const map::World world = map::build_world(document);
  const csg::Surface surface = csg::build_surface(world);
  const auto faces_up = [&](std::size_t polygon) { return surface.polygons[polygon].plane.normal.z() > 0.5; };
  const std::vector<Vec3> some = make_landmarks(document, world, surface, faces_up);
  EXPECT_NEAR(static_cast<double>(some.size()), 500.0, 30.0);
  for (const Vec3& point : some) ASSERT_NEAR(point.z(), 10.001, 1e-12);
  EXPECT_TRUE(make_landmarks(document, world, surface, [](std::size_t) { return false; }).empty());
}

TEST(FaceLandmarks, FollowTheSeed) {
  const std::vector<std::string> brush = {box_brush({0, 0, 0}, {10, 10, 10})};
  const Made one = make(worldspawn({{"_points_per_m2", "1"}, {"_point_seed", "1"}}, brush));
  const Made again = make(worldspawn({{"_points_per_m2", "1"}, {"_point_seed", "1"}}, brush));
  const Made two = make(worldspawn({{"_points_per_m2", "1"}, {"_point_seed", "2"}}, brush));
  EXPECT_EQ(one.landmarks, again.landmarks);
  EXPECT_NE(one.landmarks, two.landmarks);
}

TEST(FaceLandmarks, TakeTheDensityOfTheirOwnGroup) {
  const std::string far_box = box_brush({20, 0, 0}, {30, 10, 10});
  const auto group = [&](const std::string& density) {
    return entity({{"classname", "func_group"}, {"_points_per_m2", density}}, {far_box});
  };
  const std::vector<std::string> near_box = {box_brush({0, 0, 0}, {10, 10, 10})};
  const auto count = [](const Made& made, bool far) {
    return std::count_if(made.landmarks.begin(), made.landmarks.end(),
                         [&](const Vec3& p) { return (p.x() > 15.0) == far; });
  };
  const Made denser = make(worldspawn({{"_points_per_m2", "1"}}, near_box) + group("3"));
  EXPECT_NEAR(static_cast<double>(count(denser, false)), 600.0, 20.0);
  EXPECT_NEAR(static_cast<double>(count(denser, true)), 1800.0, 40.0);
  EXPECT_EQ(count(make(worldspawn({{"_points_per_m2", "1"}}, near_box) + group("0")), true), 0);
  EXPECT_EQ(count(make(worldspawn({}, near_box) + group("1")), false), 0);
}

TEST(FaceLandmarks, AreRefusedBeyondTheLimit) {
  const map::Document document =
      test::parse_map(worldspawn({{"_points_per_m2", "1000000"}}, {box_brush({0, 0, 0}, {1000, 1000, 10})}));
  const map::World world = map::build_world(document);
  const auto error =
      test::error_of([&] { static_cast<void>(make_landmarks(document, world, csg::build_surface(world))); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "test.map");
  EXPECT_EQ(error->where().line, 5) << "the line of the key";
}

TEST(FaceLandmarks, AreNoneOnSliversThinnerThanTheClearance) {
  const Made made = make(worldspawn({{"_points_per_m2", "10000"}}, {box_brush({0, 0, 0}, {1, 1, 0.0015})}));
  for (const Vec3& point : made.landmarks) {
    ASSERT_TRUE(point.z() == -0.001 || std::abs(point.z() - 0.0025) < 1e-12) << point.transpose();
  }
}

}  // namespace
}  // namespace hallway::sense
