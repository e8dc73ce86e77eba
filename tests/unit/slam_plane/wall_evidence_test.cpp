// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "base/random.hpp"
#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

struct Seen {
  Pose2 pose;
  AssociatedObservation observation;
};

const Noise kNoise{0.02, 0.005, 0.005, 0.01};

/// Observations of parts of one wall from several places, noisy, some with corners.
std::vector<Seen> observations(std::uint64_t seed) {
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

/// The form by going through all observations again.
WallForm summed(const std::vector<Seen>& all, const WallBasis& basis) {
  WallForm form;
  for (const Seen& one : all) {
    const Vec2 middle = one.pose * one.observation.middle;
    const double turn = angle_between(basis.direction, one.pose.rotate(one.observation.direction));
    const double s = basis.along(middle), r = basis.across(middle);
    const double w = 1.0 / (kNoise.normal * kNoise.normal), v = 1.0 / (kNoise.angle * kNoise.angle);
    form.h(0, 0) += w * s * s + v;
    form.h(0, 1) += w * s;
    form.h(1, 0) += w * s;
    form.h(1, 1) += w;
    form.b[0] += w * s * r + v * turn;
    form.b[1] += w * r;
    const bool* corner = one.observation.corner;
    const double own = kNoise.end * kNoise.end, shared = kNoise.along * kNoise.along;
    Mat2 information = Mat2::Zero();
    if (corner[0] && corner[1]) {
      information = (Mat2() << own + shared, shared, shared, own + shared).finished().inverse();
    } else {
      for (int k = 0; k < 2; ++k) information(k, k) = corner[k] ? 1.0 / (own + shared) : 0.0;
    }
    const Vec2 places(basis.along(one.pose * one.observation.end[0]),
                      basis.along(one.pose * one.observation.end[1]));
    const Vec2 f = information * places;
    form.e += information;
    form.f += f;
  }
  return form;
}

void expect_same(const WallForm& a, const WallForm& b) {
  const double scale = 1e-9;
  EXPECT_NEAR(a.h(0, 0), b.h(0, 0), scale * b.h(0, 0));
  EXPECT_NEAR(a.h(0, 1), b.h(0, 1), scale * b.h(0, 0));
  EXPECT_NEAR(a.h(1, 1), b.h(1, 1), scale * b.h(1, 1));
  EXPECT_NEAR(a.b[0], b.b[0], scale * b.h(0, 0));
  EXPECT_NEAR(a.b[1], b.b[1], scale * b.h(0, 0));
  EXPECT_NEAR(a.e(0, 0), b.e(0, 0), scale * b.e(0, 0));
  EXPECT_NEAR(a.e(0, 1), b.e(0, 1), scale * b.e(0, 0));
  EXPECT_NEAR(a.e(1, 1), b.e(1, 1), scale * b.e(1, 1));
  EXPECT_NEAR(a.f[0], b.f[0], scale * 10.0 * b.e(0, 0));
  EXPECT_NEAR(a.f[1], b.f[1], scale * 10.0 * b.e(1, 1));
}

const WallBasis kBasis{Vec2(5.1, -0.4), Vec2(0.02, -1.0).normalized()};

TEST(WallEvidence, RunningSumsAreTheSumOverAllSightings) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Seen> all = observations(seed);
    WallEvidence evidence;
    for (const Seen& one : all) evidence.add(one.pose, one.observation, one.observation.corner, kNoise);
    expect_same(evidence.form(kBasis, kNoise), summed(all, kBasis));
  }
}

TEST(WallEvidence, EvidenceOfAnotherFrameAddsUp) {
  const std::vector<Seen> all = observations(7);
  const Pose2 T = Pose2::at({1.0, -2.0}, 0.7);  // from the second one's frame
  WallEvidence one, other;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < 15) {
      one.add(all[i].pose, all[i].observation, all[i].observation.corner, kNoise);
    } else {
      other.add(T.inverse() * all[i].pose, all[i].observation, all[i].observation.corner, kNoise);
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
    const AssociatedObservation s = seen(pose, {5, 2}, {5, -3}, true, true);
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
  const AssociatedObservation s = seen(Pose2{}, {5, 2}, {5, -3}, true, true);
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
