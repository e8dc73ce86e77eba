// SPDX-License-Identifier: MIT
// What is made of a path that is not in one piece, or not where the robot was.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "eval/evaluator.hpp"
#include "random_motion.hpp"

namespace hallway::eval {
namespace {

constexpr int kFrames = 1000;

/// Twice round a figure eight of some 60 m by 30 m.
Pose truth_at(int i) {
  const double angle = 4.0 * std::numbers::pi * i / kFrames;
  return {from_yaw_pitch_roll(angle, 0, 0), {30 * std::sin(angle), 15 * std::sin(2 * angle), 0}};
}

struct Answer {
  std::optional<Pose> pose;
  std::optional<std::uint64_t> map_epoch;
};

Metrics score(const std::function<Answer(int)>& answer, const std::vector<JoinedEpoch>& joined = {}) {
  Evaluator evaluator({});
  for (int i = 0; i < kFrames; ++i) {
    const Answer a = answer(i);
    Iteration iteration;
    iteration.T_world_body = truth_at(i);
    iteration.T_map_body = a.pose;
    iteration.map_epoch = a.map_epoch;
    iteration.t_s = 0.1 * i;
    evaluator.add(iteration);
  }
  return evaluator.metrics({}, std::nullopt, joined);
}

Pose noisy(int i) {
  const Random random(7, stream_id("test.noise"));
  return truth_at(i) * Pose{Quat::Identity(), random_point(random, static_cast<std::uint32_t>(i), 0.03)};
}

/// A map that starts anew at some frame: its poses are from there on relative to the one at that frame.
Pose restarted(int i, int at) {
  return i < at ? truth_at(0).inverse() * noisy(i) : truth_at(at).inverse() * noisy(i);
}

TEST(PathVerdict, AGoodPathIsOkWhereverItsMapLies) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Pose T_map_world = random_motion(seed);
    const Metrics metrics = score([&](int i) { return Answer{T_map_world * noisy(i), {}}; });
    EXPECT_EQ(metrics.verdict, PathVerdict::kOk);
    EXPECT_FALSE(metrics.diverged_at);
    EXPECT_EQ(metrics.pose_coverage(), 1.0);
    EXPECT_EQ(metrics.parts.count, 1u);
    EXPECT_EQ(metrics.parts.restarts, 0u);
  }
}

TEST(PathVerdict, TheIdentityForEverythingHasDiverged) {
  const Metrics metrics = score([](int) { return Answer{Pose(), {}}; });
  EXPECT_EQ(metrics.verdict, PathVerdict::kDiverged);
  EXPECT_GT(metrics.divergence->worst_m, metrics.divergence->limit_m);
}

/// Estimates of one path are judged by one limit, whatever share of it they have: that of the whole path.
TEST(PathVerdict, TheLimitIsOfTheWholeTruePath) {
  const double whole = score([](int i) { return Answer{noisy(i), {}}; }).divergence->limit_m;
  EXPECT_NEAR(whole, 0.05 * 2.0 * 30.0, 0.35);
  for (const int last : {10, 100, 700}) {
    const Metrics some = score([&](int i) { return i < last ? Answer{noisy(i), {}} : Answer{}; });
    EXPECT_EQ(some.divergence->limit_m, whole) << last;
    const Metrics parts = score([&](int i) { return Answer{restarted(i, last), i < last ? 1u : 2u}; });
    EXPECT_EQ(parts.divergence->limit_m, whole) << last;
  }
}

TEST(PathVerdict, NoPosesAreLost) {
  const Metrics metrics = score([](int) { return Answer{}; });
  EXPECT_EQ(metrics.verdict, PathVerdict::kLost);
  EXPECT_EQ(metrics.pose_coverage(), 0.0);
}

TEST(PathVerdict, PosesForLessThanHalfOfTheFramesAreLost) {
  EXPECT_EQ(score([](int i) {
              return Answer{i % 5 < 2 ? std::optional(noisy(i)) : std::nullopt, {}};
            }).verdict,
            PathVerdict::kLost);
  EXPECT_EQ(score([](int i) {
              return Answer{i % 5 < 3 ? std::optional(noisy(i)) : std::nullopt, {}};
            }).verdict,
            PathVerdict::kOk);
}

TEST(PathVerdict, ARobotThatIsLostAtTheEndIsLost) {
  EXPECT_EQ(score([](int i) {
              return Answer{i < 900 ? std::optional(noisy(i)) : std::nullopt, {}};
            }).verdict,
            PathVerdict::kLost);
  EXPECT_EQ(score([](int i) {
              return Answer{i < 950 ? std::optional(noisy(i)) : std::nullopt, {}};
            }).verdict,
            PathVerdict::kOk);
}

TEST(PathVerdict, ARestartThatIsNotToldHasDiverged) {
  for (const int at : {100, 130, 620, 900, 980}) {
    const Metrics metrics = score([&](int i) { return Answer{restarted(i, at), {}}; });
    EXPECT_EQ(metrics.verdict, PathVerdict::kDiverged) << at;
  }
}

TEST(PathVerdict, ARestartThatIsToldIsNeverOk) {
  for (const int at : {100, 500, 900, 980, 997, 999}) {
    const Metrics metrics = score([&](int i) { return Answer{restarted(i, at), i < at ? 0u : 1u}; });
    EXPECT_EQ(metrics.verdict, PathVerdict::kLost) << at;
    EXPECT_EQ(metrics.parts.count, 2u);
    EXPECT_EQ(metrics.parts.restarts, 1u);
    EXPECT_EQ(metrics.parts.scored_iterations, static_cast<std::uint64_t>(std::max(at, kFrames - at)));
    EXPECT_EQ(metrics.pose_coverage(), std::max(at, kFrames - at) / 1000.0) << "of all frames";
    EXPECT_LT(*metrics.position_rmse_m.aligned, 0.06) << "parts are not scored as one";
  }
}

TEST(PathVerdict, ARestartWithinTheFirstFramesCostsLittle) {
  const Metrics metrics = score([](int i) { return Answer{restarted(i, 12), i < 12 ? 0u : 1u}; });
  EXPECT_EQ(metrics.verdict, PathVerdict::kOk);
  EXPECT_EQ(metrics.parts.restarts, 1u);
  EXPECT_EQ(metrics.pose_coverage(), 0.988);
}

TEST(PathVerdict, ARestartBeforeEveryFrameIsLost) {
  const Metrics metrics = score([](int i) { return Answer{Pose(), static_cast<std::uint64_t>(i)}; });
  EXPECT_EQ(metrics.verdict, PathVerdict::kLost);
  EXPECT_EQ(metrics.parts.count, 1000u);
  EXPECT_EQ(metrics.parts.scored_iterations, 1u);
}

TEST(PathVerdict, PartsThatAreJoinedAreOne) {
  const auto answer = [](int i) {
    return Answer{truth_at(0).inverse() * noisy(i), i < 400 ? 0u : i < 700 ? 3u : 5u};
  };
  const Metrics metrics = score(answer, {{3, 0}, {5, 0}});
  EXPECT_EQ(metrics.verdict, PathVerdict::kOk);
  EXPECT_EQ(metrics.parts.count, 1u);
  EXPECT_EQ(metrics.parts.restarts, 2u);
  EXPECT_EQ(metrics.pose_coverage(), 1.0);
  EXPECT_EQ(score(answer, {{5, 0}}).parts.scored_iterations, 700u);
}

TEST(PathVerdict, AMapThatWasForgottenIsLostEvenWhereThePosesFit) {
  Evaluator evaluator({.has_identities = true, .landmarks = std::nullopt});
  for (int i = 0; i < kFrames; ++i) {
    Iteration iteration;
    iteration.T_world_body = truth_at(i);
    iteration.T_map_body = noisy(i);
    const std::vector<log::LandmarkId> seen{static_cast<log::LandmarkId>(i / 10)};
    const std::vector<log::LandmarkId> given{seen[0] + (i < 990 ? 0u : 500u)};
    iteration.associations = given;
    iteration.identities = seen;
    evaluator.add(iteration);
  }
  const std::vector<log::MapLandmark> rest{{.id = 599, .position_m = {}, .observations = 10}};
  const Metrics metrics = evaluator.metrics(rest, std::nullopt);
  EXPECT_EQ(metrics.associations_dropped, 990u);
  EXPECT_EQ(metrics.verdict, PathVerdict::kLost);
  EXPECT_EQ(metrics.landmark_coverage(), 0.01);
}

TEST(PathVerdict, FramesWithoutANumberGoWithTheOneBefore) {
  const Metrics metrics = score([](int i) {
    return Answer{restarted(i, 600), i == 600 ? std::optional<std::uint64_t>(4) : std::nullopt};
  });
  EXPECT_EQ(metrics.parts.count, 2u);
  EXPECT_EQ(metrics.parts.scored_iterations, 600u);
}

TEST(PathVerdict, AnOrientationFarOffHasDiverged) {
  const Metrics metrics = score([](int i) {
    Pose pose = noisy(i);
    if (i > 800) pose.q = pose.q * from_yaw_pitch_roll(0.9, 0, 0);
    return Answer{pose, {}};
  });
  EXPECT_EQ(metrics.verdict, PathVerdict::kDiverged);
  EXPECT_EQ(metrics.diverged_at, 801u);
}

PathVerdict shaken(double shake_m, double noise_m) {
  Truth truth;
  truth.noise_m = noise_m;
  Evaluator evaluator(truth);
  for (int i = 0; i < 100; ++i) {
    const Random random(3, stream_id("test.shake"));
    Iteration iteration;
    iteration.T_world_body = Pose();
    iteration.T_map_body =
        Pose{Quat::Identity(), random_point(random, static_cast<std::uint32_t>(i), shake_m)};
    evaluator.add(iteration);
  }
  return evaluator.metrics({}, std::nullopt).verdict.value();
}

TEST(PathVerdict, ARobotAtRestMayShake) {
  EXPECT_EQ(shaken(0.02, 0.0), PathVerdict::kOk);
  EXPECT_EQ(shaken(0.15, 0.05), PathVerdict::kOk) << "by so much as noise explains";
  EXPECT_EQ(shaken(0.15, 0.0), PathVerdict::kDiverged);
}

TEST(PathVerdict, WithoutTruthNothingIsOk) {
  Evaluator evaluator({});
  for (int i = 0; i < 100; ++i) {
    Iteration iteration;
    iteration.T_map_body = noisy(i);
    evaluator.add(iteration);
  }
  EXPECT_FALSE(evaluator.metrics({}, std::nullopt).verdict);
}

}  // namespace
}  // namespace hallway::eval
