// SPDX-License-Identifier: MIT
// A robot in a room whose map is right: wherever it was answered to be, it is placed where its planes say.
#include "eval/refitted_planes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.hpp"

namespace hallway::eval {
namespace {

/// A room of 6 x 4 m; walls 0 to 3 are south, east, north, west, each seen from inside. From there the left end of wall k is corner k + 1.
constexpr std::array<std::array<double, 2>, 4> kRoom{{{0, 0}, {6, 0}, {6, 4}, {0, 4}}};

std::array<Vec3, 4> corners_of(std::size_t k) {
  const auto &r = kRoom[k], &l = kRoom[(k + 1) % 4];
  return {Vec3(l[0], l[1], 0), Vec3(r[0], r[1], 0), Vec3(r[0], r[1], 2), Vec3(l[0], l[1], 2)};
}

Vec3 normal_of(const std::array<Vec3, 4>& corners) {
  return (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
}

std::vector<log::PlaneLandmark> map_of(std::size_t walls) {
  std::vector<log::PlaneLandmark> map;
  for (std::size_t k = 0; k < walls; ++k) {
    const std::array<Vec3, 4> corners = corners_of(k);
    const Vec3 normal = normal_of(corners);
    log::PlaneLandmark& plane = map.emplace_back();
    plane.id = 10 + k;
    plane.normal = {normal.x(), normal.y(), normal.z()};
    plane.offset_m = normal.dot(corners[0]);
    for (std::size_t i = 0; i < 4; ++i)
      plane.outline.push_back({{corners[i].x(), corners[i].y(), corners[i].z()}, i % 2 == 1});
  }
  return map;
}

Pose turned(double yaw, const Vec3& t) {
  return {Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ())), t};
}

struct Noise {
  double angle = 0.0, normal = 0.0, end = 0.0;
};

/// What a robot sees of a wall, cut short by `cut` of it at its right end.
AssociatedPlane seen(const Pose& T_map_body, std::size_t wall, double cut = 0.0) {
  std::array<Vec3, 4> corners = corners_of(wall);
  const Vec3 way = corners[1] - corners[0];
  for (const std::size_t i : {1u, 2u}) corners[i] -= cut * way;
  AssociatedPlane given;
  given.true_plane = wall;
  given.landmark = 10 + wall;
  const Pose inverse = T_map_body.inverse();
  given.normal = inverse.q * normal_of(corners);
  for (const Vec3& corner : corners) {
    given.bounds.push_back(inverse * corner);
    given.centroid += given.bounds.back() / 4.0;
  }
  return given;
}

/// The plane off its place: across, turned about its middle, and each end along it.
AssociatedPlane shaken(AssociatedPlane plane, const Noise& noise, const Random& random, std::uint32_t frame,
                       std::uint64_t key) {
  const Quat turn(Eigen::AngleAxisd(noise.angle * random.normal(frame, key), Vec3::UnitZ()));
  const Vec3 step = noise.normal * random.normal(frame, key + 1) * plane.normal;
  const Vec3 along = Vec3::UnitZ().cross(plane.normal);
  for (Vec3& bound : plane.bounds) {
    const bool left = along.dot(bound - plane.centroid) > 0.0;
    const Vec3 longer = noise.end * random.normal(frame, key + (left ? 2 : 3)) * along;
    bound = plane.centroid + turn * (bound - plane.centroid) + step + longer;
  }
  plane.centroid += step;
  plane.normal = turn * plane.normal;
  return plane;
}

TEST(RefittedPlanes, ExactPlanesGiveTheTruePlaceWhateverWasAnswered) {
  RefittedPlanes path;
  std::vector<Pose> truth;
  for (std::uint32_t i = 0; i < 20; ++i) {
    truth.push_back(turned(0.1 * i, Vec3(2 + 0.1 * i, 2, 0.8)));
    std::vector<AssociatedPlane> given;
    for (std::size_t k = 0; k < 4; ++k) given.push_back(seen(truth.back(), k));
    path.add(i, turned(0.1 * i + 0.01, truth.back().t + Vec3(0.02, -0.03, 0)), given);
  }
  const auto placed = path.place(map_of(4));
  ASSERT_EQ(placed.size(), truth.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    EXPECT_EQ(placed[i].iteration, i);
    EXPECT_NEAR((placed[i].T_map_body.t - truth[i].t).norm(), 0.0, 1e-9);
    EXPECT_NEAR(placed[i].T_map_body.q.angularDistance(truth[i].q), 0.0, 1e-9);
  }
}

TEST(RefittedPlanes, WhatIsCutIsNoEnd) {
  // One long wall and the end of another: the cut one must not pull.
  const Pose truth = turned(0.3, Vec3(2, 2, 0.8));
  RefittedPlanes path;
  for (std::uint32_t i = 0; i < 20; ++i)
    path.add(i, truth, std::array{seen(truth, 0, 0.3), seen(truth, 1, 0.4)});
  for (const auto& placed : path.place(map_of(2)))
    EXPECT_NEAR((placed.T_map_body.t - truth.t).norm(), 0.0, 1e-9);
}

TEST(RefittedPlanes, FramesThatLeaveADirectionOpenAreLeftOut) {
  const Pose truth = turned(0.0, Vec3(2, 2, 0.8));
  RefittedPlanes path;
  path.add(0, truth, std::array{seen(truth, 0), seen(truth, 1)});
  AssociatedPlane cut =
      seen(truth, 0,
           0.3);  // its left end is in the open: a wall, cut at both ends, does not tell the place along it
  for (const std::size_t i : {0u, 3u}) cut.bounds[i] += 0.5 * (cut.bounds[1] - cut.bounds[0]);
  path.add(1, truth, std::array{cut});
  path.add(2, truth, {});
  const auto placed = path.place(map_of(4));
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].iteration, 0u);
}

TEST(RefittedPlanes, PlanesThatAreNotInTheMapSayNothing) {
  const Pose truth = turned(0.0, Vec3(2, 2, 0.8));
  RefittedPlanes path;
  AssociatedPlane stranger = seen(truth, 2);
  stranger.landmark = 99;
  AssociatedPlane unplaced = seen(truth, 3);
  unplaced.normal.setZero();
  path.add(0, truth, std::array{stranger, unplaced});
  EXPECT_TRUE(path.place(map_of(4)).empty());
}

TEST(RefittedPlanes, ACutNearAnEndDoesNotMoveWhatLinesTell) {
  RefittedPlanes path;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Pose T = turned(0.1 * i, Vec3(2, 2, 0.8));
    path.add(i, T, std::array{seen(T, 0), seen(T, 1)});
  }
  const Pose truth = turned(0.3, Vec3(2, 2, 0.8));
  path.add(20, truth, std::array{seen(truth, 0, 0.08 / 6.0), seen(truth, 1)});
  const auto placed = path.place(map_of(2));
  ASSERT_EQ(placed.size(), 21u);
  EXPECT_NEAR((placed[20].T_map_body.t - truth.t).norm(), 0.0, 1e-9);
}

TEST(RefittedPlanes, OneEndAloneDoesNotTellThePlace) {
  // A cut 5 cm from where the wall ends looks like its end, and nothing else in the frame says that it is none.
  const Pose truth = turned(0.0, Vec3(2, 2, 0.8));
  RefittedPlanes path;
  for (std::uint32_t i = 0; i < 20; ++i) path.add(i, truth, std::array{seen(truth, 0), seen(truth, 1)});
  AssociatedPlane one = seen(truth, 0, 0.05 / 6.0);
  for (const std::size_t i : {0u, 3u}) one.bounds[i] += 0.5 * (one.bounds[1] - one.bounds[0]);
  path.add(20, truth, std::array{one});
  path.add(21, truth, std::array{seen(truth, 0)});  // both ends, as far apart as they are in the map
  const auto placed = path.place(map_of(4));
  ASSERT_EQ(placed.size(), 21u);
  EXPECT_EQ(placed.back().iteration, 21u);
}

TEST(RefittedPlanes, APlaneThatIsGoneStandsForTheOneWhereItWasSeen) {
  const Pose truth = turned(0.3, Vec3(2, 2, 0.8));
  const Pose answered = turned(0.3, truth.t + Vec3(0.02, 0.05, 0));
  const auto placed_of = [&](std::uint32_t frames) {
    RefittedPlanes path;
    for (std::uint32_t i = 0; i < frames; ++i) {
      AssociatedPlane gone = seen(truth, 2, 0.3);
      gone.landmark = 99;
      path.add(i, answered, std::array{seen(truth, 1, 0.4), gone});
    }
    return path.place(map_of(4));
  };
  EXPECT_TRUE(placed_of(4).empty());  // too seldom to tell
  const auto placed = placed_of(10);
  ASSERT_EQ(placed.size(), 10u);
  for (const auto& one : placed) EXPECT_NEAR((one.T_map_body.t - truth.t).norm(), 0.0, 1e-6);
}

TEST(RefittedPlanes, EachKindIsWeighedByItsScatter) {
  // Ends that are good to 5 mm and lines to 5 cm: the error is that of the ends, though nobody says which is the better.
  const Random random(1, stream_id("test.refitted_planes"));
  const auto rms = [&](const Noise& noise) {
    RefittedPlanes path;
    std::vector<Vec3> truth;
    for (std::uint32_t i = 0; i < 300; ++i) {
      const Pose T = turned(0.02 * i, Vec3(2 + 0.005 * i, 2, 0.8));
      std::vector<AssociatedPlane> given;
      for (std::size_t k = 0; k < 4; ++k) given.push_back(shaken(seen(T, k), noise, random, i, 4 * k));
      path.add(i, T, given);
      truth.push_back(T.t);
    }
    double sum = 0.0;
    const auto placed = path.place(map_of(4));
    EXPECT_EQ(placed.size(), truth.size());
    for (std::size_t i = 0; i < placed.size(); ++i) sum += (placed[i].T_map_body.t - truth[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(truth.size()));
  };
  // Of two parallel walls each tells the place across by its line, of the other two by both ends each.
  EXPECT_LT(rms({.angle = 1e-4, .normal = 0.05, .end = 0.005}), 0.005);
  EXPECT_LT(rms({.angle = 1e-4, .normal = 0.002, .end = 0.02}), 0.003);
}

}  // namespace
}  // namespace hallway::eval
