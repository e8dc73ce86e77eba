// SPDX-License-Identifier: MIT
#include "drive/spec.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct NumberKey {
  std::string key;
  std::function<void(DriveSpec&, double)> set;
  DriveKind kind = DriveKind::kDifferential;  ///< for which it is of use
  bool zero_is_valid = false;
};

std::vector<NumberKey> number_keys() {
  using S = DriveSpec;
  std::vector<NumberKey> keys{
      {"wheel_base_m", [](S& s, double v) { s.wheel_base_m = v; }},
      {"axle_distance_m", [](S& s, double v) { s.axle_distance_m = v; }},
      {"wheel_radius_m", [](S& s, double v) { s.wheel_radius_m = v; }},
      {"greatest_steering_rad", [](S& s, double v) { s.greatest_steering_rad = v; }},
      {"max_steering_rate_rad_s", [](S& s, double v) { s.max_steering_rate_rad_s = v; }},
      {"max_speed_m_s", [](S& s, double v) { s.max_speed_m_s = v; }},
      {"max_lateral_m_s", [](S& s, double v) { s.max_lateral_m_s = v; }, DriveKind::kOmnidirectional},
      {"max_angular_rad_s", [](S& s, double v) { s.max_angular_rad_s = v; }},
      {"max_acceleration_m_s2", [](S& s, double v) { s.max_acceleration_m_s2 = v; }},
      {"max_deceleration_m_s2", [](S& s, double v) { s.max_deceleration_m_s2 = v; }},
      {"max_angular_acceleration_rad_s2", [](S& s, double v) { s.max_angular_acceleration_rad_s2 = v; }},
      {"dead_band_m_s", [](S& s, double v) { s.dead_band_m_s = v; }, DriveKind::kDifferential, true},
      {"dead_band_rad_s", [](S& s, double v) { s.dead_band_rad_s = v; }, DriveKind::kDifferential, true},
      {"turn_slip", [](S& s, double v) { s.turn_slip = v; }, DriveKind::kTracked, true},
      {"turn_slip_noise", [](S& s, double v) { s.turn_slip_noise = v; }, DriveKind::kTracked, true}};
  const std::vector<std::pair<std::string, Disturbance S::*>> disturbances{
      {"forward_noise", &S::forward_noise},
      {"angular_noise", &S::angular_noise},
      {"lateral_drift", &S::lateral_drift},
      {"left_slip", &S::left_slip},
      {"right_slip", &S::right_slip}};
  for (const auto& [name, member] : disturbances) {
    keys.push_back({name + ".sigma", [m = member](S& s, double v) { (s.*m).sigma = v; },
                    DriveKind::kDifferential, true});
  }
  return keys;
}

/// The key that an Error names; empty if the spec is valid.
std::string refused(const DriveSpec& spec) {
  try {
    check(spec);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    EXPECT_FALSE(error.message().empty());
    return error.where().element;
  }
  return {};
}

TEST(DriveSpec, DefaultsOfEveryKindAreValid) {
  for (const DriveKind kind : testing::kKinds) EXPECT_EQ(refused({.kind = kind}), "");
}

TEST(DriveSpec, BadNumbersAreRefusedByKey) {
  for (const NumberKey& one : number_keys()) {
    for (const double bad : {kNan, kInf, -kInf, -1.0, -1e-300, 1e300, 0.0}) {
      DriveSpec spec{.kind = one.kind};
      one.set(spec, bad);
      const std::string expected = bad == 0.0 && one.zero_is_valid ? "" : "key `" + one.key + "`";
      EXPECT_EQ(refused(spec), expected) << bad;
    }
  }
}

TEST(DriveSpec, BadTimesAndMeansAreRefusedByKey) {
  for (const std::int64_t bad : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(refused({.latency_ns = bad}), "key `latency_ns`");
    EXPECT_EQ(refused({.forward_noise = {0.0, 0.1, bad}}), "key `forward_noise.correlation_ns`");
    EXPECT_EQ(refused({.angular_noise = {0.0, 0.1, bad}}), "key `angular_noise.correlation_ns`");
    EXPECT_EQ(refused({.lateral_drift = {0.0, 0.1, bad}}), "key `lateral_drift.correlation_ns`");
    EXPECT_EQ(refused({.left_slip = {0.0, 0.1, bad}}), "key `left_slip.correlation_ns`");
    EXPECT_EQ(refused({.right_slip = {0.0, 0.1, bad}}), "key `right_slip.correlation_ns`");
  }
  for (const double bad : {kNan, kInf, -1.5, 1.5}) {
    EXPECT_EQ(refused({.forward_noise = {.mean = bad}}), "key `forward_noise.mean`");
    EXPECT_EQ(refused({.angular_noise = {.mean = bad}}), "key `angular_noise.mean`");
    EXPECT_EQ(refused({.lateral_drift = {.mean = bad}}), "key `lateral_drift.mean`");
    EXPECT_EQ(refused({.left_slip = {.mean = bad}}), "key `left_slip.mean`");
    EXPECT_EQ(refused({.right_slip = {.mean = bad}}), "key `right_slip.mean`");
  }
}

TEST(DriveSpec, ValuesThatDoNotFitAreRefused) {
  EXPECT_EQ(refused({.max_speed_m_s = 0.5, .dead_band_m_s = 0.5}), "key `dead_band_m_s`");
  EXPECT_EQ(refused({.max_angular_rad_s = 0.5, .dead_band_rad_s = 0.6}), "key `dead_band_rad_s`");
  EXPECT_EQ(refused({.turn_slip = 0.1}), "key `turn_slip`");
  EXPECT_EQ(refused({.turn_slip_noise = 0.1}), "key `turn_slip_noise`");
  EXPECT_EQ(refused({.kind = DriveKind::kTracked, .turn_slip = 1.0}), "key `turn_slip`");
  EXPECT_EQ(refused({.max_lateral_m_s = 0.1}), "key `max_lateral_m_s`");
  EXPECT_EQ(refused({.kind = DriveKind::kOmnidirectional, .max_speed_m_s = 0.5, .max_lateral_m_s = 0.6}),
            "key `max_lateral_m_s`");
  EXPECT_EQ(refused({.greatest_steering_rad = 1.6}), "key `greatest_steering_rad`");
}

TEST(DriveSpec, EmptyLimitsFollowOthers) {
  EXPECT_EQ(deceleration_limit({.max_acceleration_m_s2 = 0.7}), 0.7);
  EXPECT_EQ(deceleration_limit({.max_deceleration_m_s2 = 0.2}), 0.2);
  EXPECT_EQ(lateral_limit({.kind = DriveKind::kOmnidirectional, .max_speed_m_s = 0.4}), 0.4);
  EXPECT_EQ(lateral_limit({}), 0.0);
}

TEST(DriveSpec, NamesOfKindsGoBothWays) {
  for (const DriveKind kind : testing::kKinds) EXPECT_EQ(drive_kind_of(name_of(kind)), kind);
  EXPECT_EQ(name_of(DriveKind::kTracked), "tracked");
  EXPECT_FALSE(drive_kind_of("hover"));
}

TEST(DriveSpec, DriveRefusesABadOne) {
  EXPECT_THROW(Drive({.max_speed_m_s = -1.0}, 1), Error);
}

}  // namespace
}  // namespace hallway::drive
