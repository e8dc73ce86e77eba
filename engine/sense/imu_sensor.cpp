// SPDX-License-Identifier: MIT
#include "sense/imu_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kCut_sigma = 4.0;

/// Which numbers of a triad a deviate is for, from the triad's first element.
enum ImuElement : std::uint32_t { kWhite = 0, kWalk = 3, kTurnOn = 6, kMixing = 9, kElements = 18 };

void check_triad(const SpecCheck& check, const std::string& triad, const ImuTriadSpec& spec) {
  const auto member = [&](const char* name) { return triad + "." + name; };
  check.not_negative(member("noise").c_str(), spec.noise);
  check.not_negative(member("walk").c_str(), spec.walk);
  if (!spec.bias.allFinite()) check.fail(member("bias"), "is not finite");
  check.not_negative(member("bias_sigma").c_str(), spec.bias_sigma);
  check.within(member("scale_sigma").c_str(), spec.scale_sigma, 0.0, 0.1);
  check.within(member("misalignment_rad").c_str(), spec.misalignment_rad, 0.0, 0.1);
  if (!(spec.limit > 0.0)) check.fail(member("limit"), "must be above 0, or infinite");
  check.not_negative(member("resolution").c_str(), spec.resolution);
}

const ImuSensorSpec& checked_imu(const ImuSensorSpec& spec, double interval_s) {
  const SpecCheck check(spec.name);
  check.mount(spec.T_body_sensor);
  check.not_negative("gravity_m_s2", spec.gravity_m_s2);
  check_triad(check, "gyro", spec.gyro);
  check_triad(check, "accelerometer", spec.accelerometer);
  const auto has_some = [](const ImuTriadSpec& triad) {
    return std::ranges::any_of(triad.axes, [](bool is_there) { return is_there; });
  };
  if (!has_some(spec.gyro) && !has_some(spec.accelerometer)) check.fail("axes", "names no axis");
  check.positive("interval", interval_s);
  return spec;
}

std::array<double, 6> white_covariance(const ImuTriadSpec& spec, double sigma) {
  const auto variance = [&](std::size_t axis) { return spec.axes.at(axis) ? sigma * sigma : kNone; };
  const auto between = [&](std::size_t a, std::size_t b) {
    return spec.axes.at(a) && spec.axes.at(b) ? 0.0 : kNone;
  };
  return {variance(0), between(0, 1), between(0, 2), variance(1), between(1, 2), variance(2)};
}

[[noreturn]] void refuse_imu_reading(const std::string& sensor, std::uint64_t k, const std::string& problem) {
  throw Error(ErrorCode::kBadInput, problem,
              {.element = "sensor `" + printable(sensor) + "`, reading " + std::to_string(k)});
}

}  // namespace

ImuSensor::ImuSensor(ImuSensorSpec spec, double interval_s, std::uint64_t seed)
    : spec_(std::move(spec)),
      random_(seed, stream_id("sensor.imu." + checked_imu(spec_, interval_s).name)),
      gyro_(make_triad(spec_.gyro, 0, interval_s)),
      accelerometer_(make_triad(spec_.accelerometer, kElements, interval_s)) {}

ImuSensor::Triad ImuSensor::make_triad(const ImuTriadSpec& spec, std::uint32_t first_element,
                                       double interval_s) const {
  const auto deviate = [&](std::uint32_t element) {
    return std::clamp(random_.normal(first_element + element, 0), -kCut_sigma, kCut_sigma);
  };
  Triad triad{.first_element = first_element};
  for (std::uint32_t i = 0; i < 3; ++i) {
    triad.turn_on_bias[i] = spec.bias[i] + spec.bias_sigma * deviate(kTurnOn + i);
    for (std::uint32_t j = 0; j < 3; ++j)
      triad.mixing(i, j) +=
          (i == j ? spec.scale_sigma : spec.misalignment_rad) * deviate(kMixing + 3 * i + j);
    triad.walks.emplace_back(random_, first_element + kWalk + i, spec.walk, interval_s);
  }
  return triad;
}

Vec3 ImuSensor::bias(const ImuTriadSpec& spec, const Triad& triad, std::uint64_t k) {
  Vec3 bias = Vec3::Constant(kNone);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (spec.axes.at(i)) bias[axis] = triad.turn_on_bias[axis] + triad.walks[i].value(k);
  }
  return bias;
}

ImuTruth ImuSensor::truth(const Trajectory& trajectory, std::uint64_t k, std::int64_t begin_ns,
                          std::int64_t end_ns) const {
  return {imu_means(trajectory, begin_ns, end_ns, spec_.T_body_sensor, spec_.gravity_m_s2, spec_.name),
          bias(spec_.gyro, gyro_, k), bias(spec_.accelerometer, accelerometer_, k)};
}

Vec3 ImuSensor::measured(const ImuTriadSpec& spec, const Triad& triad, const Vec3& mean, const Vec3& bias,
                         std::uint64_t k, double sigma) const {
  const Vec3 mixed = triad.mixing * mean;
  Vec3 reading = Vec3::Constant(kNone);
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (!spec.axes.at(i)) continue;
    double value = mixed[i] + bias[i];
    if (sigma > 0.0) value += sigma * random_.normal(triad.first_element + kWhite + i, k);
    if (!std::isfinite(value))
      refuse_imu_reading(spec_.name, k, "it is not a finite number: too great a motion or noise");
    value = std::clamp(value, -spec.limit, spec.limit);
    const double steps = spec.resolution > 0.0 ? std::round(value / spec.resolution) : 0.0;
    // Beyond 2^53 steps every number is a multiple, but for rounding.
    if (spec.resolution > 0.0 && std::abs(steps) < 0x1p53) value = steps * spec.resolution;
    reading[i] = value;
  }
  return reading;
}

ImuReading ImuSensor::read(const ImuTruth& truth, std::uint64_t k, std::int64_t duration_ns) const {
  if (duration_ns <= 0) refuse_imu_reading(spec_.name, k, "its interval is empty; an IMU measures means");
  const double root_s = std::sqrt(1e-9 * static_cast<double>(duration_ns));
  const double angular_sigma = spec_.gyro.noise / root_s, force_sigma = spec_.accelerometer.noise / root_s;
  return {
      measured(spec_.gyro, gyro_, truth.means.angular_rad_s, truth.angular_bias, k, angular_sigma),
      measured(spec_.accelerometer, accelerometer_, truth.means.force_m_s2, truth.force_bias, k, force_sigma),
      white_covariance(spec_.gyro, angular_sigma), white_covariance(spec_.accelerometer, force_sigma)};
}

}  // namespace hallway::sense
