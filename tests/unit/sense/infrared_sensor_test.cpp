// SPDX-License-Identifier: MIT
#include "sense/infrared_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sense/light_path.hpp"
#include "sense/standing_body.hpp"
#include "support/errors.hpp"
#include "unit/sense/moving_sensor.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::sense {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const SurfaceMaterial kWhite{.name = "white", .infrared = 0.9};
const SurfaceMaterial kBlack{.name = "black", .infrared = 0.03};
const SurfaceMaterial kGlass{.name = "glass", .infrared = 0.9, .transparency = 0.8};

/// Slabs across the x axis, each of its own material.
struct Slabs {
  struct Slab {
    double from_m;
    SurfaceMaterial material;
    double turned_rad = 0.0;
  };
  explicit Slabs(const std::vector<Slab>& slabs)
      : mesh(made(slabs)), scene(mesh, trace::Backend::kEmbree), surfaces(make_surfaces(slabs)) {}

  static trace::TriangleMesh made(const std::vector<Slab>& slabs) {
    std::vector<test::Body> bodies;
    for (const Slab& slab : slabs) {
      const Pose turn{Quat(Eigen::AngleAxisd(slab.turned_rad, Vec3::UnitZ())), Vec3(slab.from_m, 0, 0)};
      bodies.push_back(test::prism(
          4, 0.001 * std::sqrt(0.5), 4.0,
          turn * Pose{Quat(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ())), Vec3(0.0005, 0, 0)}));
      for (Polygon& face : bodies.back()) {
        for (Vec3& corner : face.vertices) {
          // A thin slab: wide across, 1 mm along.
          const Vec3 local = turn.inverse() * corner;
          corner = turn * Vec3(local.x(), 4000.0 * local.y(), local.z());
        }
        face.plane = test::plane_through(face.vertices[0], face.vertices[1], face.vertices[2]);
      }
    }
    return test::mesh_of(bodies);
  }
  Surfaces make_surfaces(const std::vector<Slab>& slabs) const {
    std::vector<SurfaceMaterial> materials;
    for (const Slab& slab : slabs) materials.push_back(slab.material);
    std::vector<std::uint16_t> of;
    const std::size_t each = mesh.triangles.size() / slabs.size();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      of.push_back(static_cast<std::uint16_t>(i / each));
    return {mesh, materials, of};
  }

  trace::TriangleMesh mesh;
  trace::Scene scene;
  Surfaces surfaces;
};

InfraredSpec plain_infrared() {
  InfraredSpec spec;
  spec.name = "ir";
  return spec;
}

double range_of(const InfraredSpec& spec, const Slabs& place, std::uint32_t number = 0) {
  InfraredReading reading;
  InfraredTruth truth;
  InfraredSensor(spec, place.scene, place.surfaces, 1)
      .read(number, 0, sense::StandingBody(Pose()), reading, truth);
  return reading.range_m.at(0);
}

TEST(InfraredSensor, SeesWhiteFromItsLeastToItsGreatestRange) {
  for (const double distance : {0.05, 0.1, 0.3, 0.5, 0.799})
    EXPECT_NEAR(range_of(plain_infrared(), Slabs({{distance, kWhite}})), distance, 1e-9);
  EXPECT_TRUE(std::isnan(range_of(plain_infrared(), Slabs({{0.049, kWhite}}))));
  for (const double distance : {0.801, 1.0})
    EXPECT_EQ(range_of(plain_infrared(), Slabs({{distance, kWhite}})), kNothing_m);
}

TEST(InfraredSensor, IsBlindToBlackWhichHidesWhatIsBehind) {
  for (const double distance : {0.05, 0.1, 0.3, 0.5, 0.8, 1.0}) {
    const Slabs place({{distance, kBlack}, {distance + 0.1, kWhite}});
    EXPECT_EQ(range_of(plain_infrared(), place), kNothing_m) << distance;
    InfraredReading reading;
    InfraredTruth truth;
    InfraredSensor(plain_infrared(), place.scene, place.surfaces, 1)
        .read(0, 0, sense::StandingBody(Pose()), reading, truth);
    EXPECT_EQ(truth.what.at(0) == InfraredTruth::kNothing, distance > 0.8) << distance;
  }
}

TEST(InfraredSensor, ALowAngleThrowsBackTooLittle) {
  InfraredSpec spec = plain_infrared();
  spec.least_light = 0.45;  // white at 60 degrees
  EXPECT_NEAR(range_of(spec, Slabs({{0.4, kWhite, 55.0 * kDegree}})), 0.4, 1e-6);
  EXPECT_EQ(range_of(spec, Slabs({{0.4, kWhite, 65.0 * kDegree}})), kNothing_m);
}

TEST(InfraredSensor, GlassLetsItsShareThrough) {
  // Two faces, each with a transparency of 0.8: 0.64 of the readings see the wall behind, the others one of the faces.
  const Slabs place({{0.3, kGlass}, {0.5, kWhite}});
  constexpr std::uint32_t kReadings = 1'000'000;
  const InfraredSensor sensor(plain_infrared(), place.scene, place.surfaces, 3);
  InfraredReading reading;
  InfraredTruth truth;
  double behind = 0.0, back = 0.0;
  for (std::uint32_t k = 0; k < kReadings; ++k) {
    sensor.read(k, 0, sense::StandingBody(Pose()), reading, truth);
    const double range = reading.range_m.at(0);
    if (range > 0.4) {
      EXPECT_NEAR(range, 0.5, 1e-9);
      ++behind;
    } else {
      EXPECT_GE(range, 0.3 - 1e-9);
      if (range > 0.3005) ++back;
    }
    EXPECT_NEAR(truth.range_m.at(0), 0.3, 1e-9);
  }
  const auto sigma = [](double share) { return 3.0 * std::sqrt(share * (1.0 - share) / kReadings); };
  EXPECT_NEAR(behind / kReadings, 0.64, sigma(0.64));
  EXPECT_NEAR(back / kReadings, 0.16, sigma(0.16));
}

TEST(InfraredSensor, OnlySaysNearOrNotWhereAsked) {
  InfraredSpec spec = plain_infrared();
  spec.near_m = 0.4;
  for (const double distance : {0.01, 0.05, 0.399})
    EXPECT_EQ(range_of(spec, Slabs({{distance, kWhite}})), 0.4) << distance;
  for (const double distance : {0.401, 0.7, 1.0})
    EXPECT_EQ(range_of(spec, Slabs({{distance, kWhite}})), kNothing_m) << distance;
}

TEST(InfraredSensor, NoiseAndRatesAreAsDeclared) {
  InfraredSpec spec = plain_infrared();
  spec.noise_m = 0.001;
  spec.noise_per_m = 0.004;
  spec.noise_per_m2 = 0.02;
  spec.missed = 0.03;
  spec.false_reading = 0.05;
  constexpr std::uint32_t kReadings = 1'000'000;
  const sense::StandingBody body{Pose()};
  InfraredReading reading;
  InfraredTruth truth;
  const auto sigma = [](double share) { return 3.0 * std::sqrt(share * (1.0 - share) / kReadings); };
  {
    const Slabs place({{0.5, kWhite}});
    const InfraredSensor sensor(spec, place.scene, place.surfaces, 3);
    double n = 0.0, sum = 0.0, squares = 0.0, free = 0.0;
    for (std::uint32_t k = 0; k < kReadings; ++k) {
      sensor.read(k, 0, body, reading, truth);
      const double error = reading.range_m[0] - 0.5;
      if (reading.range_m[0] == kNothing_m) ++free;
      if (!(std::abs(error) < 0.04)) continue;
      ++n;
      sum += error;
      squares += error * error;
    }
    EXPECT_NEAR(free / kReadings, 0.03 * 0.95, sigma(0.0285));
    const double variance = 0.001 * 0.001 + std::pow(0.004 * 0.5, 2) + std::pow(0.02 * 0.25, 2);
    EXPECT_NEAR(sum / n, 0.0, 3.0 * std::sqrt(variance / n));
    // Of the missed, a twentieth is a false reading, of which 0.08 / 0.75 are as near as that.
    const double strays = 0.03 * 0.05 * 0.08 / 0.75 / 0.97;
    const double of_square = 2.0 * variance * variance + strays * std::pow(0.04, 4) / 5.0;  // its variance
    EXPECT_NEAR(squares / n, variance + strays * 0.04 * 0.04 / 3.0, 3.0 * std::sqrt(of_square / n));
  }
  const Slabs empty({{5.0, kWhite}});
  const InfraredSensor sensor(spec, empty.scene, empty.surfaces, 4);
  double seen = 0.0, sum = 0.0;
  for (std::uint32_t k = 0; k < kReadings; ++k) {
    sensor.read(k, 0, body, reading, truth);
    if (reading.range_m[0] == kNothing_m) continue;
    ++seen;
    sum += reading.range_m[0];
  }
  EXPECT_NEAR(seen / kReadings, 0.05, sigma(0.05));
  EXPECT_NEAR(sum / seen, 0.425, 3.0 * 0.75 / std::sqrt(12.0 * seen));
}

TEST(InfraredSensor, WhatIsOutOfRangeIsRefusedByItsName) {
  const Slabs place({{0.5, kWhite}});
  const auto refusal = [&](const std::function<void(InfraredSpec&)>& change) {
    InfraredSpec spec = plain_infrared();
    change(spec);
    const std::optional<Error> error =
        test::error_of([&] { InfraredSensor(spec, place.scene, place.surfaces, 1); });
    return error ? error->message().substr(0, error->message().find(' ')) : std::string("accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](InfraredSpec&) {}), "accepted");
  EXPECT_EQ(refusal([&](InfraredSpec& s) { s.max_range_m = nan; }), "max_range_m");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.min_range_m = 2.0; }), "min_range_m");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.least_light = 1.1; }), "least_light");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.noise_per_m = -0.1; }), "noise_per_m");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.missed = -0.1; }), "missed");
  EXPECT_EQ(refusal([&](InfraredSpec& s) { s.false_reading = nan; }), "false_reading");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.near_m = 0.9; }), "near_m");
  EXPECT_EQ(refusal([](InfraredSpec& s) { s.noise_per_m2 = -1.0; }), "noise_per_m2");
}

}  // namespace
}  // namespace hallway::sense
