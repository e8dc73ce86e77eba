// SPDX-License-Identifier: MIT
#include "sense/mouse_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/error.hpp"
#include "support/long_mode.hpp"
#include "test_motions.hpp"

namespace hallway::sense {
namespace {

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr double kStep_s = 0.01;

MouseOdometrySpec one_mouse() {
  return {.name = "mouse", .counts_per_m = 1e6};
}

MouseOdometrySpec two_mice() {
  MouseOdometrySpec spec = one_mouse();
  spec.places = {{.position_m = {0.05, 0.12}, .heading_rad = 0.3},
                 {.position_m = {-0.04, -0.1}, .heading_rad = -2.0}};
  return spec;
}

OdometryTrack<MouseState> track_of(const MouseOdometry& mice, const Trajectory& motion) {
  return {mice.start(), [&](MouseState& state, std::uint64_t k) {
            const auto end_ns = static_cast<std::int64_t>(k) * kStep_ns;
            mice.advance(state, motion, k, end_ns - kStep_ns, end_ns);
          }};
}

TEST(MouseOdometry, CountsTheMotionInItsOwnAxes) {
  const motions::Circle circle(0.5, 0.8);
  MouseOdometrySpec spec = one_mouse();
  spec.T_body_sensor = {motions::about_z(0.9), Vec3(0.2, 0.1, 0.0)};
  const MouseOdometry mouse(spec, 1);
  const std::vector<Vec2> ways = mouse.displacements(circle, 0, 2'000'000'000);
  // The velocity of the place is constant in the body: v + w × arm.
  const Vec3 in_body = 2.0 * Vec3(0.5 - 0.8 * 0.1, 0.8 * 0.2, 0.0);
  const Vec3 expected = spec.T_body_sensor.q.conjugate() * in_body;
  EXPECT_NEAR(ways[0].x(), expected.x(), 1e-12);
  EXPECT_NEAR(ways[0].y(), expected.y(), 1e-12);
  const MouseState state = track_of(mouse, circle).at(200);
  EXPECT_NEAR(static_cast<double>(state.counts[0][0]), 1e6 * expected.x(), 1.0);
  EXPECT_NEAR(static_cast<double>(state.counts[0][1]), 1e6 * expected.y(), 1.0);
}

TEST(MouseOdometry, OneMouseKnowsNoRotation) {
  const motions::Circle circle(0.5, 0.8);
  const MouseOdometry mouse(one_mouse(), 1);
  const MouseState state = track_of(mouse, circle).at(100);
  const OdometryReading reading = mouse.reading(state, kStep_s);
  EXPECT_EQ(reading.T_odom_sensor.q.coeffs(), Quat::Identity().coeffs());
  EXPECT_NEAR(reading.T_odom_sensor.t.x(), 0.5, 2e-6);
  EXPECT_NEAR(reading.linear_m_s.x(), 0.5, 2e-4);
  EXPECT_TRUE(std::isnan(reading.angular_rad_s.z()));
  EXPECT_EQ(reading.covariance[20], INFINITY);
  EXPECT_NEAR(reading.covariance[0], 1e-12 / 6.0, 1e-20);
}

TEST(MouseOdometry, TwoMiceFollowAMotion) {
  const motions::Circle circle(0.5, 0.8);
  MouseOdometrySpec spec = two_mice();
  spec.counts_per_m = 1e8;
  spec.T_body_sensor = {motions::about_z(0.4), Vec3(0.1, -0.2, 0.0)};
  const MouseOdometry mice(spec, 1);
  const auto track = track_of(mice, circle);
  for (const std::uint64_t k : {700u, 3u, 300u}) {
    const MouseState state = track.at(k);
    const auto end_ns = static_cast<std::int64_t>(k) * kStep_ns;
    const OdometryTruth truth = odometry_truth(circle, spec.T_body_sensor, 0, end_ns - kStep_ns, end_ns);
    EXPECT_LT((state.T_odom_sensor.t - truth.T_start_sensor.t).norm(), 1e-6) << k;
    EXPECT_LT(angle_between(state.T_odom_sensor.q, truth.T_start_sensor.q), 1e-6) << k;
    EXPECT_NEAR(mice.reading(state, kStep_s).angular_rad_s.z(), 0.8, 1e-4);
  }
}

TEST(MouseOdometry, ThreeMiceGiveTheLeastSquares) {
  MouseOdometrySpec spec = two_mice();
  spec.places.push_back({.position_m = {0.2, 0.01}, .heading_rad = 1.0});
  spec.scale_sigma = 0.05;
  spec.counts_per_m = 1e9;
  const MouseOdometry mice(spec, 8);
  const motions::Circle circle(0.5, 0.8);
  MouseState state = mice.start();
  mice.advance(state, circle, 1, 0, kStep_ns);
  // The normal equations, mouse by mouse.
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 way = Eigen::Rotation2Dd(spec.places[i].heading_rad) * state.way_m[i],
               at = spec.places[i].position_m;
    const Vec3 x_row(1.0, 0.0, -at.y()), y_row(0.0, 1.0, at.x());
    normal += x_row * x_row.transpose() + y_row * y_row.transpose();
    right += way.x() * x_row + way.y() * y_row;
  }
  EXPECT_LT((state.step.twist - Vec3(normal.inverse() * right)).norm(), 1e-7);
}

TEST(MouseOdometry, CovarianceIsThatOfTheErrors) {
  const int trials = test::sized(30'000, 1'000'000);
  for (const int errors : {0, 1, 2}) {
    MouseOdometrySpec spec = two_mice();
    spec.counts_per_m = 31496.06299;
    if (errors == 1) spec.scale_sigma = 0.01;  // at 0.03 what is not linear in the errors adds 2 %
    if (errors == 2) spec.noise = 1e-3;
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    double sum = 0.0, squares = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
      const MouseOdometry mice(spec, static_cast<std::uint64_t>(trial));
      const motions::Circle circle(0.5 + 0.2 * uniform(engine), 1.0 + uniform(engine));
      MouseState state = mice.start();
      for (Vec2& way : state.way_m) way = Vec2(uniform(engine), uniform(engine));
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t axis = 0; axis < 2; ++axis)
          state.counts[i].at(axis) = static_cast<std::int64_t>(
              std::floor(state.way_m[i][static_cast<int>(axis)] * spec.counts_per_m));
      mice.advance(state, circle, 7, 0, 5 * kStep_ns);
      const Pose truth = odometry_truth(circle, {}, 0, 0, 5 * kStep_ns).T_before_sensor,
                 seen = motion_of(state.step);
      const auto c = mice.reading(state, 5.0 * kStep_s).covariance;
      Mat3 covariance;
      covariance << c[0], c[1], c[5], c[1], c[6], c[10], c[5], c[10], c[20];
      const Vec3 error(truth.t.x() - seen.t.x(), truth.t.y() - seen.t.y(),
                       2.0 * std::atan2(truth.q.z(), truth.q.w()) - state.step.twist.z());
      const double nees = error.dot(covariance.inverse() * error);
      sum += nees;
      squares += nees * nees;
    }
    const double mean = sum / trials, error = std::sqrt((squares / trials - mean * mean) / trials);
    EXPECT_NEAR(mean, 3.0, 3.0 * error) << errors;
    RecordProperty("nees_" + std::to_string(errors), std::to_string(mean) + " +- " + std::to_string(error));
  }
}

TEST(MouseOdometry, EachMouseHasItsOwnScale) {
  MouseOdometrySpec spec = two_mice();
  spec.scale_sigma = 0.02;
  constexpr std::uint64_t kSeeds = 20'000;
  double sum = 0.0, squares = 0.0, products = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<double> errors = MouseOdometry(spec, seed).scale_errors();
    sum += errors[1] / 0.02;
    squares += errors[1] * errors[1] / 4e-4;
    products += errors[0] * errors[1] / 4e-4;
  }
  EXPECT_NEAR(sum / kSeeds, 0.0, 3.0 / std::sqrt(kSeeds));
  EXPECT_NEAR(squares / kSeeds, 1.0, 3.0 * std::sqrt(2.0 / kSeeds));
  EXPECT_NEAR(products / kSeeds, 0.0, 3.0 / std::sqrt(kSeeds));
}

TEST(MouseOdometry, NoiseGrowsWithTheRootOfTheWay) {
  MouseOdometrySpec spec = one_mouse();
  spec.noise = 2e-3;
  constexpr std::uint64_t kSeeds = 2000;
  double squares = 0.0;
  const motions::Circle circle(0.5, 1e-9);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const MouseOdometry mouse(spec, seed);
    squares += std::pow(track_of(mouse, circle).at(50).way_m[0].x() - 0.25, 2);
  }
  const double variance = spec.noise * spec.noise * 0.25;
  EXPECT_NEAR(squares / kSeeds, variance, 3.0 * variance * std::sqrt(2.0 / kSeeds));
}

TEST(MouseOdometry, CountsNothingWhereItIsLifted) {
  const motions::Circle circle(0.5, 0.8);
  const MouseOdometry mouse(one_mouse(), 1), mice(two_mice(), 1);
  MouseState state = mouse.start();
  mouse.advance(state, circle, 1, 0, kStep_ns);
  const MouseState before = state;
  mouse.advance(state, circle, 2, kStep_ns, 2 * kStep_ns, {true});
  EXPECT_EQ(state.counts, before.counts);
  EXPECT_EQ(state.T_odom_sensor.t, before.T_odom_sensor.t);
  OdometryReading reading = mouse.reading(state, kStep_s);
  EXPECT_TRUE(std::isnan(reading.linear_m_s.x()));
  EXPECT_EQ(reading.covariance[0], INFINITY);
  mouse.advance(state, circle, 3, 2 * kStep_ns, 3 * kStep_ns);
  EXPECT_NEAR(mouse.reading(state, kStep_s).linear_m_s.x(), 0.5, 2e-4)
      << "what it missed does not come later";

  MouseState both = mice.start();
  mice.advance(both, circle, 1, 0, kStep_ns, {false, true});
  reading = mice.reading(both, kStep_s);
  EXPECT_TRUE(std::isnan(reading.linear_m_s.x()) && std::isnan(reading.angular_rad_s.z()));
  EXPECT_EQ(reading.covariance[0], INFINITY);
  EXPECT_EQ(both.counts[1], (std::array<std::int64_t, 2>{}));
  EXPECT_NE(both.counts[0], (std::array<std::int64_t, 2>{}));
  EXPECT_THROW(mice.advance(both, circle, 2, 0, kStep_ns, {true}), Error);
}

TEST(MouseOdometry, TurnsThroughACorner) {
  MouseOdometrySpec spec = two_mice();
  const MouseOdometry mice(spec, 1);
  const std::vector<Vec2> ways = mice.displacements(motions::Corner(0.5), 999'000'000, 1'001'000'000);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec2 at = spec.places[i].position_m;
    const Vec2 expected =
        Eigen::Rotation2Dd(-spec.places[i].heading_rad) * Vec2(2e-3 - 0.5 * at.y(), 0.5 * at.x());
    EXPECT_LT((ways[i] - expected).norm(), 1e-12);
  }
}

TEST(MouseOdometry, IsTheSameInAnyOrder) {
  MouseOdometrySpec spec = two_mice();
  spec.noise = 1e-3;
  spec.scale_sigma = 0.01;
  const MouseOdometry mice(spec, 3);
  const motions::Waves waves;
  const auto forward = track_of(mice, waves), mixed = track_of(mice, waves);
  std::vector<MouseState> states;
  for (std::uint64_t k = 0; k < 600; ++k) states.push_back(forward.at(k));
  for (const std::uint64_t k : {599u, 3u, 300u, 255u, 256u, 257u, 0u, 598u}) {
    const MouseState state = mixed.at(k);
    EXPECT_EQ(state.counts, states[k].counts) << k;
    EXPECT_EQ(state.T_odom_sensor.t, states[k].T_odom_sensor.t) << k;
    EXPECT_EQ(state.T_odom_sensor.q.coeffs(), states[k].T_odom_sensor.q.coeffs()) << k;
  }
}

TEST(MouseOdometry, RefusesBadInput) {
  const auto refusal = [](const std::function<void(MouseOdometrySpec&)>& change) -> std::string {
    MouseOdometrySpec spec = two_mice();
    spec.name = "belly";
    change(spec);
    try {
      const MouseOdometry mice(spec, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find("belly") != std::string::npos && text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.places.clear(); }), "places");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.places.pop_back(); }), "places");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.places[0].position_m = s.places[1].position_m; }),
               "places");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.places[0].heading_rad = std::nan(""); }), "places");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.places[0].position_m.x() = INFINITY; }), "places");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.counts_per_m = 0.0; }), "counts_per_m");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.scale_sigma = 1.0; }), "scale_sigma");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.noise = -1.0; }), "noise");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.reach_m = 0.0; }), "reach_m");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.off_plane.height_m = INFINITY; }),
               "off_plane.height_m");
  EXPECT_PRED2(has, refusal([](MouseOdometrySpec& s) { s.T_body_sensor.q.coeffs().setZero(); }),
               "T_body_sensor");
}

}  // namespace
}  // namespace hallway::sense
