// SPDX-License-Identifier: MIT
#include "sense/sonar_sensor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "sense/standing_body.hpp"
#include "support/errors.hpp"
#include "unit/sense/moving_sensor.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::sense {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Walls {
  explicit Walls(const trace::TriangleMesh& mesh, double echo_angle_rad = 90.0 * kDegree)
      : scene(mesh, trace::Backend::kEmbree),
        surfaces(mesh, {SurfaceMaterial{.name = "wall", .echo_angle_rad = echo_angle_rad}}) {}
  trace::Scene scene;
  Surfaces surfaces;
};

/// One ping straight ahead, a cone of 30 degrees.
SonarSpec plain_sonar() {
  SonarSpec spec;
  spec.name = "sonar";
  spec.pings = {{PatternRay{}}, 0, 0};
  return spec;
}

struct Sweep {
  SonarReading reading;
  SonarTruth truth;
};

Sweep sweep_of(const SonarSensor& sensor, const Trajectory& trajectory, std::uint32_t sweep = 0,
               std::int64_t t_ns = 0, unsigned threads = 1) {
  Sweep made;
  sensor.read(sweep, t_ns, trajectory, threads, made.reading, made.truth);
  return made;
}

Sweep look(const SonarSpec& spec, const Walls& place, const Pose& from = Pose()) {
  return sweep_of(SonarSensor(spec, place.scene, place.surfaces, 1), sense::StandingBody(from));
}

/// A slab whose near face is a wall at a distance from the origin, its normal turned from the x axis.
trace::TriangleMesh wall(double distance_m, double turned_rad) {
  const Pose pose{Quat(Eigen::AngleAxisd(turned_rad, Vec3::UnitZ())), Vec3::Zero()};
  return test::mesh_of(
      {test::prism(4, std::sqrt(2.0) * 50.0, 100.0,
                   pose * Pose{Quat(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ())),
                               Vec3(distance_m + 50.0, 0, 0)})});
}

/// The range of a plane whose normal is `off` from the beam's middle, and by how much rays at the resolution may be too long.
double range_to_plane(double distance_m, double off_rad, double half_rad) {
  return distance_m / std::cos(std::max(0.0, off_rad - half_rad));
}

TEST(SonarSensor, MeasuresAWallAtEverySlant) {
  for (const double off : {0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0}) {
    const Walls place(wall(2.0, off * kDegree));
    SonarSpec spec = plain_sonar();
    spec.max_range_m = 20.0;
    const double range = look(spec, place).reading.range_m.at(0);
    const double exact = range_to_plane(2.0, off * kDegree, 15.0 * kDegree);
    const double nearest_ray = std::max(0.0, off - 15.0) * kDegree + 0.71 * spec.beam.resolution_rad;
    EXPECT_GE(range, exact - 1e-6) << off;
    EXPECT_LE(range, 2.0 / std::cos(nearest_ray)) << off;
  }
}

TEST(SonarSensor, ASpecularWallIsHeardUpToItsAngleOfEcho) {
  for (const double off : {0.0, 10.0, 30.0, 44.0, 46.0, 60.0, 80.0}) {
    const Walls place(wall(2.0, off * kDegree), 30.0 * kDegree);
    const double range = look(plain_sonar(), place).reading.range_m.at(0);
    // The ray of the beam that meets the wall least slanted is 15 degrees from the middle.
    if (off < 45.0)
      EXPECT_NEAR(range, range_to_plane(2.0, off * kDegree, 15.0 * kDegree), 0.02) << off;
    else
      EXPECT_EQ(range, kNothing_m) << off;
  }
}

TEST(SonarSensor, APerfectMirrorIsHeardWhereTheBeamMeetsItUpright) {
  for (const double off : {0.0, 3.3, 7.77, 12.4, 14.9, 15.8, 17.0, 30.0}) {
    const Walls place(wall(2.0, off * kDegree), 0.0);
    const double range = look(plain_sonar(), place).reading.range_m.at(0);
    if (off < 15.0) {
      EXPECT_NEAR(range, 2.0, 2.0 * std::pow(0.75 * kDegree, 2)) << off;
    } else {  // beyond three quarters of the resolution
      EXPECT_EQ(range, kNothing_m) << off;
    }
  }
}

TEST(SonarSensor, HearsTheNearerWallOfACorner) {
  trace::TriangleMesh mesh =
      test::mesh_of({test::box({3.0, -5, -5}, {4.0, 5, 5}), test::box({-5, 0.6, -5}, {5, 1.6, 5})});
  const Walls place(mesh);
  // The wall ahead at 3 m; the one beside, 0.6 m to the left, enters the beam at 15 degrees.
  EXPECT_NEAR(look(plain_sonar(), place).reading.range_m.at(0), 0.6 / std::sin(15.0 * kDegree), 1e-6);
  const Pose nearer{Quat::Identity(), Vec3(1.5, 0, 0)};
  EXPECT_NEAR(look(plain_sonar(), place, nearer).reading.range_m.at(0), 1.5, 1e-6);
}

TEST(SonarSensor, HearsACylinder) {
  const double radius = 0.2;
  trace::TriangleMesh mesh =
      test::mesh_of({test::prism(720, radius, 4.0, Pose{Quat::Identity(), Vec3(1.5, 0.1, 0)})});
  const double range = look(plain_sonar(), Walls(mesh)).reading.range_m.at(0);
  const double exact = std::hypot(1.5, 0.1) - radius;
  EXPECT_GE(range, exact - 1e-6);
  EXPECT_LE(range, exact + 1.5 * std::pow(0.71 * kDegree, 2) * 1.5 / radius + 1e-5);
}

TEST(SonarSensor, AGapNarrowerThanTheBeamIsNotSeenThrough) {
  // The gap is wider than the rays are apart; a laser through its middle would meet the wall behind.
  trace::TriangleMesh mesh =
      test::mesh_of({test::box({2, 0.25, -5}, {2.1, 5, 5}), test::box({2, -5, -5}, {2.1, -0.25, 5}),
                     test::box({6, -9, -9}, {7, 9, 9})});
  const double edge = std::atan(0.25 / 2.0);
  const double range = look(plain_sonar(), Walls(mesh)).reading.range_m.at(0);
  EXPECT_GE(range, 2.0 / std::cos(edge) - 1e-6);
  EXPECT_LE(range, 2.0 / std::cos(edge + kDegree));
  SonarSpec narrow = plain_sonar();
  narrow.beam.cone_rad = 2.0 * kDegree;
  EXPECT_NEAR(look(narrow, Walls(mesh)).reading.range_m.at(0), 6.0, 1e-6);
}

TEST(SonarSensor, TwoWallsAreTwoEchoes) {
  trace::TriangleMesh mesh =
      test::mesh_of({test::box({2, 0.1, -5}, {2.1, 5, 5}), test::box({5, -9, -9}, {6, 9, 9})});
  const Walls place(mesh);
  SonarSpec spec = plain_sonar();
  spec.echoes = 3;
  spec.apart_m = 1.0;
  const std::vector<double> ranges = look(spec, place).reading.range_m;
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_NEAR(ranges[0], 2.0 / std::cos(std::atan(0.05)), 2e-3);
  EXPECT_NEAR(ranges[1], 5.0, 1e-6);
  EXPECT_TRUE(std::isnan(ranges[2]));
  spec.echoes = 1;
  EXPECT_EQ(look(spec, place).reading.range_m.size(), 1u);
  // What is nearer than the ringing hides, and the wall behind is heard.
  spec.min_range_m = 3.0;
  EXPECT_NEAR(look(spec, place).reading.range_m.at(0), 5.0, 1e-6);
  // The truth knows it all the same.
  EXPECT_LT(look(spec, place).truth.range_m.at(0), 2.1);
}

TEST(SonarSensor, NothingInRangeIsFree) {
  const Walls place(wall(12.0, 0.0));
  const Sweep sweep = look(plain_sonar(), place);
  EXPECT_EQ(sweep.reading.range_m.at(0), kNothing_m);
  EXPECT_EQ(sweep.truth.what.at(0), SonarTruth::kNothing);
}

TEST(SonarSensor, APolygonHearsOnlyWhatIsWithinIt) {
  SonarSpec spec = plain_sonar();
  spec.beam.polygon = {{1, 0}, {3, -1}, {5, 0}, {3, 1}};
  EXPECT_EQ(look(spec, Walls(wall(0.5, 0.0))).reading.range_m.at(0),
            kNothing_m);  // in front of it, and in its way
  EXPECT_NEAR(look(spec, Walls(wall(4.0, 0.0))).reading.range_m.at(0), 4.0, 1e-3);
  EXPECT_EQ(look(spec, Walls(wall(5.5, 0.0))).reading.range_m.at(0), kNothing_m);
  // Flat: it passes above what is low.
  EXPECT_EQ(look(spec, Walls(test::mesh_of({test::box({4, -1, -1}, {4.5, 1, -0.01})}))).reading.range_m.at(0),
            kNothing_m);
  spec.beam.height_rad = 10.0 * kDegree;
  EXPECT_NEAR(
      look(spec, Walls(test::mesh_of({test::box({4, -1, -1}, {4.5, 1, -0.01})}))).reading.range_m.at(0), 4.0,
      0.01);
}

/// A head that turns while the robot circles: each ping from where the robot is then, by the rays that the beam is made of, in long double.
TEST(SonarSensor, ASweepIsSkewed) {
  const Walls place(test::mesh_of({test::box({-4, -3, -1}, {4, 3, 2})}));
  SonarSpec spec = plain_sonar();
  spec.pings = spinning_pattern({.step_rad = 7.5 * kDegree, .columns = 48, .elevations_rad = {0.0}});
  spec.T_body_sensor = {from_yaw_pitch_roll(0.4, 0.05, -0.1), {0.1, -0.2, 0.3}};
  spec.head_radius_m = 0.05;
  spec.sweep_ns = 1'200'000'000;
  const SonarSensor sensor(spec, place.scene, place.surfaces, 1);
  const test::CirclingBody body({0.2, 0.1, 0.0}, 1.0, 0.8, 0.1);
  constexpr std::int64_t kBegin_ns = 700'000'123;
  const Sweep sweep = sweep_of(sensor, body, 2, kBegin_ns);
  double most_skew_m = 0.0;
  for (std::size_t i = 0; i < spec.pings.rays.size(); ++i) {
    const auto range_at = [&](std::int64_t t_ns) {
      const Pose head =
          body.pose_at(t_ns) * spec.T_body_sensor *
          Pose{Quat(Eigen::AngleAxisd(spec.pings.rays[i].azimuth_rad, Vec3::UnitZ())), Vec3::Zero()} *
          Pose{Quat::Identity(), Vec3(0.05, 0, 0)};
      long double nearest = 1e30L;
      for (const EchoRay& ray : sensor.beam()) {
        const Vec3 along = head.q * ray.direction;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const long double slope = along(axis);
          if (slope == 0.0L) continue;
          const long double wall_at = slope > 0.0L ? Vec3(4, 3, 2)(axis) : Vec3(-4, -3, -1)(axis);
          nearest = std::min(nearest, (wall_at - static_cast<long double>(head.t(axis))) / slope);
        }
      }
      return static_cast<double>(nearest);
    };
    EXPECT_NEAR(sweep.reading.range_m[i], range_at(kBegin_ns + sensor.offsets_ns()[i]), 1e-6) << i;
    most_skew_m = std::max(most_skew_m, std::abs(sweep.reading.range_m[i] - range_at(kBegin_ns)));
  }
  EXPECT_GT(most_skew_m, 0.3);
  EXPECT_EQ(sweep.reading.t_end_ns, kBegin_ns + sensor.offsets_ns().back());
}

/// Two heads that look ahead side by side, and a post in both beams, nearer to the second one's.
TEST(SonarSensor, HeadsThatPingAtOneMomentHearEachOther) {
  const Walls place(test::mesh_of({test::prism(720, 0.05, 4.0, Pose{Quat::Identity(), Vec3(1.0, 0.3, 0)})}));
  SonarSpec spec = plain_sonar();
  spec.beam.cone_rad = 100.0 * kDegree;
  spec.head_radius_m = 0.5;
  const std::array<double, 2> azimuths{-10.0 * kDegree, 10.0 * kDegree};
  spec.pings = {{PatternRay{.azimuth_rad = azimuths[0]}, PatternRay{.azimuth_rad = azimuths[1]}}, 0, 0};
  const Sweep alone = look(spec, place);
  spec.crosstalk = true;
  const Sweep both = look(spec, place);
  const auto head = [&](std::size_t i) {
    return Vec3(0.5 * std::cos(azimuths.at(i)), 0.5 * std::sin(azimuths.at(i)), 0.0);
  };
  const Vec3 point = head(1) + alone.reading.range_m[1] * alone.truth.direction[1];
  const double way_m = alone.reading.range_m[1] + (point - head(0)).norm();
  EXPECT_LT(0.5 * way_m, alone.reading.range_m[0] - 0.02) << "or nothing is shown";
  EXPECT_NEAR(both.reading.range_m[0], 0.5 * way_m, 1e-9);
  EXPECT_EQ(both.reading.range_m[1], alone.reading.range_m[1]) << "the other way round its own is nearer";
  // At other moments neither hears the other's.
  spec.pings.rays[0].share = 0.5;
  spec.sweep_ns = 1'000'000;
  EXPECT_EQ(look(spec, place).reading.range_m, alone.reading.range_m);
}

TEST(SonarSensor, AHeadHearsNoOtherThroughAWallOrBesideItsBeam) {
  SonarSpec spec = plain_sonar();
  spec.beam.cone_rad = 20.0 * kDegree;
  spec.head_radius_m = 0.5;
  spec.pings = {
      {PatternRay{.azimuth_rad = -15.0 * kDegree}, PatternRay{.azimuth_rad = 15.0 * kDegree}}, 0, 0};
  const trace::TriangleMesh far = test::mesh_of({test::box({4, -9, -9}, {5, 9, 9})});
  const trace::TriangleMesh step =
      test::mesh_of({test::box({2, 0.6, -5}, {2.5, 5, 5}), test::box({4, -9, -9}, {5, 9, 9})});
  const double alone = look(spec, Walls(far)).reading.range_m[0];
  spec.crosstalk = true;
  EXPECT_LT(look(spec, Walls(step)).reading.range_m[1], 2.0);
  EXPECT_EQ(look(spec, Walls(step)).reading.range_m[0], alone) << "the step is beside its beam";
  // A sheet between the heads, along the middle: what the second meets is in the first's beam, and behind the sheet.
  spec.beam.cone_rad = 80.0 * kDegree;
  const trace::TriangleMesh parted =
      test::mesh_of({test::box({2, 0.3, -5}, {2.5, 5, 5}), test::box({0.0, -0.01, -9}, {9, 0.01, 9})});
  const double to_sheet = look(spec, Walls(parted)).reading.range_m[0];
  spec.crosstalk = false;
  EXPECT_EQ(look(spec, Walls(parted)).reading.range_m[0], to_sheet);
}

/// Of a thousand heads in a thousand sweeps, each a narrow beam straight at a wall.
class SonarStatistics : public testing::Test {
 protected:
  static constexpr double kWall_m = 4.0;
  static constexpr std::uint32_t kHeads = 1000, kSweeps = 1000;
  static constexpr double kPings = double{kHeads} * kSweeps;

  SonarStatistics() : place_(wall(kWall_m, 0.0)) {
    spec_.beam.cone_rad = 0.001 * kDegree;  // two rays
    spec_.pings.rays.assign(kHeads, PatternRay{});
    spec_.min_range_m = 1.0;
    spec_.max_range_m = 9.0;
  }
  void each_range(const std::function<void(double)>& use) const {
    const SonarSensor sensor(spec_, place_.scene, place_.surfaces, 5);
    const sense::StandingBody body{Pose()};
    Sweep made;
    for (std::uint32_t k = 0; k < kSweeps; ++k) {
      sensor.read(k, 0, body, 1, made.reading, made.truth);
      for (const double range : made.reading.range_m) use(range);
    }
  }
  static void expect_share(double count, double share) {
    EXPECT_NEAR(count / kPings, share, 3.0 * std::sqrt(share * (1.0 - share) / kPings));
  }

  Walls place_;
  SonarSpec spec_ = plain_sonar();
};

TEST_F(SonarStatistics, NoiseIsAsDeclared) {
  spec_.response = {.noise_m = 0.01, .noise_per_m = 0.005};
  double sum = 0.0, squares = 0.0;
  each_range([&](double range) {
    sum += range - kWall_m;
    squares += std::pow(range - kWall_m, 2);
  });
  const double variance = 0.01 * 0.01 + 0.02 * 0.02;
  EXPECT_NEAR(sum / kPings, 0.0, 3.0 * std::sqrt(variance / kPings));
  EXPECT_NEAR(squares / kPings, variance, 3.0 * variance * std::sqrt(2.0 / kPings));
}

TEST_F(SonarStatistics, MissedAndFalseRatesAreAsDeclared) {
  spec_.response = {.missed = 0.1, .false_echo = 0.05};
  double free = 0.0, nearer = 0.0, farther = 0.0, sum = 0.0;
  each_range([&](double range) {
    if (range == kNothing_m) {
      ++free;
    } else if (range < kWall_m - 1e-6) {
      ++nearer;
      sum += range;
    } else if (range > kWall_m + 1e-6) {
      ++farther;
    }
  });
  expect_share(free, 0.1 * 0.95);
  // False echoes are uniform from 1 to 9 m: before the wall they are heard, behind it only where its own is missed.
  expect_share(nearer, 0.05 * 3.0 / 8.0);
  expect_share(farther, 0.1 * 0.05 * 5.0 / 8.0);
  EXPECT_NEAR(sum / nearer, 2.5, 3.0 * 3.0 / std::sqrt(12.0 * nearer));
}

TEST(SonarSensor, ThreadsAndOrderChangeNothing) {
  const Walls place(test::mesh_of({test::box({-4, -3, -1}, {4, 3, 2})}));
  SonarSpec spec = plain_sonar();
  spec.pings = spinning_pattern({.step_rad = 15.0 * kDegree, .columns = 24, .elevations_rad = {0.0}});
  spec.response = {.noise_m = 0.01, .missed = 0.1, .false_echo = 0.1};
  spec.echoes = 2;
  spec.sweep_ns = 1'000'000'000;
  const SonarSensor sensor(spec, place.scene, place.surfaces, 3);
  const test::CirclingBody body({0.2, 0.1, 0.0}, 1.0, 0.8, 0.1);
  const auto bits = [](const std::vector<double>& values) {
    std::vector<std::uint64_t> made(values.size());
    std::memcpy(made.data(), values.data(), values.size() * sizeof(double));
    return made;
  };
  const Sweep later = sweep_of(sensor, body, 7, 5'000'000'000, 1);
  sweep_of(sensor, body, 1);
  const Sweep again = sweep_of(sensor, body, 7, 5'000'000'000, 4);
  EXPECT_EQ(bits(later.reading.range_m), bits(again.reading.range_m));
}

TEST(SonarSensor, MeetsTheRobotsOwnBody) {
  const Walls place(wall(4.0, 0.0));
  SonarSpec spec = plain_sonar();
  const OwnBody mast{.middle = {0.5, 0.0}, .radius_m = 0.05, .bottom_m = -1.0, .top_m = 1.0};
  const Sweep sweep =
      sweep_of(SonarSensor(spec, place.scene, place.surfaces, 1, mast), sense::StandingBody(Pose()));
  EXPECT_NEAR(sweep.reading.range_m[0], 0.45, 1e-9);
  EXPECT_EQ(sweep.truth.what[0], SonarTruth::kOwnBody);
  spec.own_body = false;
  EXPECT_NEAR(sweep_of(SonarSensor(spec, place.scene, place.surfaces, 1, mast), sense::StandingBody(Pose()))
                  .reading.range_m[0],
              4.0, 1e-6);
}

TEST(SonarSensor, WhatIsOutOfRangeIsRefusedByItsName) {
  const Walls place(wall(4.0, 0.0));
  const auto refusal = [&](const std::function<void(SonarSpec&)>& change) {
    SonarSpec spec = plain_sonar();
    change(spec);
    const std::optional<Error> error =
        test::error_of([&] { SonarSensor(spec, place.scene, place.surfaces, 1); });
    return error ? error->message().substr(0, error->message().find(' ')) : std::string("accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](SonarSpec&) {}), "accepted");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.name.clear(); }), "name");
  EXPECT_EQ(refusal([&](SonarSpec& s) { s.max_range_m = nan; }), "max_range_m");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.min_range_m = 11.0; }), "min_range_m");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.response.missed = 1.5; }), "missed");
  EXPECT_EQ(refusal([&](SonarSpec& s) { s.response.false_echo = nan; }), "false_echo");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.response.noise_m = -1.0; }), "noise_m");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.echoes = 0; }), "echoes");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.echoes = 9; }), "echoes");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.beam.cone_rad = 4.0; }), "cone_rad");
  EXPECT_EQ(refusal([&](SonarSpec& s) { s.T_body_sensor.t.x() = nan; }), "T_body_sensor");
  EXPECT_EQ(refusal([](SonarSpec& s) { s.head_radius_m = -0.1; }), "head_radius_m");
}

}  // namespace
}  // namespace hallway::sense
