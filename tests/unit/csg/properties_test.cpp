// SPDX-License-Identifier: MIT
// What must hold for every world: random ones of kinds that are hard in their own ways.
#include <gtest/gtest.h>

#include "csg/surface.hpp"
#include "support/long_mode.hpp"
#include "support/random_brushes.hpp"
#include "surface_checks.hpp"

namespace hallway::csg {
namespace {

using test::Act;
using test::kWorldKinds;
using test::RandomActs;
using test::WorldKind;

/// Points that were too near a face to be decided, of all.
struct Share {
  std::size_t left_out = 0;
  std::size_t all = 0;
};

/// Compares membership by winding number with the brushes at random points around the world.
std::string wrong_membership(const map::World& world, const Surface& surface, std::uint64_t seed, int points,
                             Share& share) {
  if (world.bounds.isEmpty()) return surface.polygons.empty() ? "" : "a surface of nothing";
  const auto triangles = test::triangles_of(surface);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-0.1, 1.1);
  for (int i = 0; i < points; ++i) {
    const double x = place(random), y = place(random);
    const Vec3 point = world.bounds.min() + world.bounds.sizes().cwiseProduct(Vec3(x, y, place(random)));
    ++share.all;
    if (test::near_a_face(world, point, 1e-6)) {
      ++share.left_out;
      continue;
    }
    const double winding = test::winding_number(triangles, point);
    const double wanted = test::brushes_solid(world, point) ? 1.0 : 0.0;
    // A crack of the welding distance changes the number of a point near it a little.
    if (std::abs(winding - wanted) > 0.05)
      return "winding number " + format_double(winding) + " instead of " + format_double(wanted) + " at " +
             format_double(point.x()) + " " + format_double(point.y()) + " " + format_double(point.z());
  }
  return {};
}

class EveryKind : public testing::TestWithParam<WorldKind> {
 protected:
  std::string fault_of(const std::vector<Act>& acts, std::uint64_t seed, int points) {
    const map::World world = map::build_world(test::document_of(acts));
    if (!world.problems.empty()) return "the generator made no body: " + world.problems.front().message;
    const Surface surface = build_surface(world);
    std::string fault = test::not_closed(surface);
    if (fault.empty()) fault = test::unsound_polygon(world, surface, 5e-6);
    if (fault.empty()) fault = test::t_junction(surface, 1e-6);
    if (fault.empty()) fault = test::wrong_owner(world, surface, 3e-6);
    if (fault.empty() && test::in_general_position(GetParam())) fault = test::not_manifold(surface);
    if (fault.empty()) fault = wrong_membership(world, surface, seed, points, share_);
    return fault;
  }

  Share share_;
};
INSTANTIATE_TEST_SUITE_P(Worlds, EveryKind, testing::ValuesIn(kWorldKinds));

TEST_P(EveryKind, TheSurfaceIsTheBoundaryOfWhatTheBrushesLeave) {
  const auto worlds = static_cast<std::uint64_t>(test::sized(60, 2000));
  constexpr int kPoints = 300;  // of all kinds more than 1e5
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    const std::vector<Act> acts = RandomActs(GetParam(), seed).make();
    const std::string fault = fault_of(acts, seed, kPoints);
    if (fault.empty()) continue;
    const auto smallest =
        test::shrunk(acts, [&](const std::vector<Act>& fewer) { return fault_of(fewer, seed, kPoints); });
    FAIL() << "seed " << seed << ": " << fault << "\nsmallest: " << fault_of(smallest, seed, kPoints) << '\n'
           << test::to_text(smallest);
  }
  EXPECT_EQ(share_.all, worlds * kPoints);
  EXPECT_LT(static_cast<double>(share_.left_out), 1e-3 * static_cast<double>(share_.all));
}

TEST_P(EveryKind, TheSurfaceIsTheSameBytesEachTime) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const map::World world = map::build_world(test::document_of(RandomActs(GetParam(), seed).make()));
    const Surface a = build_surface(world), b = build_surface(world);
    ASSERT_EQ(a.vertices, b.vertices);
    ASSERT_EQ(a.polygons.size(), b.polygons.size());
    for (std::size_t i = 0; i < a.polygons.size(); ++i) {
      ASSERT_EQ(a.polygons[i].vertices, b.polygons[i].vertices);
      ASSERT_EQ(a.polygons[i].solid, b.polygons[i].solid);
      ASSERT_EQ(a.polygons[i].face, b.polygons[i].face);
    }
  }
}

/// A large room with these brushes at its middle.
TEST_P(EveryKind, WhatIsTakenOutOfABlockIsWhatWasPutIn) {
  for (std::uint64_t seed = 100; seed < 100 + static_cast<std::uint64_t>(test::sized(25, 500)); ++seed) {
    std::vector<Act> acts = RandomActs(GetParam(), seed).make();
    const double solid = test::volume_of(build_surface(map::build_world(test::document_of(acts))));
    const Vec3 centre = acts.front().brush.faces.front().points[0];
    for (Act& act : acts) {
      act.role = act.role == map::BrushRole::kAdd ? map::BrushRole::kSubtract : map::BrushRole::kAdd;
    }
    const Vec3 half = Vec3::Constant(64.0);
    const Vec3 corner = centre.array().round();
    acts.insert(acts.begin(), {map::BrushRole::kAdd, test::box(corner - half, corner + half)});
    const double rest = test::volume_of(build_surface(map::build_world(test::document_of(acts))));
    const double block = 128.0 * 128.0 * 128.0;
    EXPECT_NEAR((solid + rest) / block, 1.0, 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hallway::csg
