// SPDX-License-Identifier: MIT
#include "sense/imu_means.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "support/data.hpp"
#include "support/python.hpp"
#include "support/temp_folder.hpp"
#include "test_motions.hpp"

namespace hallway::sense {
namespace {

using motions::Circle;
using motions::Clothoid;
using motions::Corner;
using motions::LinesAndArcs;
using motions::Standing;
using motions::Waves;

constexpr double kGravity = 9.80665;
constexpr std::int64_t kSecond = 1'000'000'000;

ImuMeans means_of(const Trajectory& motion, std::int64_t begin_ns, std::int64_t end_ns,
                  const Pose& mount = {}) {
  return imu_means(motion, begin_ns, end_ns, mount, kGravity, "imu");
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), tolerance) << a.transpose() << " and " << b.transpose();
}

TEST(ImuMeans, AtRestAreGravityUpward) {
  const Quat q = from_yaw_pitch_roll(0.4, 0.2, -0.3);
  const Pose mount{from_yaw_pitch_roll(1.0, -0.5, 0.7), Vec3(0.1, 0.2, 0.3)};
  const ImuMeans means = means_of(Standing(q), 0, 5'000'000, mount);
  expect_near(means.angular_rad_s, Vec3::Zero(), 1e-15);
  expect_near(means.force_m_s2, (q * mount.q).conjugate() * Vec3(0.0, 0.0, kGravity), 1e-13);
  expect_near(means_of(Standing(Quat::Identity()), 0, 1).force_m_s2, Vec3(0.0, 0.0, kGravity), 1e-13);
}

TEST(ImuMeans, OnACircleAreCentripetal) {
  const Circle circle(2.0, 0.5);
  for (const std::int64_t interval_ns :
       {std::int64_t{1}, std::int64_t{1000}, 5'000'000L, kSecond, 1000 * kSecond}) {
    const ImuMeans means =
        means_of(circle, 3 * kSecond, 3 * kSecond + interval_ns, {Quat::Identity(), Vec3(0.4, -0.3, 0.2)});
    expect_near(means.angular_rad_s, Vec3(0.0, 0.0, 0.5), 1e-12);
    // To the left v w, and w^2 of the arm towards the axis.
    expect_near(means.force_m_s2, Vec3(-0.25 * 0.4, 2.0 * 0.5 + 0.25 * 0.3, kGravity), 1e-11);
  }
}

/// Motion, and the first and the last interval.
struct OracleCase {
  const char* motion;
  std::int64_t begin_ns, interval_ns;
  int count;
};

TEST(ImuMeans, EqualAnIndependentQuadrature) {
  const auto python = test::python_with_numpy();
  if (!python) GTEST_SKIP() << "no Python with numpy; HALLWAY_PYTHON names one";
  const test::TempFolder folder;
  const Pose mount{from_yaw_pitch_roll(0.3, -0.2, 0.1), Vec3(0.35, -0.12, 0.4)};
  for (const OracleCase& c :
       {OracleCase{"circle", 0, 5'000'000, 20}, OracleCase{"clothoid", 0, 5'000'000, 30},
        OracleCase{"clothoid", 0, 1'000'000'000, 4}, OracleCase{"waves", 700'000'000, 2'500'000, 50},
        OracleCase{"waves", 0, 1'000'000'000, 5}, OracleCase{"lines_and_arcs", 0, 7'000'000, 190},
        OracleCase{"lines_and_arcs", 0, 100'000'000, 20},
        OracleCase{"lines_and_arcs", 0, 1'700'000'000, 2}}) {
    SCOPED_TRACE(std::string(c.motion) + ", " + std::to_string(c.interval_ns) + " ns");
    const auto out = folder.path() / "means";
    ASSERT_EQ(test::run_python(*python, {test::source_folder() / "tests/unit/sense/imu_oracle.py", out,
                                         c.motion, std::to_string(c.begin_ns), std::to_string(c.interval_ns),
                                         std::to_string(c.count), format_double(kGravity), "0.35", "-0.12",
                                         "0.4", "0.1", "-0.2", "0.3"}),
              0);
    std::unique_ptr<Trajectory> motion = std::make_unique<Circle>(2.0, 0.5);
    if (c.motion == std::string("clothoid")) motion = std::make_unique<Clothoid>();
    if (c.motion == std::string("waves")) motion = std::make_unique<Waves>();
    if (c.motion == std::string("lines_and_arcs")) motion = std::make_unique<LinesAndArcs>();
    std::ifstream file(out);
    double largest = 0.0;
    for (int k = 0; k < c.count; ++k) {
      Vec3 angular, force;
      file >> angular.x() >> angular.y() >> angular.z() >> force.x() >> force.y() >> force.z();
      ASSERT_TRUE(file) << "line " << k;
      const std::int64_t begin_ns = c.begin_ns + k * c.interval_ns;
      const ImuMeans means = means_of(*motion, begin_ns, begin_ns + c.interval_ns, mount);
      largest = std::max({largest, (means.angular_rad_s - angular).lpNorm<Eigen::Infinity>(),
                          (means.force_m_s2 - force).lpNorm<Eigen::Infinity>()});
    }
    EXPECT_LT(largest, 1e-9);
    RecordProperty(std::string(c.motion) + "_" + std::to_string(c.interval_ns), format_double(largest));
  }
}

/// The errors of attitude and position after 4 s of strapdown integration of perfect readings.
std::array<double, 2> strapdown_error(const Trajectory& motion, std::int64_t rate_hz) {
  const std::int64_t interval_ns = kSecond / rate_hz;
  const double dt = 1.0 / static_cast<double>(rate_hz);
  const Kinematics start = motion.kinematics_at(0, 0.0, Side::kAfter);
  Pose pose = start.T_world_body;
  Vec3 velocity = start.velocity;
  for (std::int64_t k = 0; k < 4 * rate_hz; ++k) {
    const ImuMeans means = means_of(motion, k * interval_ns, (k + 1) * interval_ns);
    const Vec3 turn = dt * means.angular_rad_s;
    const Vec3 change = dt * (pose.q * rotation_by(0.5 * turn) * means.force_m_s2 - Vec3(0.0, 0.0, kGravity));
    pose.t += dt * (velocity + 0.5 * change);
    velocity += change;
    pose.q = (pose.q * rotation_by(turn)).normalized();
  }
  const Pose truth = motion.pose_at(4 * kSecond);
  return {angle_between(pose.q, truth.q), (pose.t - truth.t).norm()};
}

TEST(ImuMeans, IntegrateToTheMotionWithSecondOrder) {
  const Waves waves;
  std::array<double, 2> last{};
  for (const std::int64_t rate_hz : {200, 400, 800}) {
    const auto error = strapdown_error(waves, rate_hz);
    EXPECT_LT(error[0], 1e-4);
    EXPECT_LT(error[1], 1e-3);
    for (std::size_t i = 0; i < 2; ++i) {
      RecordProperty("error_" + std::to_string(i) + "_" + std::to_string(rate_hz),
                     format_double(error.at(i)));
      // The order is the logarithm to base 2; 1 % for what is above second order.
      if (rate_hz == 200) continue;
      EXPECT_GT(std::log2(last.at(i) / error.at(i)), 1.99) << rate_hz << " Hz, " << i;
    }
    last = error;
  }
}

TEST(ImuMeans, OfACornerAreImpulses) {
  const double turn = std::numbers::pi / 2.0;
  const Corner corner(turn);
  const Pose mount{Quat::Identity(), Vec3(0.3, 0.0, 0.0)};
  const ImuMeans means = means_of(corner, kSecond - 10'000'000, kSecond + 10'000'000, mount);
  expect_near(means.angular_rad_s, Vec3(0.0, 0.0, turn / 0.02), 1e-10);
  // The change of velocity, seen from halfway.
  expect_near(means.force_m_s2, Vec3(0.0, std::numbers::sqrt2 / 0.02, kGravity), 1e-10);
}

TEST(ImuMeans, AJumpIsInTheIntervalThatEndsWithIt) {
  const Corner corner(1.0);
  expect_near(means_of(corner, kSecond - 1'000'000, kSecond).angular_rad_s, Vec3(0.0, 0.0, 1000.0), 1e-9);
  expect_near(means_of(corner, kSecond, kSecond + 1'000'000).angular_rad_s, Vec3::Zero(), 1e-12);
  // Of a rate that jumps the force has an impulse through the lever arm: rate × arm, here from a line to an arc.
  const ImuMeans means =
      means_of(LinesAndArcs(), 299'000'000, 300'000'000, {Quat::Identity(), Vec3(0.5, 0.0, 0.0)});
  expect_near(means.force_m_s2, Vec3(0.0, 2.0 * 0.5 / 1e-3, kGravity), 1e-9);
}

TEST(ImuMeans, AreTheSameLateInARun) {
  const Pose mount{from_yaw_pitch_roll(0.1, 0.2, 0.3), Vec3(0.35, -0.12, 0.4)};
  for (const std::int64_t late_ns : {1'000'000'000'000'000L, 9'000'000'000'000'000'000L}) {
    for (const std::int64_t interval_ns : {1000L, 5'000'000L, 1'000'000'000L}) {
      const ImuMeans early = means_of(LinesAndArcs(), 250'000'000, 250'000'000 + interval_ns, mount);
      const ImuMeans late =
          means_of(LinesAndArcs(late_ns), late_ns + 250'000'000, late_ns + 250'000'000 + interval_ns, mount);
      expect_near(early.angular_rad_s, late.angular_rad_s, 1e-12);
      expect_near(early.force_m_s2, late.force_m_s2, 1e-12);
    }
  }
}

/// A motion of one's own, with nothing named as a break.
class Made : public motions::EpochMotion {
 public:
  explicit Made(std::function<Kinematics(double)> at) : at_(std::move(at)) {}

 protected:
  Kinematics at(double t, Side) const override { return at_(t); }

 private:
  std::function<Kinematics(double)> at_;
};

TEST(ImuMeans, ABreakThatIsNotNamedCostsLittle) {
  const Made jerk(
      [](double t) { return Kinematics{.acceleration = Vec3(t < 0.123456 ? 0.0 : 3.0, 0.0, 0.0)}; });
  EXPECT_NEAR(means_of(jerk, 0, kSecond).force_m_s2.x(), 3.0 * (1.0 - 0.123456), 1e-7);
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    return error.what();
  }
  return "";
}

TEST(ImuMeans, RefuseWhatHasNoMean) {
  const auto names = [](const std::string& said, const char* cause) {
    return said.find("imu") != std::string::npos && said.find(cause) != std::string::npos;
  };
  const Circle circle(1.0, 1.0);
  EXPECT_PRED2(names, refusal([&] { means_of(circle, 5, 5); }), "empty");
  EXPECT_PRED2(names, refusal([&] { means_of(circle, 5, 4); }), "empty");
  const Made bad([](double) { return Kinematics{.acceleration = Vec3(0.0, std::nan(""), 0.0)}; });
  EXPECT_PRED2(names, refusal([&] { means_of(bad, 0, 1000); }), "not finite");
  const Made huge([](double) { return Kinematics{.angular_velocity = Vec3(1e200, 1.0, 0.0)}; });
  EXPECT_PRED2(names, refusal([&] {
                 means_of(huge, 0, 1000, {Quat::Identity(), Vec3(1.0, 1.0, 0.0)});
               }),
               "not finite");
  const Made buzz([](double t) { return Kinematics{.acceleration = Vec3(std::sin(1e9 * t), 0.0, 0.0)}; });
  EXPECT_PRED2(names, refusal([&] { means_of(buzz, 0, 1000 * kSecond); }), "too fast");
  const Made strong([](double) { return Kinematics{.acceleration = Vec3(1e12, 0.0, 0.0)}; });
  EXPECT_NEAR(means_of(strong, 0, 1000).force_m_s2.x(), 1e12, 1e-2);
}

}  // namespace
}  // namespace hallway::sense
