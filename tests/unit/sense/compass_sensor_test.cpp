// SPDX-License-Identifier: MIT
#include "sense/compass_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "sense/standing_body.hpp"
#include "support/errors.hpp"
#include "unit/sense/moving_sensor.hpp"

namespace hallway::sense {
namespace {

constexpr double kPi = std::numbers::pi;

CompassSpec plain_compass() {
  CompassSpec spec;
  spec.name = "compass";
  return spec;
}

struct Sight {
  CompassReading reading;
  CompassTruth truth;
};

Sight sight_of(const CompassSpec& spec, const Pose& pose, std::uint32_t number = 0) {
  Sight made;
  CompassSensor(spec, 1).read(number, 0, sense::StandingBody(pose), made.reading, made.truth);
  return made;
}

TEST(CompassSensor, HeadingIsFromNorthToTheLeft) {
  for (const double north : {0.0, 1.0, -2.5, 7.0}) {
    for (const double yaw : {0.0, 0.5, 3.0, -3.0, kPi}) {
      CompassSpec spec = plain_compass();
      spec.north_rad = north;
      spec.T_body_sensor.q = from_yaw_pitch_roll(0.25, 0.0, 0.0);
      // Pitch and roll about the heading do not matter.
      const Sight sight = sight_of(spec, {from_yaw_pitch_roll(yaw, 0.0, 0.0), Vec3(3, 4, 5)});
      const double expected = yaw + 0.25 - north;
      EXPECT_NEAR(std::remainder(sight.reading.heading_rad - expected, 2.0 * kPi), 0.0, 1e-12);
      EXPECT_LE(sight.reading.heading_rad, kPi);
      EXPECT_GT(sight.reading.heading_rad, -kPi);
    }
  }
}

TEST(CompassSensor, AnUprightAxisHasNoHeading) {
  const Sight sight = sight_of(plain_compass(), {from_yaw_pitch_roll(0.3, 0.5 * kPi, 0.0), Vec3::Zero()});
  EXPECT_TRUE(std::isnan(sight.reading.heading_rad));
  EXPECT_TRUE(std::isnan(sight.truth.heading_rad));
}

TEST(CompassSensor, AMagnetTurnsItWithinItsReach) {
  CompassSpec spec = plain_compass();
  spec.magnets = {{.position = {0, 0, 0}, .reach_m = 2.0, .strength = 0.5}};
  const auto deviation = [&](const Vec3& at) {
    const Sight sight = sight_of(spec, {Quat::Identity(), at});
    EXPECT_NEAR(std::remainder(sight.reading.heading_rad + sight.truth.deviation_rad, 2.0 * kPi), 0.0, 1e-12);
    return sight.truth.deviation_rad;
  };
  // One metre to the left of it: half of the reach, so 0.5 * 0.75^2 to the left of north.
  EXPECT_NEAR(deviation({0, 1, 0}), std::atan(0.5 * 0.75 * 0.75), 1e-12);
  EXPECT_NEAR(deviation({0, -1, 0}), -std::atan(0.5 * 0.75 * 0.75), 1e-12);
  EXPECT_EQ(deviation({1, 0, 0}), 0.0);  // along north
  EXPECT_EQ(deviation({0, 2.0, 0}), 0.0);
  EXPECT_EQ(deviation({0, 0, 1}), 0.0);  // straight above
  spec.magnets[0].strength = -2.0;       // pulls, and turns it round on its northern side
  EXPECT_NEAR(std::abs(deviation({0.2, 0, 0})), kPi, 1e-12);
  spec.magnets.push_back(spec.magnets[0]);
  spec.magnets[1].strength = 2.0;  // the two cancel
  EXPECT_EQ(deviation({0, 1, 0}), 0.0);
}

TEST(CompassSensor, NoiseIsAsDeclaredAndTheBiasIsTheSensors) {
  CompassSpec spec = plain_compass();
  spec.noise_rad = 0.02;
  spec.bias_sigma_rad = 0.05;
  const CompassSensor sensor(spec, 9);
  constexpr std::uint32_t kReadings = 1'000'000;
  double sum = 0.0, squares = 0.0;
  Sight made;
  for (std::uint32_t k = 0; k < kReadings; ++k) {
    sensor.read(k, 0, sense::StandingBody(Pose()), made.reading, made.truth);
    const double error = made.reading.heading_rad - made.truth.bias_rad;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 3.0 * 0.02 / 1000.0);
  EXPECT_NEAR(squares / kReadings, 0.0004, 3.0 * 0.0004 * std::sqrt(2.0 / kReadings));
  EXPECT_DOUBLE_EQ(made.reading.variance_rad2, 0.02 * 0.02 + 0.05 * 0.05);
  double biases = 0.0;
  constexpr std::uint64_t kSeeds = 20'000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    CompassSensor(spec, seed).read(0, 0, sense::StandingBody(Pose()), made.reading, made.truth);
    biases += made.truth.bias_rad * made.truth.bias_rad;
  }
  EXPECT_NEAR(biases / kSeeds, 0.0025, 3.0 * 0.0025 * std::sqrt(2.0 / kSeeds));
}

TEST(CompassSensor, WhatIsOutOfRangeIsRefusedByItsName) {
  const auto refusal = [&](const std::function<void(CompassSpec&)>& change) {
    CompassSpec spec = plain_compass();
    change(spec);
    const std::optional<Error> error = test::error_of([&] { CompassSensor(spec, 1); });
    return error ? error->message().substr(0, error->message().find(' ')) : std::string("accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](CompassSpec&) {}), "accepted");
  EXPECT_EQ(refusal([&](CompassSpec& s) { s.north_rad = nan; }), "north_rad");
  EXPECT_EQ(refusal([](CompassSpec& s) { s.noise_rad = -1.0; }), "noise_rad");
  EXPECT_EQ(refusal([&](CompassSpec& s) { s.bias_sigma_rad = nan; }), "bias_sigma_rad");
  EXPECT_EQ(refusal([](CompassSpec& s) { s.magnets = {{.reach_m = 0.0}}; }), "magnets.reach_m");
  EXPECT_EQ(refusal([&](CompassSpec& s) { s.magnets = {{.strength = nan}}; }), "magnets.strength");
}

}  // namespace
}  // namespace hallway::sense
