// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include "adapter/body_frame.hpp"

namespace {
using namespace hallway;

/// Adds up a robot's motion: odometry where there is one, else encoders, else an IMU. Gyroscopes turn what encoders move.
class DeadReckoning final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info();
  explicit DeadReckoning(const hw_host_t* host) : Plugin(host) {}

  void activate(const hw_activation_t& activation) override {
    sensors_.clear();
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      const hw_sensor_info_t& info = *activation.sensors[i];
      if (info.kind == HW_SAMPLE_ENCODER && !has(info.kind)) wheels_ = sdk::copy_wheels(info);
      if (info.kind == HW_SAMPLE_ODOMETRY || info.kind == HW_SAMPLE_ENCODER || info.kind == HW_SAMPLE_IMU)
        sensors_.try_emplace(info.kind, std::pair(info.id, to_pose(info.T_body_sensor)));
    }
    if (sensors_.empty()) throw sdk::Failure(HW_ERROR_ARGUMENT, "no odometry, encoders or IMU");
    reset();
  }

  void reset() override { state_ = State(); }
  void report(bool) override {}
  void process(const hw_frame_t& frame) override {
    // The IMU first: the turns that it adds up belong to the ways that wheels tell next.
    for (const std::uint32_t kind : {HW_SAMPLE_IMU, HW_SAMPLE_ODOMETRY, HW_SAMPLE_ENCODER}) {
      for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
        const hw_sample_t& sample = *frame.samples[k];
        if (sample.kind != kind || !has(kind) || sensors_[kind].first != sample.sensor_id) continue;
        if (kind == HW_SAMPLE_IMU) add(sample, *sdk::imu_in(sample));
        if (kind == HW_SAMPLE_ODOMETRY) add(sample, *sdk::odometry_in(sample));
        if (kind == HW_SAMPLE_ENCODER) add(sample, *static_cast<const hw_encoder_t*>(sample.payload));
      }
    }
    const std::int64_t t_ns = state_.t_ns > 0 && state_.t_ns < frame.t_ns ? state_.t_ns : 0;
    host().put_pose(BodyFrame().pose(state_.T_map_body), nullptr, t_ns);
  }

 private:
  bool has(std::uint32_t kind) const { return sensors_.count(kind) > 0; }
  const Pose& mount(std::uint32_t kind) const { return sensors_.at(kind).second; }
  /// The motion of an odometry's sensor is the body's, seen from the mount.
  void add(const hw_sample_t& sample, const hw_odometry_t& odometry) {
    const Pose T_odom_body = to_pose(odometry.T_odom_sensor) * mount(HW_SAMPLE_ODOMETRY).inverse();
    state_.T_map_body =
        state_.T_map_body * (state_.T_odom_body.value_or(T_odom_body).inverse() * T_odom_body);
    state_.T_odom_body = T_odom_body;
    state_.t_ns = sample.t_end_ns;
  }

  /// Least squares of the ways of all wheels: forward, sideways, turn; what no wheel tells is 0.
  void add(const hw_sample_t& sample, const hw_encoder_t& encoder) {
    if (has(HW_SAMPLE_ODOMETRY)) return;
    Mat3 normal = 1e-9 * Mat3::Identity();
    Vec3 right = Vec3::Zero();
    std::vector<std::int64_t> ticks(wheels_.size());
    for (std::size_t i = 0; i < wheels_.size() && i < encoder.count; ++i) {
      ticks[i] = hw_wheel_ticks_at(&encoder, i);
      const Vec3 at = mount(HW_SAMPLE_ENCODER) * Vec3(wheels_[i].position);
      const Vec3 along = mount(HW_SAMPLE_ENCODER).q * Vec3(wheels_[i].direction);
      const Vec3 row(along.x(), along.y(), along.y() * at.x() - along.x() * at.y());
      if (state_.ticks.empty() || !row.allFinite() || std::isnan(wheels_[i].m_per_tick)) continue;
      normal += row * row.transpose();
      right += wheels_[i].m_per_tick * static_cast<double>(ticks[i] - state_.ticks[i]) * row;
    }
    const Vec3 way = normal.inverse() * right;
    const Quat turn = has(HW_SAMPLE_IMU) ? state_.turned : rotation_by({0.0, 0.0, way.z()});
    const Quat half = rotation_by(0.5 * rotation_vector(turn));  // where the chord of the arc points
    state_.T_map_body = state_.T_map_body * Pose{turn, half * Vec3(way.x(), way.y(), 0.0)};
    state_.turned = Quat::Identity();
    state_.ticks = ticks;
    state_.t_ns = sample.t_end_ns;
  }

  /// Turns. Ways are not added up from forces: an unknown velocity at the start would stay in them.
  void add(const hw_sample_t& sample, const hw_imu_t& imu) {
    const double dt = 1e-9 * static_cast<double>(sample.t_end_ns - sample.t_begin_ns);
    state_.turned = state_.turned * rotation_by(mount(HW_SAMPLE_IMU).q *
                                                (dt * Vec3(imu.angular_rad_s).unaryExpr([](double x) {
                                                  return std::isnan(x) ? 0.0 : x;
                                                })));
    if (sensors_.size() > 1) return;
    state_.T_map_body.q = state_.turned.normalized();
    state_.t_ns = sample.t_end_ns;
  }
  struct State {
    Pose T_map_body;
    Quat turned = Quat::Identity();   // by the IMU, since the encoders' last reading
    std::optional<Pose> T_odom_body;  // of the last readings
    std::vector<std::int64_t> ticks;
    std::int64_t t_ns = 0;
  } state_;
  std::map<std::uint32_t, std::pair<std::uint32_t, Pose>> sensors_;  // by kind: id and mount
  std::vector<hw_encoder_wheel_t> wheels_;
};

const hw_plugin_info_t* DeadReckoning::info() {
  static constexpr std::uint32_t kAnyOf[] = {HW_SAMPLE_ODOMETRY, HW_SAMPLE_ENCODER, HW_SAMPLE_IMU};
  static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE};
  static hw_plugin_info_t info =
      sdk::plugin_info("dead_reckoning", "Dead reckoning", "0.1.0", "Hallway",
                       "Adds up odometry, encoders or an IMU.", kAnyOf, kOutputs, kAnyOf);
  info.n_inputs = 0;  // none of them alone is needed
  return &info;
}
}  // namespace
HALLWAY_PLUGINS(DeadReckoning);
