// SPDX-License-Identifier: MIT
#include "bsp/segment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bsp/point_location.hpp"
#include "query_worlds.hpp"
#include "solid_oracle.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using bsp::first_solid;
using test::QueryWorld;
using test::SolidOracle;

constexpr double kNear = 1e-6;  ///< metres from a face within which either answer is right

/// Segments from empty space in a world, of all lengths; some run along an axis.
class Segments {
 public:
  explicit Segments(const QueryWorld& world)
      : tree_(world.compiled.tree), box_(world.world.bounds), random_(5, stream_id("segments")) {}

  std::pair<Vec3, Vec3> segment(std::uint32_t number) const {
    Vec3 from = place(number, 0);
    for (std::uint64_t i = 1; i < 400 && is_solid(from); ++i) from = place(number, 3 * i);
    Vec3 to = place(number, 2000);
    const double share = random_.uniform(number, 2010);
    const double kind = random_.uniform(number, 2011);
    if (kind < 0.5) to = from + share * share * share * (to - from);
    if (kind < 0.1) to.z() = from.z();
    if (kind < 0.05) to.y() = from.y();
    return {from, to};
  }
  bool is_solid(const Vec3& point) const {
    return tree_.leaves[bsp::leaf_at(tree_, point)].content == bsp::Content::kSolid;
  }

 private:
  Vec3 place(std::uint32_t number, std::uint64_t index) const {
    Vec3 point;
    for (int k = 0; k < 3; ++k) {
      const double margin = 0.02 * box_.sizes()[k];
      point[k] = random_.uniform(number, index + static_cast<std::uint64_t>(k), box_.min()[k] - margin,
                                 box_.max()[k] + margin);
    }
    return point;
  }

  const bsp::Tree& tree_;
  Box box_;
  Random random_;
};

/// Asks the tree and the brushes, made a little more and a little less solid, about one segment.
class Judge {
 public:
  explicit Judge(const QueryWorld& world)
      : world_(world), more_(world.world, kNear), less_(world.world, -kNear) {}

  void compare(const Vec3& from, const Vec3& to) {
    ++asked_;
    const auto hit = first_solid(world_.compiled.tree, from, to);
    ASSERT_EQ(bsp::blocked(world_.compiled.tree, from, to), hit.has_value());
    const double fraction = hit ? hit->fraction : kMissed;
    const double sooner = more_.first_solid(from, to).value_or(kMissed);
    const double later = less_.first_solid(from, to).value_or(kMissed);
    const double length = (to - from).norm();
    // The brushes' planes are rounded too: far less than kNear.
    ASSERT_GE(fraction * length, sooner * length - 1e-9) << from.transpose() << " to " << to.transpose();
    ASSERT_LE(fraction * length, later * length + 1e-9) << from.transpose() << " to " << to.transpose();
    if ((later - sooner) * length > 1e-3) ++near_;
    if (hit) {
      ++hits_;
      check_hit(*hit, from, to);
    }
  }

  void report(double most_near) const {
    const double share = static_cast<double>(near_) / static_cast<double>(asked_);
    std::printf("%s: %zu segments, %zu blocked, share near a face %.2e\n", world_.name.c_str(), asked_, hits_,
                share);
    testing::Test::RecordProperty(world_.name + " near a face", std::to_string(share));
    EXPECT_LT(share, most_near);
    EXPECT_GT(hits_, asked_ / 10);
    EXPECT_LT(hits_, asked_);
  }

 private:
  static constexpr double kMissed = 2.0;

  void check_hit(const bsp::SegmentHit& hit, const Vec3& from, const Vec3& to) const {
    ASSERT_EQ(world_.compiled.tree.leaves[hit.leaf].content, bsp::Content::kSolid);
    ASSERT_LE((hit.point - (from + hit.fraction * (to - from))).norm(), 1e-9);
    if (hit.starts_in_solid) {
      ASSERT_EQ(hit.fraction, 0.0);
      return;
    }
    ASSERT_LT(hit.normal.dot(to - from), 0.0);
    ASSERT_TRUE(lies_on_face(hit.point, hit.normal))
        << hit.point.transpose() << " " << hit.normal.transpose();
  }

  bool lies_on_face(const Vec3& point, const Vec3& normal) const {
    for (const map::Solid& solid : world_.world.solids) {
      if (!solid.contains(point, -1e-5)) continue;
      for (const Plane& plane : solid.planes) {
        if (std::abs(plane.distance(point)) < kNear && std::abs(plane.normal.dot(normal)) > 1.0 - 1e-9)
          return true;
      }
    }
    return false;
  }

  const QueryWorld& world_;
  SolidOracle more_, less_;
  std::size_t asked_ = 0, near_ = 0, hits_ = 0;
};

void check_random_segments(const QueryWorld& world, std::uint32_t count) {
  ASSERT_TRUE(world.world.solids.size() > 1);
  const Segments segments(world);
  Judge judge(world);
  for (std::uint32_t i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
    const auto [from, to] = segments.segment(i);
    if (!segments.is_solid(from)) judge.compare(from, to);
  }
  judge.report(1e-3);
}

TEST(Segment, AgreesWithTheBrushesOfMadeWorlds) {
  for (const QueryWorld& world : test::made_worlds()) {
    ASSERT_TRUE(world.world.problems.empty());
    EXPECT_EQ(world.compiled.enclosure.sealed, world.name == "rooms");
    check_random_segments(world, test::sized(20000u, 100000u));
  }
}

TEST(Segment, AgreesWithTheBrushesOfRealMaps) {
  for (const char* name : {"maps/id1/e1m1.map", "maps/librequake/start.map"}) {
    HALLWAY_DATA_OR_SKIP(path, name);
    check_random_segments(test::load_query_world(path), test::sized(4000u, 100000u));
  }
}

/// Segments within the planes of nodes, where leaves meet: none may slip between two solid ones.
TEST(Segment, DoesNotSlipBetweenLeaves) {
  const Random random(6, stream_id("planes"));
  for (const QueryWorld& world : test::made_worlds()) {
    const bsp::Tree& tree = world.compiled.tree;
    const SolidOracle less(world.world, -kNear);
    const Segments segments(world);
    std::size_t hits = 0;
    for (std::uint32_t i = 0; i < test::sized(5000u, 50000u); ++i) {
      auto [from, to] = segments.segment(i);
      for (std::uint64_t k = 0; k < 2; ++k) {  // in one plane, or along the line that two have in common
        const Plane plane = tree.plane(random.bits(i, k)[0] % static_cast<std::uint32_t>(tree.nodes.size()));
        from -= plane.distance(from) * plane.normal;
        to -= plane.distance(to) * plane.normal;
        if (!world.compiled.enclosure.sealed || !segments.is_solid(from)) {
          const auto expected = less.first_solid(from, to);
          if (expected) {
            const auto hit = first_solid(tree, from, to);
            ASSERT_TRUE(hit) << from.transpose() << " to " << to.transpose();
            ASSERT_LE(hit->fraction, *expected + 1e-9);
            ++hits;
          }
        }
      }
    }
    EXPECT_GT(hits, 100u) << world.name;
  }
}

class InRooms : public testing::Test {
 protected:
  const bsp::Tree& tree() { return world().compiled.tree; }
  static const QueryWorld& world() {
    static const QueryWorld rooms = test::make_query_world("rooms", test::rooms(), {{1, 6, 1}});
    return rooms;
  }
};

TEST_F(InRooms, AWallIsMetWithItsNormal) {
  const auto hit = first_solid(tree(), {8, 7, 1}, {12, 7, 1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->fraction, 0.5);
  EXPECT_EQ(hit->point, Vec3(10, 7, 1));
  EXPECT_EQ(hit->normal, Vec3(-1, 0, 0));
  EXPECT_FALSE(hit->starts_in_solid);
  EXPECT_FALSE(bsp::blocked(tree(), {8, 5.5, 1}, {12, 5.5, 1}));  // through the door
}

TEST_F(InRooms, WhatOnlyTouchesIsNotHit) {
  const std::pair<Vec3, Vec3> touching[] = {
      {{1, 6, 0}, {9, 7, 0}},                             // along the floor
      {{1, 6, 4}, {9, 7, 4}},                             // along the ceiling
      {{0, 1, 1}, {0, 11, 3}},                            // along walls
      {{10, 1, 1}, {10, 4, 3}}, {{0, 1, 0}, {0, 11, 0}},  // along edges
      {{10, 0, 1}, {10, 0, 3}}, {{0, 0, 0}, {0, 0, 4}},   // from corner to corner
      {{5, 6, 1}, {0, 7, 2}},                             // ends on a face
      {{10, 7, 1}, {5, 6, 1}},                            // starts on one
      {{5, 6, 1}, {0, 0, 0}},                             // ends in a corner
      {{10, 7, 1}, {10, 7, 1}},                           // points on a face, on an edge, in a corner
      {{0, 1, 0}, {0, 1, 0}},   {{0, 0, 4}, {0, 0, 4}},
  };
  for (const auto& [from, to] : touching) {
    EXPECT_FALSE(first_solid(tree(), from, to)) << from.transpose() << " to " << to.transpose();
    EXPECT_FALSE(first_solid(tree(), to, from)) << to.transpose() << " to " << from.transpose();
  }
}

/// Where a segment meets the plane in which it ends is rounded, and must not put its last bit behind the plane.
TEST_F(InRooms, AnEndOnAFaceIsNoHitFromAnywhere) {
  const Random random(7, stream_id("ends on faces"));
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const auto in = [&](std::uint64_t n, double low, double high) { return random.uniform(i, n, low, high); };
    const Vec3 from(in(0, 0.1, 9.9), in(1, 6.1, 7.9), in(2, 0.1, 3.9));  // nothing is between
    Vec3 to(in(3, 0.1, 9.9), in(4, 6.1, 7.9), in(5, 0.1, 3.9));
    const double face[] = {0.0, 10.0, 0.0, 4.0};
    const int axis[] = {0, 0, 2, 2};
    to[axis[i % 4]] = face[i % 4];
    ASSERT_FALSE(first_solid(tree(), from, to)) << from.transpose() << " to " << to.transpose();
    ASSERT_FALSE(first_solid(tree(), to, from)) << to.transpose() << " to " << from.transpose();
    // A little farther it is one.
    Vec3 beyond = to;
    beyond[axis[i % 4]] += i % 4 == 1 || i % 4 == 3 ? 1e-9 : -1e-9;
    ASSERT_TRUE(first_solid(tree(), from, beyond)) << from.transpose() << " to " << beyond.transpose();
  }
}

TEST_F(InRooms, StartingOnAFaceAndGoingInIsAHitAtTheStart) {
  for (const auto& [from, to] :
       {std::pair<Vec3, Vec3>{{10, 7, 1}, {12, 7, 1}}, {{0, 7, 1}, {-2, 7, 1}}, {{3, 6, 0}, {3, 6, -1}}}) {
    const auto hit = first_solid(tree(), from, to);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0.0);
    EXPECT_FALSE(hit->starts_in_solid);
    EXPECT_EQ(hit->normal, (from - to).normalized());
  }
}

TEST_F(InRooms, APlaneOfOneBrushIsNoWayThroughAnother) {
  // In the face x = 4.5 of one pillar, through the other that overlaps it.
  for (const double shift : {0.0, 1e-17, 1e-13, -1e-13}) {
    const auto hit = first_solid(tree(), {4.5 + shift, 1, 1}, {4.5 - shift, 11, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.y(), 4.25, 0.25 + 1e-12);  // 4.0 if it counts as inside the first
  }
}

TEST_F(InRooms, PointsAreInSolidOrNot) {
  EXPECT_FALSE(first_solid(tree(), {5, 6, 1}, {5, 6, 1}));
  for (const Vec3& point : {Vec3(10.25, 9, 1), Vec3(4.4, 4.4, 1), Vec3(100, 0, 0)}) {
    const auto hit = first_solid(tree(), point, point);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->starts_in_solid);
    EXPECT_EQ(hit->fraction, 0.0);
    EXPECT_EQ(hit->normal, Vec3(Vec3::Zero()));
    EXPECT_TRUE(first_solid(tree(), point, {5, 6, 1})->starts_in_solid);
  }
}

TEST_F(InRooms, RefusesPointsThatAreNoPlaces) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity, 2e8, -2e8}) {
    for (const int axis : {0, 1, 2}) {
      Vec3 point(5, 6, 1);
      point[axis] = bad;
      for (const auto& error : {test::error_of([&] {
                                  first_solid(tree(), point, {5, 6, 1});
                                }),
                                test::error_of([&] {
                                  bsp::blocked(tree(), {5, 6, 1}, point);
                                })}) {
        ASSERT_TRUE(error);
        EXPECT_EQ(error->code(), ErrorCode::kBadInput);
      }
    }
  }
}

TEST(Segment, FromFarAway) {
  test::WorldMaker maker;
  const QueryWorld world = test::make_query_world("box", maker.box({-1, -1, -1}, {1, 1, 1}).world(), {});
  for (const double far : {1e3, 1e7}) {
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(1, 0.2, -0.3)}) {
      const auto hit = first_solid(world.compiled.tree, far * direction, -far * direction);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->point.cwiseAbs().maxCoeff(), 1.0, 1e-15 * far * 10);
      EXPECT_FALSE(bsp::blocked(world.compiled.tree, far * direction, 2.0 * direction));
    }
    EXPECT_FALSE(bsp::blocked(world.compiled.tree, {-far, 1.0 + 1e-6, 0}, {far, 1.0 + 1e-6, 0}));
  }
}

TEST(Segment, InEmptyAndInFullSpace) {
  bsp::Tree tree;
  tree.leaves.resize(1);
  bsp::set_nodes(tree, {});
  EXPECT_FALSE(first_solid(tree, {0, 0, 0}, {1, 0, 0}));
  tree.leaves[0].content = bsp::Content::kSolid;
  bsp::set_nodes(tree, {});
  EXPECT_TRUE(first_solid(tree, {0, 0, 0}, {1, 0, 0})->starts_in_solid);
}

}  // namespace
}  // namespace hallway
