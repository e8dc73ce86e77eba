// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sense/trajectory.hpp"

// Motions in closed form, as imu_oracle.py has them.
namespace hallway::sense::motions {

/// A motion whose clock begins at an epoch: late in a run it is the same as early.
class EpochMotion : public Trajectory {
 public:
  explicit EpochMotion(std::int64_t epoch_ns = 0) : epoch_ns_(epoch_ns) {}

  Pose pose_at(std::int64_t t_ns) const override {
    return kinematics_at(t_ns, 0.0, Side::kAfter).T_world_body;
  }
  Kinematics kinematics_at(std::int64_t t_ns, double after_s, Side side) const override {
    return at(1e-9 * static_cast<double>(t_ns - epoch_ns_) + after_s, side);
  }
  std::vector<double> breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const override {
    std::vector<double> found;
    for (const std::int64_t t_ns : breaks_ns_) {
      if (t_ns + epoch_ns_ > begin_ns && t_ns + epoch_ns_ <= end_ns)
        found.push_back(1e-9 * static_cast<double>(t_ns + epoch_ns_ - begin_ns));
    }
    return found;
  }

 protected:
  virtual Kinematics at(double t, Side side) const = 0;
  std::vector<std::int64_t> breaks_ns_{};  ///< since the epoch

 private:
  std::int64_t epoch_ns_;
};

inline Quat about_z(double angle) {
  return Quat(std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle));
}

/// Stands.
class Standing : public EpochMotion {
 public:
  explicit Standing(const Quat& q) : q_(q) {}

 protected:
  Kinematics at(double, Side) const override { return {.T_world_body = {q_, Vec3(1.0, 2.0, 3.0)}}; }

 private:
  Quat q_;
};

/// Along a level circle to the left (to the right for a negative rate), from the origin along x.
class Circle : public EpochMotion {
 public:
  Circle(double speed, double rate, std::int64_t epoch_ns = 0)
      : EpochMotion(epoch_ns), speed_(speed), rate_(rate) {}

 protected:
  Kinematics at(double t, Side) const override {
    const double a = rate_ * t, c = std::cos(a), s = std::sin(a);
    return {.T_world_body = {about_z(a), speed_ / rate_ * Vec3(s, 1.0 - c, 0.0)},
            .velocity = speed_ * Vec3(c, s, 0.0),
            .acceleration = speed_ * rate_ * Vec3(-s, c, 0.0),
            .angular_velocity = Vec3(0.0, 0.0, rate_)};
  }

 private:
  double speed_, rate_;
};

/// Constant speed along a clothoid; its heading is 0.3 t + 0.4 t^2. The position is left out.
class Clothoid : public EpochMotion {
 protected:
  Kinematics at(double t, Side) const override {
    constexpr double kSpeed = 1.5;
    const double heading = 0.3 * t + 0.4 * t * t, rate = 0.3 + 0.8 * t;
    const double c = std::cos(heading), s = std::sin(heading);
    return {.T_world_body = {about_z(heading), Vec3::Zero()},
            .velocity = kSpeed * Vec3(c, s, 0.0),
            .acceleration = kSpeed * rate * Vec3(-s, c, 0.0),
            .angular_velocity = Vec3(0.0, 0.0, rate),
            .angular_acceleration = Vec3(0.0, 0.0, 0.8)};
  }
};

/// A smooth motion in space: waves along each axis, and in yaw, pitch and roll.
class Waves : public EpochMotion {
 public:
  using EpochMotion::EpochMotion;

 protected:
  Kinematics at(double t, Side) const override {
    Kinematics k;
    const Wave place[]{{2.0, 0.7, 0.1}, {1.5, 1.1, 0.5}, {0.2, 2.3, 0.9}};
    for (int i = 0; i < 3; ++i) {
      k.T_world_body.t[i] = place[i].value(t);
      k.velocity[i] = place[i].slope(t);
      k.acceleration[i] = place[i].bend(t);
    }
    const Wave yaw{1.2, 0.8, 0.3}, pitch{0.3, 1.9, 0.0}, roll{0.4, 2.9, 1.0};
    const double sp = std::sin(pitch.value(t)), cp = std::cos(pitch.value(t));
    const double sr = std::sin(roll.value(t)), cr = std::cos(roll.value(t));
    const double dy = yaw.slope(t), dp = pitch.slope(t), dr = roll.slope(t);
    const double ay = yaw.bend(t), ap = pitch.bend(t), ar = roll.bend(t);
    k.T_world_body.q = from_yaw_pitch_roll(yaw.value(t), pitch.value(t), roll.value(t));
    k.angular_velocity = {dr - dy * sp, dp * cr + dy * cp * sr, -dp * sr + dy * cp * cr};
    k.angular_acceleration = {ar - ay * sp - dy * cp * dp,
                              ap * cr - dp * sr * dr + ay * cp * sr - dy * sp * dp * sr + dy * cp * cr * dr,
                              -ap * sr - dp * cr * dr + ay * cp * cr - dy * sp * dp * cr - dy * cp * sr * dr};
    return k;
  }

 private:
  struct Wave {
    double reach, rate, phase;
    double value(double t) const { return reach * std::sin(rate * t + phase); }
    double slope(double t) const { return reach * rate * std::cos(rate * t + phase); }
    double bend(double t) const { return -rate * rate * value(t); }
  };
};

/// Lines and arcs in turn, 1 m/s: each piece takes 0.3 s, and the rates are 0, 2, 0, -4 rad/s, again and again. The position is left out.
class LinesAndArcs : public EpochMotion {
 public:
  explicit LinesAndArcs(std::int64_t epoch_ns = 0) : EpochMotion(epoch_ns) {
    for (std::int64_t i = 1; i <= 100; ++i) breaks_ns_.push_back(i * 300'000'000);
  }

 protected:
  Kinematics at(double t, Side side) const override {
    constexpr double kPiece_s = 0.3;
    constexpr double kRates[]{0.0, 2.0, 0.0, -4.0};
    // On a break the side decides; rounding may have put the moment on either side of it.
    const double nearest = std::round(t / kPiece_s);
    const bool on_break = std::abs(t - nearest * kPiece_s) < 1e-12;
    const double piece = on_break ? nearest - (side == Side::kBefore ? 1.0 : 0.0) : std::floor(t / kPiece_s);
    double heading = 0.0;
    for (int i = 0; i < static_cast<int>(piece); ++i) heading += kRates[i % 4] * kPiece_s;
    const double rate = kRates[static_cast<int>(piece) % 4];
    heading += rate * (t - piece * kPiece_s);
    const double c = std::cos(heading), s = std::sin(heading);
    return {.T_world_body = {about_z(heading), Vec3::Zero()},
            .velocity = Vec3(c, s, 0.0),
            .acceleration = rate * Vec3(-s, c, 0.0),
            .angular_velocity = Vec3(0.0, 0.0, rate)};
  }
};

/// Goes at 1 m/s along x until 1 s, then along another direction, towards which it turns in no time.
class Corner : public EpochMotion {
 public:
  explicit Corner(double turn) : turn_(turn) { breaks_ns_ = {1'000'000'000}; }

 protected:
  Kinematics at(double t, Side side) const override {
    const bool is_after = t > 1.0 || (t == 1.0 && side == Side::kAfter);
    const Quat q = about_z(is_after ? turn_ : 0.0);
    const Vec3 direction = q * Vec3::UnitX();
    return {.T_world_body = {q, is_after ? Vec3(Vec3::UnitX() + (t - 1.0) * direction) : Vec3(t, 0.0, 0.0)},
            .velocity = direction};
  }

 private:
  double turn_;
};

}  // namespace hallway::sense::motions
