// SPDX-License-Identifier: MIT
#include "sense/bump_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace hallway::sense {
namespace {

const Pose kBody{from_yaw_pitch_roll(0.7, 0.0, 0.0), Vec3(3, -2, 0.5)};

/// A contact in a direction of the body.
BumpContact contact_at(double angle, double gap = 0.001) {
  const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
  return {kBody * Vec3(0.2 * out + Vec3(0, 0, 0.1)), -(kBody.q * out), gap, kBody};
}

TEST(BumpSensor, EachDirectionIsInOneZone) {
  const BumpSensor bump({.name = "bump"}, 1);
  for (int i = -720; i <= 720; ++i) {
    const BumpContact contact = contact_at(i * std::numbers::pi / 360.0);
    int pressed = 0;
    for (const ZoneReading& zone : bump.read({&contact, 1}, 0).zones) pressed += zone.pressed;
    EXPECT_EQ(pressed, 1) << i;
  }
  for (const auto& [angle, index] : {std::pair(0.5, 0u), {2.0, 1u}, {-2.0, 2u}, {-0.5, 3u}}) {
    const BumpContact contact = contact_at(angle);
    const ZoneReading zone = bump.read({&contact, 1}, 0).zones[index];
    EXPECT_TRUE(zone.pressed);
    EXPECT_LT((zone.direction - Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 1e-12);
    EXPECT_EQ(zone.depth_m, 0.0);
    EXPECT_TRUE(bump.truth({&contact, 1}).pressed[index]);
    EXPECT_EQ(bump.truth({&contact, 1}).points[index].size(), 1u);
  }
}

TEST(BumpSensor, ZonesMayPassTheBack) {
  BumpSensorSpec spec{.name = "bump", .zones = {{"rear", 2.5, -2.5}, {"low", 0.0, 0.0, 0.0, 0.05}}};
  const BumpSensor bump(spec, 1);
  for (const auto& [angle, is_in] : {std::pair(3.1, true), {-3.1, true}, {2.4, false}, {0.0, false}}) {
    const BumpContact contact = contact_at(angle);
    const BumpReading reading = bump.read({&contact, 1}, 0);
    EXPECT_EQ(reading.zones[0].pressed, is_in) << angle;
    EXPECT_FALSE(reading.zones[1].pressed);
  }
}

TEST(BumpSensor, APatchPressesEachZoneThatHasSomeOfIt) {
  const auto region = [](double low, double high) {
    return BumpZone{.name = "region",
                    .region = {{Vec3::UnitZ(), high}, {-Vec3::UnitZ(), -low}, {-Vec3::UnitX(), 0.0}}};
  };
  const BumpSensor bump({.name = "bump",
                         .zones = {{"left", 0.0, 1.0},
                                   {"right", -1.0, 0.0},
                                   {"low", -1.0, 1.0, 0.0, 0.09},
                                   {"middle", -1.0, 1.0, 0.1, 0.11},
                                   {"above", -1.0, 1.0, 0.21, 0.3},
                                   {"behind", 2.0, 4.0},
                                   region(0.15, 0.16),
                                   region(0.21, 0.3)}},
                        1);
  BumpContact contact = contact_at(0.0);
  EXPECT_FALSE(bump.read({&contact, 1}, 0).zones[2].pressed) << "its point alone is higher";
  for (const auto& [y, z] : {std::pair(-0.1, 0.05), {0.1, 0.05}, {0.1, 0.2}, {-0.1, 0.2}})
    contact.patch.push_back(kBody * Vec3(0.2, y, z));
  const auto zones = bump.read({&contact, 1}, 0).zones;
  const std::vector<bool> expected{true, true, true, true, false, false, true, false};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(zones[i].pressed, expected[i]) << i;
}

TEST(BumpSensor, DepthIsThatOfTheSkin) {
  const BumpSensor bump({.name = "bump", .depth = true, .skin_m = 0.004}, 1);
  for (const auto& [gap, depth] : {std::pair(0.0, 0.004), {0.001, 0.003}, {0.004, 0.0}, {1.0, 0.0}}) {
    const std::vector<BumpContact> contacts{contact_at(0.3, gap), contact_at(0.4, 2.0)};
    const ZoneReading zone = bump.read(contacts, 0).zones[0];
    EXPECT_EQ(zone.pressed, depth > 0.0);
    EXPECT_NEAR(zone.depth_m, depth, 1e-15);
  }
}

TEST(BumpSensor, MissedAndFalsePressesHaveTheirRates) {
  const BumpSensor bump({.name = "bump", .missed_rate = 0.2, .false_rate = 0.05}, 9);
  constexpr std::uint32_t kReadings = 20'000;
  const BumpContact contact = contact_at(0.3);
  double missed = 0.0, wrong = 0.0;
  for (std::uint32_t k = 0; k < kReadings; ++k) {
    const BumpReading reading = bump.read({&contact, 1}, k);
    missed += !reading.zones[0].pressed;
    wrong += reading.zones[1].pressed;
  }
  EXPECT_NEAR(missed / kReadings, 0.2, 3.0 * std::sqrt(0.16 / kReadings));
  EXPECT_NEAR(wrong / kReadings, 0.05, 3.0 * std::sqrt(0.0475 / kReadings));
  EXPECT_TRUE(bump.truth({&contact, 1}).pressed[0]);
}

TEST(BumpSensor, RefusesBadInput) {
  EXPECT_THROW(BumpSensor({.name = ""}, 1), Error);
  EXPECT_THROW(BumpSensor({.name = "b", .zones = {}}, 1), Error);
  EXPECT_THROW(BumpSensor({.name = "b", .zones = {{"z", NAN, 1.0}}}, 1), Error);
  EXPECT_THROW(BumpSensor({.name = "b", .zones = {{"z", 0.0, 1.0, 1.0, 0.5}}}, 1), Error);
  EXPECT_THROW(BumpSensor({.name = "b", .skin_m = 0.0}, 1), Error);
  EXPECT_THROW(BumpSensor({.name = "b", .missed_rate = 1.5}, 1), Error);
}

}  // namespace
}  // namespace hallway::sense
