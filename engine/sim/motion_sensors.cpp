// SPDX-License-Identifier: MIT
// Keys of sensors of the robot's own motion and place.
#include "sim/sensor_kinds.hpp"

namespace hallway::sim {
namespace {

sense::OffPlane read_off_plane(SensorReader& sensor) {
  return {.height_m = sensor.number("off_plane_m"), .tilt_rad = sensor.angle("off_plane_deg")};
}

}  // namespace

EncoderSpec read_encoders(const std::string& name, SensorReader& sensor) {
  EncoderSpec spec;
  if (sensor.has("wheel_base_m")) spec.wheel_base_m = sensor.number("wheel_base_m");
  if (sensor.has("wheel_radius_m")) spec.wheel_radius_m = sensor.number("wheel_radius_m");
  spec.name = name;
  if (sensor.has("ticks_per_revolution")) spec.ticks_per_revolution = sensor.number("ticks_per_revolution");
  if (sensor.has("radius_error_sigma")) spec.radius_error_sigma = sensor.number("radius_error_sigma");
  spec.timing = sensor.timing();
  return spec;
}

sense::WheelOdometrySpec read_odometry(const std::string& name, SensorReader& sensor) {
  sense::WheelOdometrySpec spec;
  spec.name = name;
  spec.encoder.name = name;
  spec.encoder.wheel_radius_m = sensor.number("wheel_radius_m");
  spec.encoder.ticks_per_revolution = sensor.number("ticks_per_revolution");
  spec.encoder.radius_error_sigma = spec.radius_sigma = sensor.number("radius_error_sigma");
  spec.wheels = sense::two_odometry_wheels(sensor.number("wheel_base_m"));
  spec.slip = sensor.number("slip");
  spec.side_slip = sensor.number("side_slip");
  spec.off_plane = read_off_plane(sensor);
  spec.timing = sensor.timing();
  return spec;
}

sense::MouseOdometrySpec read_mouse(const std::string& name, SensorReader& sensor) {
  sense::MouseOdometrySpec spec;
  spec.name = name;
  spec.counts_per_m = sensor.number("counts_per_m");
  spec.scale_sigma = sensor.number("scale_sigma");
  spec.noise = sensor.number("noise_per_root_m");
  if (const double apart_m = sensor.number("apart_m"); apart_m > 0.0)
    spec.places = {{.position_m = {0.0, 0.5 * apart_m}}, {.position_m = {0.0, -0.5 * apart_m}}};
  spec.off_plane = read_off_plane(sensor);
  sensor.place(spec);
  return spec;
}

sense::ImuSensorSpec read_inertial(const std::string& name, SensorReader& sensor, bool is_gyro) {
  sense::ImuSensorSpec spec;
  spec.name = name;
  spec.gyro.noise = sensor.number("gyro_noise");
  spec.gyro.walk = sensor.number("gyro_walk");
  spec.gyro.bias_sigma = sensor.number("gyro_bias_sigma");
  spec.gyro.scale_sigma = sensor.number("gyro_scale_sigma");
  spec.gyro.limit = sensor.number("gyro_limit");
  spec.gyro.misalignment_rad = sensor.angle("misalignment_deg");
  if (is_gyro) {
    spec.accelerometer.axes = {false, false, false};
    if (sensor.choice("axes") == 1) spec.gyro.axes = {false, false, true};
  } else {
    spec.accelerometer.noise = sensor.number("force_noise");
    spec.accelerometer.walk = sensor.number("force_walk");
    spec.accelerometer.bias_sigma = sensor.number("force_bias_sigma");
    spec.accelerometer.scale_sigma = sensor.number("force_scale_sigma");
    spec.accelerometer.limit = sensor.number("force_limit");
    spec.accelerometer.misalignment_rad = spec.gyro.misalignment_rad;
    spec.gravity_m_s2 = sensor.number("gravity_m_s2");
  }
  sensor.place(spec);
  return spec;
}

sense::GnssSpec read_gnss(const std::string& name, SensorReader& sensor) {
  sense::GnssSpec spec;
  spec.name = name;
  spec.level = {.noise_m = sensor.number("noise_m"), .correlated_m = sensor.number("correlated_m")};
  spec.height = {.noise_m = sensor.number("noise_up_m"), .correlated_m = sensor.number("correlated_up_m")};
  spec.correlation_s = sensor.number("correlation_s");
  sensor.place(spec);
  return spec;
}

sense::CompassSpec read_compass(const std::string& name, SensorReader& sensor) {
  sense::CompassSpec spec;
  spec.name = name;
  spec.noise_rad = sensor.angle("noise_deg");
  spec.bias_sigma_rad = sensor.angle("bias_sigma_deg");
  sensor.place(spec);
  return spec;
}

}  // namespace hallway::sim
