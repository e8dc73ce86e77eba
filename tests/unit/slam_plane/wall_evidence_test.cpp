// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "base/random.hpp"
#include "unit/slam_plane/pieces.hpp"

namespace hallway::slam_plane::test {
namespace {

struct Seen {
  Pose2 pose;
  Sighting sighting;
};

const Noise kNoise{0.02, 0.005, 0.005, 0.01};

/// Sightings of parts of one wall from several places, noisy, some with corners.
std::vector<Seen> sightings(std::uint64_t seed) {
  const Random random(seed, stream_id("wall_evidence_test"));
  std::vector<Seen> all;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Pose2 pose =
        Pose2::at({random.uniform(i, 0, -1, 1), random.uniform(i, 1, -1, 1)}, random.uniform(i, 2, -1, 1));
    const bool a = random.uniform(i, 3) < 0.5, b = random.uniform(i, 4) < 0.5;
    const Vec2 from(5.0 + 0.02 * random.normal(i, 5), a ? 2.0 + 0.01 * random.normal(i, 6) : 1.0);
    const Vec2 to(5.0 + 0.02 * random.normal(i, 7), b ? -3.0 + 0.01 * random.normal(i, 8) : -1.0);
    all.push_back({pose, seen(pose, from, to, a, b)});
  }
  return all;
}

/// The form by going through all sightings again.
WallForm summed(const std::vector<Seen>& all, const WallBasis& basis) {
  WallForm form;
  for (const Seen& one : all) {
    const Vec2 middle = one.pose * one.sighting.middle;
    const double turn = angle_between(basis.direction, one.pose.rotate(one.sighting.direction));
    const double s = basis.along(middle), r = basis.across(middle);
    const double w = 1.0 / (kNoise.normal * kNoise.normal), v = 1.0 / (kNoise.angle * kNoise.angle);
    form.h_tt += w * s * s + v;
    form.h_to += w * s;
    form.h_oo += w;
    form.b_t += w * s * r + v * turn;
    form.b_o += w * r;
    const bool* corner = one.sighting.corner;
    const double own = kNoise.end * kNoise.end, shared = kNoise.along * kNoise.along;
    Mat2 information = Mat2::Zero();
    if (corner[0] && corner[1]) {
      information = (Mat2() << own + shared, shared, shared, own + shared).finished().inverse();
    } else {
      for (int k = 0; k < 2; ++k) information(k, k) = corner[k] ? 1.0 / (own + shared) : 0.0;
    }
    const Vec2 places(basis.along(one.pose * one.sighting.end[0]),
                      basis.along(one.pose * one.sighting.end[1]));
    const Vec2 f = information * places;
    form.e_aa += information(0, 0);
    form.e_ab += information(0, 1);
    form.e_bb += information(1, 1);
    form.f_a += f.x();
    form.f_b += f.y();
  }
  return form;
}

void expect_same(const WallForm& a, const WallForm& b) {
  const double scale = 1e-9;
  EXPECT_NEAR(a.h_tt, b.h_tt, scale * b.h_tt);
  EXPECT_NEAR(a.h_to, b.h_to, scale * b.h_tt);
  EXPECT_NEAR(a.h_oo, b.h_oo, scale * b.h_oo);
  EXPECT_NEAR(a.b_t, b.b_t, scale * b.h_tt);
  EXPECT_NEAR(a.b_o, b.b_o, scale * b.h_tt);
  EXPECT_NEAR(a.e_aa, b.e_aa, scale * b.e_aa);
  EXPECT_NEAR(a.e_ab, b.e_ab, scale * b.e_aa);
  EXPECT_NEAR(a.e_bb, b.e_bb, scale * b.e_bb);
  EXPECT_NEAR(a.f_a, b.f_a, scale * 10.0 * b.e_aa);
  EXPECT_NEAR(a.f_b, b.f_b, scale * 10.0 * b.e_bb);
}

const WallBasis kBasis{Vec2(5.1, -0.4), Vec2(0.02, -1.0).normalized()};

TEST(WallEvidence, RunningSumsAreTheSumOverAllSightings) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Seen> all = sightings(seed);
    WallEvidence evidence;
    for (const Seen& one : all) evidence.add(one.pose, one.sighting, one.sighting.corner, kNoise);
    expect_same(evidence.form(kBasis, kNoise), summed(all, kBasis));
  }
}

TEST(WallEvidence, EvidenceOfAnotherFrameAddsUp) {
  const std::vector<Seen> all = sightings(7);
  const Pose2 T = Pose2::at({1.0, -2.0}, 0.7);  // from the second one's frame
  WallEvidence one, other;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < 15) {
      one.add(all[i].pose, all[i].sighting, all[i].sighting.corner, kNoise);
    } else {
      other.add(T.inverse() * all[i].pose, all[i].sighting, all[i].sighting.corner, kNoise);
    }
  }
  one.add(T, other);
  expect_same(one.form(kBasis, kNoise), summed(all, kBasis));
  EXPECT_EQ(one.count(), all.size());
}

TEST(WallEvidence, SolvedLineAndEndsAreThoseOfTheWall) {
  WallEvidence evidence;
  for (int i = 0; i < 5; ++i) {
    const Pose2 pose = Pose2::at({0.1 * i, 0.2 * i}, 0.1 * i);
    const Sighting s = seen(pose, {5, 2}, {5, -3}, true, true);
    evidence.add(pose, s, s.corner, kNoise);
  }
  WallEstimate estimate;
  ASSERT_TRUE(solve(evidence.form(kBasis, kNoise), kBasis, {true, true}, estimate));
  EXPECT_NEAR(estimate.basis.across({5, 0}), 0.0, 1e-3);  // linear in the basis's error
  ASSERT_TRUE(solve(evidence.form(estimate.basis, kNoise), estimate.basis, {true, true}, estimate));
  EXPECT_NEAR(estimate.basis.across({5, 0}), 0.0, 1e-6);
  EXPECT_NEAR((estimate.basis.point(estimate.end[kEndA]) - Vec2(5, 2)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((estimate.basis.point(estimate.end[kEndB]) - Vec2(5, -3)).norm(), 0.0, 1e-6);
}

TEST(WallEvidence, ForgottenEndLeavesTheOtherOne) {
  WallEvidence evidence;
  const Sighting s = seen(Pose2{}, {5, 2}, {5, -3}, true, true);
  for (int i = 0; i < 5; ++i) evidence.add(Pose2{}, s, s.corner, kNoise);
  evidence.forget_end(kEndA);
  WallEstimate estimate;
  ASSERT_TRUE(solve(evidence.form(evidence.basis(), kNoise), evidence.basis(), {true, true}, estimate));
  EXPECT_FALSE(estimate.known[kEndA]);
  ASSERT_TRUE(estimate.known[kEndB]);
  EXPECT_NEAR((estimate.basis.point(estimate.end[kEndB]) - Vec2(5, -3)).norm(), 0.0, 1e-9);
  // What one end tells by itself: its own noise and the shared one, five times.
  EXPECT_NEAR(estimate.variance[kEndB], (0.005 * 0.005 + 0.01 * 0.01) / 5.0, 1e-12);
}

}  // namespace
}  // namespace hallway::slam_plane::test
