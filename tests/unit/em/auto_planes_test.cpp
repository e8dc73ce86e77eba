// SPDX-License-Identifier: MIT
#include "em/core/auto_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

Extraction extract(const std::vector<Vec3>& cloud, const AutoOptions& options = {}) {
  return PlaneExtractor(options).extract(cloud);
}

/// What holds of every result: each point in one plane or none, both ways of saying so agree, the geometry
/// fits the members.
void expect_sound(const Extraction& found, const std::vector<Vec3>& cloud) {
  ASSERT_EQ(found.labels.size(), cloud.size());
  std::size_t members = 0;
  for (std::size_t j = 0; j < found.planes.size(); ++j) {
    const Plane& plane = found.planes[j];
    EXPECT_EQ(plane.id, j);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    EXPECT_LE(plane.offset, 0.0);
    EXPECT_TRUE(std::is_sorted(plane.members.begin(), plane.members.end()));
    if (j > 0) {
      EXPECT_GE(found.planes[j - 1].members.size(), plane.members.size());
    }
    members += plane.members.size();
    double squares = 0.0;
    for (const PointIndex i : plane.members) {
      ASSERT_EQ(found.labels[i], j);
      squares += std::pow(plane.normal.dot(cloud[i]) - plane.offset, 2);
    }
    const double scale = 1.0 + std::abs(plane.offset);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(plane.members.size())), plane.rms, 1e-7 * scale);
    EXPECT_NEAR(plane.normal.dot(plane.centroid), plane.offset, 1e-9 * scale);
    const Vec3 side = plane.corners[1] - plane.corners[0];
    const Vec3 next = plane.corners[2] - plane.corners[1];
    EXPECT_GT(side.cross(next).dot(plane.normal), 0.0);
    EXPECT_NEAR(side.dot(next), 0.0, 1e-9 * scale * side.norm());
    for (const PointIndex i : plane.members) {
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 edge = plane.corners[(k + 1) % 4] - plane.corners[k];
        const Vec3 inwards = plane.normal.cross(edge).normalized();
        ASSERT_GE(inwards.dot(cloud[i] - plane.corners[k]), -1e-7 * scale);
      }
    }
  }
  const auto labelled = std::count_if(found.labels.begin(), found.labels.end(),
                                      [](std::uint32_t label) { return label != kNoPlane; });
  EXPECT_EQ(static_cast<std::size_t>(labelled), members);
}

TEST(AutoPlanes, FindsThePlanesOfARoom) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  expect_sound(found, cloud.points);
  ASSERT_EQ(found.planes.size(), 6u);
  for (std::uint32_t label = 0; label < 6; ++label)
    EXPECT_GE(best_overlap(cloud, found, label), 0.93) << label;
  EXPECT_NEAR(found.noise, 0.02, 0.002);
  EXPECT_NEAR(std::abs(found.planes[0].normal.z()), 1.0, 1e-5);
}

TEST(AutoPlanes, SharesAreSmallerWherePlanesMeet) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  for (const Plane& plane : found.planes) {
    EXPECT_LE(plane.exclusive_share, 1.0);
    EXPECT_GE(plane.exclusive_share, 0.8);
  }
  LabelledPoints alone;
  add(alone, {{5, 5, 5}, Vec3::UnitX(), Vec3::UnitY(), 1, 1, 500, 0.01}, 0);
  EXPECT_EQ(extract(alone.points).planes.at(0).exclusive_share, 1.0);
}

TEST(AutoPlanes, TheOrderOfThePointsDoesNotMatter) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  for (const std::uint64_t seed : {1u, 2u}) {
    const std::vector<std::size_t> order = shuffled_order(cloud.points.size(), seed);
    std::vector<Vec3> mixed;
    for (const std::size_t i : order) mixed.push_back(cloud.points[i]);
    const Extraction again = extract(mixed);
    ASSERT_EQ(again.planes.size(), found.planes.size());
    for (std::size_t k = 0; k < order.size(); ++k) ASSERT_EQ(again.labels[k], found.labels[order[k]]);
    for (std::size_t j = 0; j < found.planes.size(); ++j) {
      EXPECT_EQ(again.planes[j].normal, found.planes[j].normal);
      EXPECT_EQ(again.planes[j].offset, found.planes[j].offset);
      EXPECT_EQ(again.planes[j].corners, found.planes[j].corners);
      EXPECT_EQ(again.planes[j].hull, found.planes[j].hull);
      EXPECT_EQ(again.planes[j].rms, found.planes[j].rms);
    }
    EXPECT_EQ(again.noise, found.noise);
  }
}

TEST(AutoPlanes, EachPointTwiceChangesNothingButCounts) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  std::vector<Vec3> twice = cloud.points;
  twice.insert(twice.end(), cloud.points.begin(), cloud.points.end());
  const Extraction again = extract(twice);
  ASSERT_EQ(again.planes.size(), found.planes.size());
  for (std::size_t j = 0; j < found.planes.size(); ++j) {
    EXPECT_EQ(again.planes[j].members.size(), 2 * found.planes[j].members.size());
    EXPECT_EQ(again.planes[j].normal, found.planes[j].normal);
    EXPECT_EQ(again.planes[j].centroid, found.planes[j].centroid);
    EXPECT_EQ(again.planes[j].corners, found.planes[j].corners);
    EXPECT_EQ(again.planes[j].exclusive_share, found.planes[j].exclusive_share);
  }
  for (std::size_t i = 0; i < twice.size(); ++i)
    ASSERT_EQ(again.labels[i], found.labels[i % cloud.points.size()]);
}

/// Moved, turned and scaled, the same points are in the same planes and these are moved, turned and scaled.
void expect_to_follow(const Mat3& turn, const Vec3& shift, double scale) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  std::vector<Vec3> moved;
  for (const Vec3& p : cloud.points) moved.push_back(scale * (turn * p) + shift);
  const Extraction again = extract(moved);
  expect_sound(again, moved);
  ASSERT_EQ(again.planes.size(), found.planes.size());
  EXPECT_GE(equal_membership(found, again), 0.999);
  for (const Plane& plane : found.planes) {
    double best = 0.0;
    for (const Plane& other : again.planes)
      best = std::max(best, std::abs(other.normal.dot(turn * plane.normal)));
    EXPECT_GE(best, 1.0 - 1e-6);
  }
}

TEST(AutoPlanes, FollowARotation) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  expect_to_follow(turn, Vec3::Zero(), 1.0);
  expect_to_follow(turn * turn, Vec3(3, -20, 7), 1.0);
}

TEST(AutoPlanes, MillimetresAreAsGoodAsMetres) {
  expect_to_follow(Mat3::Identity(), Vec3::Zero(), 1000.0);
}

TEST(AutoPlanes, LargeOffsetsLoseNothing) {
  expect_to_follow(Mat3::Identity(), Vec3(1e6, -2e6, 5e5), 1.0);
}

TEST(AutoPlanes, EvenNoiseHasNoPlane) {
  for (const std::size_t count : {100u, 1000u, 12000u}) {
    LabelledPoints cloud;
    add_outliers(cloud, count, 10.0, count);
    EXPECT_TRUE(extract(cloud.points).planes.empty()) << count;
  }
}

TEST(AutoPlanes, OnePlaneAmongOutliersIsOnePlane) {
  for (const std::size_t outliers : {0u, 50u, 500u}) {
    LabelledPoints cloud;
    add(cloud, {{5, 5, 5}, Vec3(0.6, 0.8, 0.0), Vec3::UnitZ(), 2.0, 1.5, 1000, 0.02}, 0);
    add_outliers(cloud, outliers, 10.0, 3);
    const Extraction found = extract(cloud.points);
    ASSERT_EQ(found.planes.size(), 1u) << outliers;
    EXPECT_GE(overlap(cloud, found.planes[0], 0), 0.97) << outliers;
  }
}

TEST(AutoPlanes, PlanesWithoutNoiseAreFound) {
  const LabelledPoints cloud = room(0.0);
  const Extraction found = extract(cloud.points);
  ASSERT_EQ(found.planes.size(), 6u);
  for (std::uint32_t label = 0; label < 6; ++label)
    EXPECT_GE(best_overlap(cloud, found, label), 0.93) << label;
}

TEST(AutoPlanes, ALargeCloudIsSettledWithAllPoints) {
  LabelledPoints cloud;
  add(cloud, {{3, 3, 1}, Vec3::UnitX(), Vec3::UnitY(), 2.0, 2.0, 20000, 0.02}, 0);
  add(cloud, {{1, 3, 2}, Vec3::UnitY(), Vec3::UnitZ(), 2.0, 1.0, 12000, 0.02}, 1);
  add_outliers(cloud, 1500, 10.0, 1);
  AutoOptions options;
  options.sample_points = 4000;
  const Extraction found = extract(cloud.points, options);
  expect_sound(found, cloud.points);
  ASSERT_EQ(found.planes.size(), 2u);
  for (std::uint32_t label = 0; label < 2; ++label) EXPECT_GE(best_overlap(cloud, found, label), 0.97);
}

TEST(AutoPlanes, PiecesOfOnePlaneThatLieApartAreSeveral) {
  LabelledPoints cloud;
  add(cloud, {{2, 2, 1}, Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 600, 0.02}, 0);
  add(cloud, {{5, 2, 1}, Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 600, 0.02}, 1);
  const Extraction found = extract(cloud.points);
  ASSERT_EQ(found.planes.size(), 2u);
  for (std::uint32_t label = 0; label < 2; ++label) EXPECT_GE(best_overlap(cloud, found, label), 0.97);
}

/// Two boards of 2 x 2 that meet at x = 5: the second rises by `slope` from there, and starts `step` higher.
LabelledPoints two_boards(double slope, double step) {
  const Vec3 along = Vec3(1.0, 0.0, slope).normalized();
  LabelledPoints cloud;
  add(cloud, {{4.0, 5.0, 5.0}, Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 3000, 0.005}, 0);
  add(cloud, {Vec3(5.0, 5.0, 5.0 + step) + along, along, Vec3::UnitY(), 1.0, 1.0, 3000, 0.005}, 1);
  return cloud;
}

TEST(AutoPlanes, FacetsThatMeetWithoutAStepAreOnePlaneIfTheyBendLittle) {
  const AutoOptions apart{.bend = 0.0};
  const LabelledPoints bent = two_boards(0.06, 0.0);
  EXPECT_EQ(extract(bent.points, apart).planes.size(), 2u);
  const Extraction found = extract(bent.points);
  expect_sound(found, bent.points);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_GE(found.planes[0].members.size(), 5900u);
  EXPECT_EQ(extract(two_boards(0.5, 0.0).points).planes.size(), 2u) << "an edge";
  EXPECT_EQ(extract(two_boards(0.0, 0.05).points).planes.size(), 2u) << "a step";
  LabelledPoints pair = two_boards(0.0, 0.0);
  add(pair, {{4.5, 5.0, 5.03}, Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 3000, 0.005}, 2);
  EXPECT_EQ(extract(pair.points).planes.size(), 2u) << "one above the other";
}

TEST(AutoPlanes, APlaneIsOneWhereItsDensityFallsAHundredfold) {
  // As a scanner in the middle of a room sees a ceiling: a circle of each radius has as many points.
  const Random random(5, stream_id("test.em.ceiling"));
  std::vector<Vec3> cloud;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double radius = random.uniform(0, 2 * i, 0.1, 4.0);
    const double turn = random.uniform(0, 2 * i + 1, 0.0, 2.0 * M_PI);
    cloud.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 2.0 + 0.004 * random.normal(1, i));
  }
  const Extraction found = extract(cloud);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_GE(found.planes[0].members.size(), 7800u);
}

TEST(AutoPlanes, ASurfaceThatBendsBeyondItsNoiseIsFound) {
  // A ceiling that a scanner bends by five standard deviations over its half, and a floor.
  const Random random(6, stream_id("test.em.bent"));
  LabelledPoints cloud;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const double x = random.uniform(0, 2 * i, -2.5, 2.5), y = random.uniform(0, 2 * i + 1, -2.5, 2.5);
    const double bend = 0.025 * (x * x + y * y) / 6.25;
    cloud.points.emplace_back(x, y, 2.0 - bend + 0.005 * random.normal(1, i));
    cloud.labels.push_back(0);
  }
  add(cloud, {{0.0, 0.0, 0.0}, Vec3::UnitX(), Vec3::UnitY(), 2.5, 2.5, 6000, 0.005}, 1);
  const Extraction found = extract(cloud.points);
  expect_sound(found, cloud.points);
  EXPECT_GE(best_overlap(cloud, found, 0), 0.95);
  EXPECT_GE(best_overlap(cloud, found, 1), 0.99);
}

TEST(AutoPlanes, ACrowdOfThickPlanesIsToldApart) {
  double sum = 0.0;
  std::uint32_t planes = 0;
  for (std::uint32_t scene = 0; scene < 4; ++scene) {
    const LabelledPoints cloud = crowd(scene, 40);
    const Extraction found = extract(cloud.points);
    for (std::uint32_t label = 0; label < 40; ++label, ++planes) {
      sum += best_overlap(cloud, found, 40 * scene + label);
    }
  }
  EXPECT_GE(sum / planes, 0.882);
}

TEST(AutoPlanes, PointsThatAreNotFiniteBelongToNoneAndChangeNothing) {
  const LabelledPoints cloud = room();
  const Extraction found = extract(cloud.points);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Vec3> bad{{nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}, {1e200, 0, 0}};
  bad.insert(bad.end(), cloud.points.begin(), cloud.points.end());
  const Extraction again = extract(bad);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(again.labels[i], kNoPlane);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) ASSERT_EQ(again.labels[i + 4], found.labels[i]);
}

TEST(AutoPlanes, CloudsWithoutAPlaneHaveNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<Vec3>> clouds{{}, {{1, 2, 3}}, {{1, 2, 3}, {3, 2, 1}}, {{nan, nan, nan}}};
  clouds.emplace_back(500, Vec3(1, 2, 3));
  clouds.emplace_back(500, Vec3(1e9, -1e9, 1e9));
  std::vector<Vec3> line;
  for (int i = 0; i < 500; ++i) line.emplace_back(0.1 * i, 0.2 * i, -0.3 * i);
  clouds.push_back(line);
  for (Vec3& p : line) p *= 1e9;
  clouds.push_back(line);
  for (const std::vector<Vec3>& cloud : clouds) {
    const Extraction found = extract(cloud);
    EXPECT_TRUE(found.planes.empty());
    EXPECT_EQ(found.labels, std::vector<std::uint32_t>(cloud.size(), kNoPlane));
    EXPECT_EQ(found.noise, 0.0);
  }
}

TEST(AutoPlanes, AFarStrayDoesNotMakeTheRestCoarse) {
  LabelledPoints cloud = room();
  cloud.points.emplace_back(1e9, 1e9, -1e9);
  cloud.labels.push_back(kNoPlane);
  const Extraction found = extract(cloud.points);
  ASSERT_EQ(found.planes.size(), 6u);
  EXPECT_EQ(found.labels.back(), kNoPlane);
  for (std::uint32_t label = 0; label < 6; ++label)
    EXPECT_GE(best_overlap(cloud, found, label), 0.93) << label;
}

TEST(AutoOptions, EachIsCheckedAtBothEndsAndNamed) {
  std::set<std::string> names;
  for (const OptionRow<AutoOptions>& row : auto_options()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_STRNE(row.help, "");
    const double margin = row.whole != nullptr ? 1.0 : 0.01 * (row.max - row.min);
    for (const double value : {row.min - margin, row.max + margin}) {
      AutoOptions options;
      row.set(options, value);
      try {
        PlaneExtractor extractor(options);
        FAIL() << row.name << " = " << value << " was accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_NO_THROW(AutoOptions().validate());
}

}  // namespace
}  // namespace hallway::em
