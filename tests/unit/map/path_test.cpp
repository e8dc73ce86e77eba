// SPDX-License-Identifier: MIT
#include "map/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "map/polyline_corners.hpp"
#include "map/reader.hpp"
#include "map_text.hpp"
#include "support/errors.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;
using Pairs = std::vector<std::array<std::string, 2>>;
constexpr double kPi = std::numbers::pi;

Vec3 forward(const Pose& pose) {
  return pose.q * Vec3::UnitX();
}

double chords(const Path& path, double from, double to, int count) {
  double length = 0.0;
  Vec3 last = path.at(from).t;
  for (int i = 1; i <= count; ++i) {
    const Vec3 next = path.at(from + (to - from) * i / count).t;
    length += (next - last).norm();
    last = next;
  }
  return length;
}

/// Length of the curve between two distances from its points alone: chords, extrapolated to none (Richardson).
double sampled_length(const Path& path, double from, double to, int count) {
  return (4.0 * chords(path, from, to, 2 * count) - chords(path, from, to, count)) / 3.0;
}

void expect_forward_is_the_tangent(const Path& path) {
  constexpr int kPlaces = 997;
  constexpr double kStep_m = 1e-3;
  for (int i = 0; i < kPlaces; ++i) {
    const double s = kStep_m + (path.length_m() - 2.0 * kStep_m) * i / kPlaces;
    const Vec3 difference = (path.at(s + kStep_m).t - path.at(s - kStep_m).t) / (2.0 * kStep_m);
    EXPECT_LT((difference - forward(path.at(s))).norm(), 2e-3) << "at " << s << " m";
  }
}

void expect_level(const Path& path) {
  for (int i = 0; i < 100; ++i) {
    const Pose pose = path.at(path.length_m() * i / 100.0);
    EXPECT_NEAR((pose.q * Vec3::UnitY()).z(), 0.0, 1e-15);
    EXPECT_GT((pose.q * Vec3::UnitZ()).z(), 0.0);
  }
}

Path eight(double length, double rise, double heading = 0.0) {
  return Path(Lemniscate({Vec3(1, 2, 3), heading, length, rise}));
}

TEST(Lemniscate, StartsExactlyAtTheCrossing) {
  const Path path = eight(1145.0, 12.0);
  EXPECT_EQ(path.at(0.0).t, Vec3(1, 2, 3));
  EXPECT_EQ(path.length_m(), 1145.0);
  EXPECT_TRUE(path.closed());
}

TEST(Lemniscate, StartsWithTheHeadingWanted) {
  for (const double heading : {0.0, 1.0, -2.5, kPi}) {
    const Vec3 x = forward(eight(100.0, 0.0, heading).at(0.0));
    EXPECT_LT((x - Vec3(std::cos(heading), std::sin(heading), 0.0)).norm(), 1e-12);
  }
}

TEST(Lemniscate, TurnsLeftFirstThenRight) {
  const Path path = eight(100.0, 0.0);
  EXPECT_GT(path.at(25.0).t.y(), 2.0);
  EXPECT_GT(forward(path.at(1.0)).y(), 0.0);
  EXPECT_LT((forward(path.at(50.0)) + Vec3::UnitY()).norm(), 1e-9);
  EXPECT_LT(forward(path.at(51.0)).x(), 0.0);
  EXPECT_LT(path.at(75.0).t.x(), 1.0);
}

TEST(Lemniscate, IsAsLongAsItSays) {
  for (const double rise : {0.0, 12.0, -40.0, 250.0}) {
    EXPECT_NEAR(sampled_length(eight(1145.0, rise), 0.0, 1145.0, 5000), 1145.0, 1e-6) << "rise " << rise;
  }
}

TEST(Lemniscate, DistanceIsArcLengthEverywhere) {
  const Path path = eight(1145.0, 200.0);
  constexpr int kSections = 50;
  const double section = path.length_m() / kSections;
  for (int i = 0; i < kSections; ++i) {
    EXPECT_NEAR(sampled_length(path, i * section, (i + 1) * section, 100), section, 1e-6) << "section " << i;
  }
}

TEST(Lemniscate, PlanIsBernoullis) {
  // (x^2 + y^2)^2 = a^2 (x^2 - y^2) with the length 5.244115108584239 a of the plan.
  const Path path(Lemniscate({Vec3::Zero(), -kPi / 4.0, 1145.0, 0.0}));
  const double a = 1145.0 / 5.244115108584239;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = path.at(1145.0 * i / 1000.0).t / a;
    const double r2 = p.x() * p.x() + p.y() * p.y();
    EXPECT_NEAR(r2 * r2, p.x() * p.x() - p.y() * p.y(), 1e-12);
  }
  EXPECT_NEAR(path.at(1145.0 / 4.0).t.x(), a, 1e-9);
}

TEST(Lemniscate, TheCrossingIsPassedAboveItselfHalfWay) {
  const Path path = eight(1145.0, 12.0);
  const Pose half = path.at(1145.0 / 2.0);
  EXPECT_LT((half.t - Vec3(1, 2, 15)).norm(), 1e-9);
  EXPECT_NEAR(forward(half).z(), 0.0, 1e-12);
  EXPECT_NEAR(path.at(0.0).q.angularDistance(half.q), kPi / 2.0, 1e-9);
}

TEST(Lemniscate, ForwardIsTheTangent) {
  expect_forward_is_the_tangent(eight(1145.0, 120.0));
}
TEST(Lemniscate, SidesAreLevel) {
  expect_level(eight(1145.0, 120.0));
}

TEST(Lemniscate, GoesOnAfterARound) {
  const Path path = eight(100.0, 3.0);
  for (const double s : {0.0, 12.0, 99.0}) {
    EXPECT_LT((path.at(s).t - path.at(s + 300.0).t).norm(), 1e-10);
    EXPECT_LT((path.at(s).t - path.at(s - 200.0).t).norm(), 1e-10);
  }
  EXPECT_EQ(path.at(100.0).t, path.at(0.0).t);
  EXPECT_TRUE(path.at(-1e-20).t.allFinite());
}

const std::vector<Vec3> kSquare{Vec3(0, 0, 1), Vec3(10, 0, 1), Vec3(10, 10, 1), Vec3(0, 10, 1)};

TEST(RoundedPolyline, LengthOfASquareWithRoundCorners) {
  const Path path(RoundedPolyline(kSquare, true, 2.0));
  EXPECT_NEAR(path.length_m(), 4 * 6.0 + 2 * kPi * 2.0, 1e-12);
  EXPECT_NEAR(sampled_length(path, 0.0, path.length_m(), 10000), path.length_m(), 1e-5);
}

TEST(RoundedPolyline, AnOpenPathRunsFromItsFirstToItsLastWaypoint) {
  const Path path(RoundedPolyline(kSquare, false, 2.0));
  EXPECT_FALSE(path.closed());
  EXPECT_NEAR(path.length_m(), 8 + 6 + 8 + 2 * kPi, 1e-12);
  EXPECT_EQ(path.at(0.0).t, kSquare.front());
  EXPECT_LT((path.at(path.length_m()).t - kSquare.back()).norm(), 1e-12);
}

TEST(RoundedPolyline, AnOpenPathStandsAtItsEnds) {
  const Path path(RoundedPolyline(kSquare, false, 2.0));
  EXPECT_EQ(path.at(-5.0).t, path.at(0.0).t);
  EXPECT_EQ(path.at(1e6).t, path.at(path.length_m()).t);
}

TEST(RoundedPolyline, AClosedPathGoesOnAfterARound) {
  const Path path(RoundedPolyline(kSquare, true, 2.0));
  EXPECT_LT((path.at(3.0).t - path.at(3.0 + 2 * path.length_m()).t).norm(), 1e-12);
  EXPECT_LT((path.at(3.0).t - path.at(3.0 - path.length_m()).t).norm(), 1e-12);
}

TEST(RoundedPolyline, HeadingNeverJumps) {
  const std::vector<Vec3> waypoints{Vec3(0, 0, 0), Vec3(9, 1, 2), Vec3(8, 9, 0), Vec3(-3, 12, 1),
                                    Vec3(-2, 5, -2)};
  const Path path(RoundedPolyline(waypoints, true, 0.7));
  constexpr double kStep_m = 1e-3;
  for (double s = 0.0; s < path.length_m(); s += kStep_m) {
    const Pose here = path.at(s);
    const Pose next = path.at(s + kStep_m);
    ASSERT_LE((next.t - here.t).norm(), kStep_m * (1 + 1e-9)) << "at " << s;
    ASSERT_LE(angle_between(here.q, next.q), 1.2 * kStep_m / 0.7) << "at " << s;
  }
}

TEST(RoundedPolyline, ForwardIsTheTangent) {
  expect_forward_is_the_tangent(Path(RoundedPolyline(kSquare, true, 2.0)));
}

TEST(RoundedPolyline, SidesAreLevelOnASlope) {
  const std::vector<Vec3> slope{Vec3(0, 0, 0), Vec3(9, 1, 4), Vec3(8, 9, 0)};
  expect_level(Path(RoundedPolyline(slope, false, 0.7)));
}

TEST(RoundedPolyline, AWaypointOnAStraightLineIsPassed) {
  const std::vector<Vec3> waypoints{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(10, 0, 0)};
  const Path path(RoundedPolyline(waypoints, false, 2.0));
  EXPECT_EQ(path.length_m(), 10.0);
  EXPECT_EQ(path.at(4.0).t, Vec3(4, 0, 0));
}

TEST(RoundedPolyline, FaultsOfWaypoints) {
  const auto fault = [](const std::vector<Vec3>& waypoints, bool closed, double radius) {
    const auto found = check_polyline(waypoints, closed, radius);
    return found ? std::to_string(found->waypoint) + " " + found->message : std::string("none");
  };
  EXPECT_EQ(fault(kSquare, true, 5.0), "none");
  EXPECT_NE(fault(kSquare, true, 5.1).find("0 the corners here and at the next"), std::string::npos);
  EXPECT_NE(fault({Vec3::Zero()}, false, 1).find("0 the path has 1 waypoints; it needs at least 2"),
            std::string::npos);
  EXPECT_NE(fault({Vec3::Zero(), Vec3::UnitX()}, true, 1).find("at least 3"), std::string::npos);
  EXPECT_EQ(fault({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX()}, false, 1),
            "1 the next waypoint is at the same place");
  EXPECT_EQ(fault({Vec3::Zero(), Vec3::UnitZ()}, false, 1), "0 the way to the next waypoint is vertical");
  EXPECT_EQ(fault({Vec3::Zero(), Vec3::UnitX(), Vec3::Zero()}, false, 1),
            "1 the path turns straight back here");
}

const Pairs kWorld{{"classname", "worldspawn"}, {"_scale", "0.01"}};
const Pairs kWalk{{"classname", "hw_path"}, {"name", "walk"}};

Pairs waypoint(const std::string& index, const std::string& origin, const std::string& path = "walk") {
  return {{"classname", "hw_waypoint"}, {"path", path}, {"index", index}, {"origin", origin}};
}

Document document_of(const std::vector<Pairs>& entities) {
  std::string text;
  for (const Pairs& pairs : entities) text += test::entity_text(pairs);
  return parse(text, "a.map");
}

void expect_error(const std::vector<Pairs>& entities, const std::string& name, int line,
                  const std::string& cause) {
  const Document document = document_of(entities);
  const auto error = error_of([&] { find_path(document, name); });
  ASSERT_TRUE(error) << cause;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

TEST(FindPath, WaypointsFollowTheirIndex) {
  const Path path = find_path(document_of({kWorld, kWalk, waypoint("20", "500 0 0"), waypoint("3", "0 0 0"),
                                           waypoint("100", "500 500 0")}),
                              "walk");
  EXPECT_EQ(path.at(0.0).t, Vec3::Zero());
  EXPECT_LT((path.at(path.length_m()).t - Vec3(5, 5, 0)).norm(), 1e-12);
  EXPECT_NEAR(path.length_m(), 4.5 + 4.5 + 0.5 * kPi / 2.0, 1e-12);
}

TEST(FindPath, LemniscateKeys) {
  const Path path = find_path(document_of({kWorld,
                                           {{"classname", "hw_path"},
                                            {"name", "eight"},
                                            {"shape", "lemniscate"},
                                            {"origin", "100 200 300"},
                                            {"angle", "90"},
                                            {"length_m", "50"},
                                            {"rise_m", "2"}}}),
                              "eight");
  EXPECT_EQ(path.length_m(), 50.0);
  EXPECT_EQ(path.at(0.0).t, Vec3(1, 2, 3));
  EXPECT_LT((forward(path.at(0.0)) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(path.at(25.0).t.z(), 5.0, 1e-12);
}

TEST(FindPath, NamesWhatExists) {
  expect_error({kWorld, kWalk, {{"classname", "hw_path"}, {"name", "other"}}}, "wallk", 0,
               "it has `walk`, `other`");
  expect_error({kWorld, kWalk}, "wallk", 0, "did you mean \"walk\"");
  expect_error({kWorld}, "walk", 0, "it has no hw_path at all");
}

TEST(FindPath, NamesAreUnique) {
  expect_error({kWalk, kWalk}, "walk", 7, "a second path named `walk`");
}

TEST(FindPath, UnknownShape) {
  Pairs path = kWalk;
  path.push_back({"shape", "leminscate"});
  expect_error({path}, "walk", 4, "did you mean \"lemniscate\"");
}

TEST(FindPath, UnknownKey) {
  Pairs path = kWalk;
  path.push_back({"corner_radius", "1"});
  expect_error({path}, "walk", 4, "did you mean \"corner_radius_m\"");
}

TEST(FindPath, AWaypointOfNoPath) {
  expect_error({kWalk, waypoint("0", "0 0 0"), waypoint("1", "9 0 0", "wlak")}, "walk", 13,
               "did you mean \"walk\"");
}

TEST(FindPath, TwoWaypointsOfOneIndex) {
  expect_error({kWalk, waypoint("1", "0 0 0"), waypoint("1", "9 0 0")}, "walk", 14,
               "a second waypoint 1 of path `walk`");
}

TEST(FindPath, TooFewWaypoints) {
  expect_error({kWalk}, "walk", 1, "has 0 waypoints");
  expect_error({kWalk, waypoint("0", "0 0 0")}, "walk", 5, "has 1 waypoints");
}

TEST(FindPath, ACornerWithoutRoomNamesItsWaypoint) {
  Pairs path = kWalk;
  path.push_back({"corner_radius_m", "6"});
  expect_error({kWorld, path, waypoint("0", "0 0 0"), waypoint("5", "500 0 0"), waypoint("6", "500 500 0")},
               "walk", 10, "waypoint 0 of path `walk`: the corners here");
}

TEST(FindPath, LemniscateNeedsALength) {
  const Pairs path{{"classname", "hw_path"}, {"name", "e"}, {"shape", "lemniscate"}, {"origin", "0 0 0"}};
  expect_error({path}, "e", 1, "key `length_m` is missing");
  for (const char* length : {"0", "-5", "nan", "1e9"}) {
    Pairs bad = path;
    bad.push_back({"length_m", length});
    expect_error({bad}, "e", 6, "length_m");
  }
}

TEST(FindPath, ARiseTooSteep) {
  expect_error({{{"classname", "hw_path"},
                 {"name", "e"},
                 {"shape", "lemniscate"},
                 {"origin", "0 0 0"},
                 {"length_m", "100"},
                 {"rise_m", "26"}}},
               "e", 7, "must be at least -25 and at most 25");
}

}  // namespace
}  // namespace hallway::map
