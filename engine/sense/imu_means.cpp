// SPDX-License-Identifier: MIT
#include "sense/imu_means.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "sense/motion_integral.hpp"

namespace hallway::sense {
namespace {

MotionSum joined(const Vec3& angular, const Vec3& force) {
  MotionSum sum;
  sum << angular, force;
  return sum;
}

class ImuIntegrand : public MotionIntegrand {
 public:
  ImuIntegrand(const Pose& T_body_sensor, double gravity_m_s2)
      : T_body_sensor_(T_body_sensor), gravity_(0.0, 0.0, -gravity_m_s2) {}

  MotionSum rate(const Kinematics& motion) const override {
    const Vec3 &w = motion.angular_velocity, &arm = T_body_sensor_.t;
    const Vec3 force = motion.T_world_body.q.conjugate() * (motion.acceleration - gravity_) +
                       motion.angular_acceleration.cross(arm) + w.cross(w.cross(arm));
    return to_sensor(w, force);
  }

  MotionSum jump(const Kinematics& before, const Kinematics& after) const override {
    const Quat &q = before.T_world_body.q, &q_after = after.T_world_body.q;
    const Vec3 turn = rotation_vector(q.conjugate() * q_after);
    return to_sensor(turn, halfway(q, q_after).conjugate() * (velocity(after) - velocity(before)));
  }

 private:
  /// Of the sensor's place, in the world.
  Vec3 velocity(const Kinematics& motion) const {
    return motion.velocity + motion.T_world_body.q * motion.angular_velocity.cross(T_body_sensor_.t);
  }
  MotionSum to_sensor(const Vec3& angular, const Vec3& force) const {
    const Quat q_sensor_body = T_body_sensor_.q.conjugate();
    return joined(q_sensor_body * angular, q_sensor_body * force);
  }

  const Pose& T_body_sensor_;
  Vec3 gravity_;
};

}  // namespace

ImuMeans imu_means(const Trajectory& trajectory, std::int64_t begin_ns, std::int64_t end_ns,
                   const Pose& T_body_sensor, double gravity_m_s2, const std::string& sensor) {
  if (end_ns <= begin_ns)
    throw Error(ErrorCode::kBadInput,
                "the interval from " + std::to_string(begin_ns) + " to " + std::to_string(end_ns) +
                    " ns is empty; an IMU measures means",
                {.element = "sensor `" + printable(sensor) + "`"});
  const MotionSum sum =
      integrate_motion(trajectory, begin_ns, end_ns, ImuIntegrand(T_body_sensor, gravity_m_s2), sensor);
  const double duration_s = 1e-9 * static_cast<double>(end_ns - begin_ns);
  return {sum.head<3>() / duration_s, sum.tail<3>() / duration_s};
}

}  // namespace hallway::sense
