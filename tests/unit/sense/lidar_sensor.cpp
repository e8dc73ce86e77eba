// SPDX-License-Identifier: MIT
#include "sense/lidar_sensor.hpp"

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
constexpr std::int64_t kScan_ns = 100'000'000;

/// A room of 8 x 6 x 3 m about the origin, by its six walls.
trace::TriangleMesh room() {
  return test::mesh_of({test::box({-4, -3, -1}, {4, 3, 2})});
}

/// A scene with what sensors know of it.
struct Place {
  explicit Place(const trace::TriangleMesh& mesh, std::vector<SurfaceMaterial> materials = {})
      : scene(mesh, trace::Backend::kEmbree), surfaces(mesh, std::move(materials)) {}
  trace::Scene scene;
  Surfaces surfaces;
};

LidarSpec plain_lidar() {
  LidarSpec spec;
  spec.name = "lidar";
  spec.pattern = spinning_pattern(
      {.columns = 1800, .elevations_rad = equal_elevations(-15 * kDegree, 15 * kDegree, 16)});
  return spec;
}

struct Scan {
  LidarReading reading;
  LidarTruth truth;
};

Scan scan_of(const LidarSensor& sensor, const Trajectory& trajectory, std::uint32_t scan = 0,
             std::int64_t t_ns = 0, unsigned threads = 1) {
  Scan made;
  sensor.read(scan, t_ns, trajectory, threads, made.reading, made.truth);
  return made;
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits(values.size());
  if (!values.empty()) std::memcpy(bits.data(), values.data(), values.size() * sizeof(double));
  return bits;
}

/// Distance from inside a box to its walls, in long double.
double distance_in_box(const std::array<long double, 3>& from, const std::array<long double, 3>& along) {
  constexpr std::array<long double, 3> kLow{-4, -3, -1}, kHigh{4, 3, 2};
  long double least = 1e30L;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double slope = along.at(axis);
    if (slope == 0.0L) continue;
    least = std::min(least, ((slope > 0.0L ? kHigh.at(axis) : kLow.at(axis)) - from.at(axis)) / slope);
  }
  return static_cast<double>(least);
}

/// Every ray is measured from where the sensor is at its own time: against the same in long double, by formulas of its own.
TEST(LidarSensor, MeasuresEachRayAtItsOwnTime) {
  const Place place(room());
  LidarSpec spec = plain_lidar();
  spec.T_body_sensor = {from_yaw_pitch_roll(0.4, 0.1, -0.2), {0.1, -0.2, 0.3}};
  const LidarSensor sensor(spec, place.scene, place.surfaces, kScan_ns, 1);
  constexpr double kRadius_m = 1.5, kRate = 1.7, kRise = 0.2;
  const test::CirclingBody body({0.2, 0.1, 0.0}, kRadius_m, kRate, kRise);
  constexpr std::int64_t kBegin_ns = 1'234'567'891;
  const Scan scan = scan_of(sensor, body, 3, kBegin_ns);
  EXPECT_EQ(scan.reading.t_begin_ns, kBegin_ns);
  EXPECT_EQ(scan.reading.t_end_ns, kBegin_ns + sensor.duration_ns());
  ASSERT_EQ(scan.reading.range_m.size(), spec.pattern.rays.size());

  double worst_m = 0.0, most_skew_m = 0.0;
  const Mat3 R_body_sensor = spec.T_body_sensor.q.toRotationMatrix();
  for (std::size_t i = 0; i < spec.pattern.rays.size(); ++i) {
    const PatternRay& ray = spec.pattern.rays[i];
    const auto range_at = [&](long double t) {
      const long double c = std::cos(static_cast<long double>(kRate) * t);
      const long double s = std::sin(static_cast<long double>(kRate) * t);
      std::array<long double, 3> in_body{}, origin{};
      const long double azimuth = ray.azimuth_rad, elevation = ray.elevation_rad;
      const std::array<long double, 3> in_sensor{std::cos(elevation) * std::cos(azimuth),
                                                 std::cos(elevation) * std::sin(azimuth),
                                                 std::sin(elevation)};
      for (Eigen::Index row = 0; row < 3; ++row) {
        for (Eigen::Index k = 0; k < 3; ++k)
          in_body.at(static_cast<std::size_t>(row)) +=
              static_cast<long double>(R_body_sensor(row, k)) * in_sensor.at(static_cast<std::size_t>(k));
      }
      const Vec3& mount = spec.T_body_sensor.t;
      origin = {0.2L + kRadius_m * s + c * mount.x() - s * mount.y(),
                0.1L - kRadius_m * c + s * mount.x() + c * mount.y(), kRise * t + mount.z()};
      return distance_in_box(origin,
                             {c * in_body[0] - s * in_body[1], s * in_body[0] + c * in_body[1], in_body[2]});
    };
    const long double begin_s = static_cast<long double>(kBegin_ns) * 1e-9L;
    const double expected = range_at(begin_s + static_cast<long double>(sensor.offsets_ns()[i]) * 1e-9L);
    worst_m = std::max(worst_m, std::abs(scan.reading.range_m[i] - expected));
    most_skew_m = std::max(most_skew_m, std::abs(expected - range_at(begin_s)));
    EXPECT_EQ(scan.truth.range_m[i], scan.reading.range_m[i]);
  }
  EXPECT_LT(worst_m, 1e-9);
  EXPECT_GT(most_skew_m, 0.1) << "the motion during a scan must be visible";
}

TEST(LidarSensor, WithoutSkewMeasuresAllRaysAtTheEnd) {
  const Place place(room());
  LidarSpec spec = plain_lidar();
  spec.skew = false;
  const LidarSensor sensor(spec, place.scene, place.surfaces, kScan_ns, 1);
  const test::CirclingBody body({0.2, 0.1, 0.0}, 1.5, 1.7, 0.2);
  const Scan scan = scan_of(sensor, body, 0, 5 * kScan_ns);
  EXPECT_EQ(scan.reading.t_begin_ns, 6 * kScan_ns);
  EXPECT_EQ(scan.reading.t_end_ns, 6 * kScan_ns);
  EXPECT_EQ(sensor.duration_ns(), kScan_ns);
  const Scan standing = scan_of(sensor, sense::StandingBody(body.pose_at(6 * kScan_ns)));
  EXPECT_EQ(bits_of(scan.reading.range_m), bits_of(standing.reading.range_m));
}

TEST(LidarSensor, TellsFreeFromUnknown) {
  trace::TriangleMesh mesh = test::mesh_of({test::box({5, -1, -1}, {6, 1, 1})});
  const Place place(mesh);
  LidarSpec spec = plain_lidar();
  spec.pattern = spinning_pattern({.from_rad = 0.0, .step_rad = 90 * kDegree, .columns = 4});
  spec.max_range_m = 5.0;
  const auto range_at = [&](double x) {
    const LidarSensor sensor(spec, place.scene, place.surfaces, 0, 1);
    return scan_of(sensor, sense::StandingBody({Quat::Identity(), {x, 0, 0}})).reading.range_m[0];
  };
  EXPECT_DOUBLE_EQ(range_at(1.0), 4.0);
  EXPECT_DOUBLE_EQ(range_at(0.0), 5.0) << "the greatest range is within";
  EXPECT_EQ(range_at(-0.001), std::numeric_limits<double>::infinity()) << "free up to the greatest range";
  spec.min_range_m = 0.5;
  EXPECT_DOUBLE_EQ(range_at(4.5), 0.5);
  EXPECT_TRUE(std::isnan(range_at(4.6))) << "too near: no answer";
}

/// The statistics of what is declared, from a million rays at one distance and slant.
class LidarStatistics : public testing::Test {
 protected:
  /// A wall ahead, turned by `slant`, at `distance_m` along x: what a million beams along x measure.
  void measure(const BeamResponse& response, double distance_m, double slant_rad,
               double material_dropout = 0.0) {
    const Vec3 across(-std::sin(slant_rad), std::cos(slant_rad), 0.0);
    const Vec3 middle(distance_m, 0.0, 0.0);
    Polygon wall;
    wall.vertices = {middle - 5 * across - Vec3(0, 0, 5), middle + 5 * across - Vec3(0, 0, 5),
                     middle + 5 * across + Vec3(0, 0, 5), middle - 5 * across + Vec3(0, 0, 5)};
    trace::TriangleMesh mesh;
    mesh.add_polygon(wall);
    const Place place(mesh, {{.name = "wall", .reflectivity = 0.6, .dropout = material_dropout}});
    LidarSpec spec;
    spec.name = "lidar";
    spec.max_range_m = 50.0;
    spec.response = response;
    spec.pattern.rays.assign(10'000, PatternRay{});
    const LidarSensor sensor(spec, place.scene, place.surfaces, 0, 5);
    n_ = 0;
    double sum = 0.0, squares = 0.0, fourth = 0.0, intensity = 0.0, intensity_squares = 0.0;
    for (std::uint32_t scan = 0; scan < 100; ++scan) {
      const Scan made = scan_of(sensor, sense::StandingBody({}), scan);
      for (std::size_t i = 0; i < made.reading.range_m.size(); ++i) {
        const double range = made.reading.range_m[i];
        if (std::isnan(range)) continue;
        ++n_;
        const double error = range - distance_m;
        sum += error;
        squares += error * error;
        fourth += error * error * error * error;
        const auto seen = static_cast<double>(made.reading.intensity[i]);
        intensity += seen;
        intensity_squares += seen * seen;
      }
    }
    const auto n = static_cast<double>(n_);
    mean_ = sum / n;
    variance_ = squares / n;
    kurtosis_ = fourth / n / (variance_ * variance_);
    intensity_ = intensity / n;
    intensity_sigma_ = std::sqrt(intensity_squares / n - intensity_ * intensity_);
  }

  void expect_sigma(double sigma) const {
    const auto n = static_cast<double>(n_);
    EXPECT_LT(std::abs(mean_), 3.0 * sigma / std::sqrt(n));
    EXPECT_LT(std::abs(variance_ / (sigma * sigma) - 1.0), 3.0 * std::sqrt(2.0 / n));
    EXPECT_LT(std::abs(kurtosis_ - 3.0), 3.0 * std::sqrt(24.0 / n));
  }
  void expect_dropouts(double share) const {
    const double dropped = 1.0 - static_cast<double>(n_) / kRays;
    EXPECT_LT(std::abs(dropped - share), 3.0 * std::sqrt(share * (1.0 - share) / kRays)) << share;
  }

  static constexpr double kRays = 1e6;
  std::size_t n_ = 0;
  double mean_ = 0.0, variance_ = 0.0, kurtosis_ = 0.0, intensity_ = 0.0, intensity_sigma_ = 0.0;
};

TEST_F(LidarStatistics, NoiseGrowsWithDistanceAndSlantAsDeclared) {
  const BeamResponse response{.noise_m = 0.02, .noise_per_m = 0.001, .noise_incidence = 0.002};
  for (const auto& [distance, slant] :
       {std::pair{2.0, 0.0}, {20.0, 0.0}, {20.0, 60 * kDegree}, {5.0, 80 * kDegree}}) {
    measure(response, distance, slant);
    EXPECT_EQ(n_, 1'000'000u);
    const double smear = 0.002 * distance * std::tan(slant);
    expect_sigma(std::sqrt(0.02 * 0.02 + 1e-6 * distance * distance + smear * smear));
  }
}

TEST_F(LidarStatistics, DropoutsAreTheDeclaredShare) {
  measure({.noise_m = 0.01, .dropout = 0.1}, 10.0, 0.0);
  expect_dropouts(0.1);
  measure({.noise_m = 0.01, .dropout_at_max = 0.8}, 25.0, 0.0);
  expect_dropouts(0.8 * 0.25);
  measure({.noise_m = 0.01, .dropout_incidence = 0.9}, 10.0, 60 * kDegree);
  expect_dropouts(0.9 * 0.25);
  measure({.noise_m = 0.01}, 10.0, 0.0, 0.37);
  expect_dropouts(0.37);
  measure({.noise_m = 0.01, .dropout = 0.1, .dropout_at_max = 0.8, .dropout_incidence = 0.9}, 25.0,
          60 * kDegree, 0.37);
  expect_dropouts(1.0 - 0.9 * 0.8 * 0.775 * 0.63);
  measure({.dropout = 1.0}, 10.0, 0.0);
  EXPECT_EQ(n_, 0u);
}

TEST_F(LidarStatistics, IntensityIsWhatTheSurfaceScattersBack) {
  measure({.intensity_noise = 0.05}, 10.0, 60 * kDegree);
  EXPECT_NEAR(intensity_, 0.6 * 0.5, 3.0 * 0.3 * 0.05 / 1e3 + 1e-6);
  EXPECT_NEAR(intensity_sigma_, 0.3 * 0.05, 0.3 * 0.05 * 3.0 / std::sqrt(2e6));
}

/// A post 2 m ahead covers the left half of a beam, a wall is behind.
class LidarEdge : public testing::Test {
 protected:
  std::array<double, 2> measure(double wall_m, std::uint32_t returns, double post_ends_at = 0.0) const {
    const Place place(test::mesh_of(
        {test::box({2, post_ends_at, -1}, {2.1, 1, 1}), test::box({wall_m, -5, -1}, {wall_m + 0.1, 5, 1})}));
    LidarSpec spec;
    spec.name = "lidar";
    spec.pattern.rays.assign(1, PatternRay{});
    spec.beam = {.divergence_rad = 0.01, .pulse_m = 0.5};
    spec.returns = returns;
    const LidarSensor sensor(spec, place.scene, place.surfaces, 0, 1);
    const Scan scan = scan_of(sensor, sense::StandingBody({}));
    return {scan.reading.range_m[0], returns == 2 ? scan.reading.range_m[1] : -1.0};
  }
  static constexpr double kOff_m = 1e-3;  ///< by which a slanted probe is longer
};

TEST_F(LidarEdge, SurfacesCloseToEachOtherGiveAMixedReturn) {
  EXPECT_NEAR(measure(2.4, 1, 0.001)[0], (2.0 + 4 * 2.4) / 5.0, kOff_m) << "one of five on the post";
  EXPECT_NEAR(measure(2.4, 1, -0.001)[0], (4 * 2.0 + 2.4) / 5.0, kOff_m) << "four of five on the post";
}

TEST_F(LidarEdge, SurfacesApartGiveTheOneWithMoreOfTheBeamOrBoth) {
  EXPECT_NEAR(measure(5.0, 1, 0.001)[0], 5.0, kOff_m);
  EXPECT_NEAR(measure(5.0, 1, -0.001)[0], 2.0, kOff_m);
  EXPECT_NEAR(measure(5.0, 2, 0.001)[0], 2.0, kOff_m);
  EXPECT_NEAR(measure(5.0, 2, 0.001)[1], 5.0, kOff_m);
  EXPECT_NEAR(measure(5.0, 2, -0.9)[0], 2.0, kOff_m);
  EXPECT_TRUE(std::isnan(measure(5.0, 2, -0.9)[1])) << "all of the beam on the post: no second return";
}

TEST_F(LidarEdge, LabelsAreOfEachReturn) {
  // The post has the triangles 0 to 11, the wall the others.
  const Place place(test::mesh_of({test::box({2, 0, -1}, {2.1, 1, 1}), test::box({5, -5, -1}, {5.1, 5, 1})}));
  LidarSpec spec;
  spec.name = "lidar";
  spec.pattern.rays = {PatternRay{}, PatternRay{.azimuth_rad = 0.2}, PatternRay{.azimuth_rad = 3.0}};
  spec.beam = {.divergence_rad = 0.01, .pulse_m = 0.5};
  spec.returns = 2;
  EXPECT_TRUE(scan_of(LidarSensor(spec, place.scene, place.surfaces, 0, 1), sense::StandingBody({}))
                  .truth.returned.empty());
  spec.labels = true;
  const Scan scan = scan_of(LidarSensor(spec, place.scene, place.surfaces, 0, 1), sense::StandingBody({}));
  const auto& labels = scan.truth.returned;
  ASSERT_EQ(labels.size(), 6u);
  EXPECT_LT(labels[0], 12u) << "the edge of the post";
  EXPECT_GE(labels[3], 12u) << "the wall behind it";
  EXPECT_LT(labels[3], LidarTruth::kOwnBody);
  EXPECT_LT(labels[1], 12u);
  EXPECT_EQ(labels[4], LidarTruth::kNothing) << "no second return";
  EXPECT_EQ(labels[2], LidarTruth::kNothing) << "a free beam";
  spec.response.dropout = 1.0;
  for (const std::uint32_t label :
       scan_of(LidarSensor(spec, place.scene, place.surfaces, 0, 1), sense::StandingBody({})).truth.returned)
    EXPECT_EQ(label, LidarTruth::kNothing) << "of no answer";
}

TEST(LidarSensor, SeesItsOwnRobotUnlessItIsInIt) {
  const Place place(room());
  LidarSpec spec = plain_lidar();
  spec.pattern = spinning_pattern({.from_rad = 0.0, .step_rad = 90 * kDegree, .columns = 4});
  const OwnBody mast{.middle = {-0.5, 0.0}, .radius_m = 0.1, .bottom_m = -1.0, .top_m = 1.0};
  const LidarSensor outside(spec, place.scene, place.surfaces, 0, 1, mast);
  const Scan scan = scan_of(outside, sense::StandingBody({}));
  EXPECT_NEAR(scan.reading.range_m[2], 0.4, 1e-12) << "straight back";
  EXPECT_EQ(scan.truth.what[2], LidarTruth::kOwnBody);
  EXPECT_NEAR(scan.reading.range_m[0], 4.0, 1e-12);
  EXPECT_LT(scan.truth.what[0], LidarTruth::kOwnBody);
  spec.T_body_sensor.t = {-0.5, 0.05, 0.0};
  const LidarSensor inside(spec, place.scene, place.surfaces, 0, 1, mast);
  EXPECT_NEAR(scan_of(inside, sense::StandingBody({})).reading.range_m[2], 3.5, 1e-12);
}

TEST(LidarSensor, TheSameBytesForAnyThreadsOrderAndNeighbours) {
  const Place place(room());
  LidarSpec spec = plain_lidar();
  spec.response = {.noise_m = 0.02,
                   .noise_per_m = 0.001,
                   .noise_incidence = 0.001,
                   .dropout = 0.1,
                   .dropout_at_max = 0.2,
                   .dropout_incidence = 0.3,
                   .intensity_noise = 0.1};
  spec.beam.divergence_rad = 0.003;
  spec.returns = 2;
  const LidarSensor sensor(spec, place.scene, place.surfaces, kScan_ns, 1);
  const LidarSensor again(spec, place.scene, place.surfaces, kScan_ns, 1);
  const test::CirclingBody body({0.2, 0.1, 0.0}, 1.5, 1.7, 0.2);
  std::vector<Scan> scans;
  for (std::uint32_t k = 0; k < 3; ++k) scans.push_back(scan_of(sensor, body, k, k * kScan_ns));
  for (const std::uint32_t k : {2u, 0u, 1u}) {
    const Scan other = scan_of(again, body, k, k * kScan_ns, 4);
    EXPECT_EQ(bits_of(other.reading.range_m), bits_of(scans[k].reading.range_m));
    EXPECT_EQ(bits_of(other.truth.range_m), bits_of(scans[k].truth.range_m));
    EXPECT_EQ(other.truth.what, scans[k].truth.what);
  }
  spec.name = "other";
  const LidarSensor renamed(spec, place.scene, place.surfaces, kScan_ns, 1);
  EXPECT_NE(bits_of(scan_of(renamed, body, 0, 0).reading.range_m), bits_of(scans[0].reading.range_m));
  // A prefix of the rays has the noise that it has with more of them.
  spec.name = "lidar";
  const std::size_t all = spec.pattern.rays.size();
  spec.pattern = {.rays = {spec.pattern.rays.begin(), spec.pattern.rays.begin() + 100}};
  spec.returns = 1;
  spec.beam.divergence_rad = 0.0;
  const LidarSensor few(spec, place.scene, place.surfaces, kScan_ns, 1);
  spec.pattern = plain_lidar().pattern;
  const LidarSensor many(spec, place.scene, place.surfaces, kScan_ns, 1);
  const Scan short_scan = scan_of(few, body), long_scan = scan_of(many, body);
  ASSERT_EQ(long_scan.reading.range_m.size(), all);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_EQ(bits_of(short_scan.reading.range_m)[i], bits_of(long_scan.reading.range_m)[i]);
}

TEST(LidarSensor, OutOfPlaceSaysSo) {
  const Place place(room());
  const LidarSensor sensor(plain_lidar(), place.scene, place.surfaces, kScan_ns, 1);
  Pose bad;
  bad.t.x() = std::nan("");
  const auto error = test::error_of([&] { scan_of(sensor, sense::StandingBody(bad)); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->where().element.find("`lidar`"), std::string::npos);
  bad.t.x() = 2e8;
  EXPECT_TRUE(test::error_of([&] { scan_of(sensor, sense::StandingBody(bad)); }));
  const Place nothing{trace::TriangleMesh{}};
  const LidarSensor lost(plain_lidar(), nothing.scene, nothing.surfaces, kScan_ns, 1);
  for (const double range : scan_of(lost, sense::StandingBody({})).reading.range_m)
    ASSERT_EQ(range, std::numeric_limits<double>::infinity());
  // From within a wall it sees the wall's other side.
  const Place wall(test::mesh_of({test::box({-1, -1, -1}, {1, 1, 1})}));
  const LidarSensor buried(plain_lidar(), wall.scene, wall.surfaces, kScan_ns, 1);
  EXPECT_LE(scan_of(buried, sense::StandingBody({})).reading.range_m[900], std::sqrt(3.0));
}

TEST(LidarSensor, RefusesBadSpecificationsByName) {
  const Place place(room());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<const char*, std::function<void(LidarSpec&)>> bad[] = {
      {"name", [](LidarSpec& s) { s.name.clear(); }},
      {"T_body_sensor", [](LidarSpec& s) { s.T_body_sensor.t.y() = kNan; }},
      {"T_body_sensor", [](LidarSpec& s) { s.T_body_sensor.q.coeffs() *= 2.0; }},
      {"no ray", [](LidarSpec& s) { s.pattern = {}; }},
      {"azimuth", [](LidarSpec& s) { s.pattern.rays[3].azimuth_rad = kNan; }},
      {"min_range_m", [](LidarSpec& s) { s.min_range_m = 101.0; }},
      {"max_range_m", [](LidarSpec& s) { s.max_range_m = kNan; }},
      {"max_range_m", [](LidarSpec& s) { s.max_range_m = s.min_range_m = 0.0; }},
      {"noise_m", [](LidarSpec& s) { s.response.noise_m = -0.1; }},
      {"noise_per_m", [](LidarSpec& s) { s.response.noise_per_m = kNan; }},
      {"noise_incidence", [](LidarSpec& s) { s.response.noise_incidence = 1.0 / 0.0; }},
      {"intensity_noise", [](LidarSpec& s) { s.response.intensity_noise = -1.0; }},
      {"dropout", [](LidarSpec& s) { s.response.dropout = 1.1; }},
      {"dropout_at_max", [](LidarSpec& s) { s.response.dropout_at_max = kNan; }},
      {"dropout_incidence", [](LidarSpec& s) { s.response.dropout_incidence = -0.1; }},
      {"divergence_rad", [](LidarSpec& s) { s.beam.divergence_rad = 0.2; }},
      {"pulse_m", [](LidarSpec& s) { s.beam.pulse_m = kNan; }},
      {"returns", [](LidarSpec& s) { s.returns = 3; }},
      {"returns", [](LidarSpec& s) { s.returns = 0; }},
  };
  for (const auto& [member, spoil] : bad) {
    LidarSpec spec = plain_lidar();
    spoil(spec);
    const auto error = test::error_of([&] { LidarSensor(spec, place.scene, place.surfaces, kScan_ns, 1); });
    ASSERT_TRUE(error) << member;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(error->message().find(member), std::string::npos) << error->message();
  }
}

}  // namespace
}  // namespace hallway::sense
