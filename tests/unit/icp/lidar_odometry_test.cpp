// SPDX-License-Identifier: MIT
#include "icp/core/lidar_odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clouds.hpp"

namespace hallway::icp {
namespace {

constexpr std::int64_t kScan_ns = 100'000'000;
constexpr double kNoise_m = 0.02;

/// The inside of a box: its corners, map frame [m].
struct Box {
  Vec3 low, high;
};

/// Distance to the inside of a box along a ray from within; infinite where `open` leaves out the walls across x.
double range_in(const Box& box, const Vec3& from, const Vec3& ray, bool open) {
  double range = clouds::kInf;
  for (int k = open ? 1 : 0; k < 3; ++k) {
    if (ray(k) != 0.0)
      range = std::min(range, ((ray(k) > 0.0 ? box.high(k) : box.low(k)) - from(k)) / ray(k));
  }
  return range;
}

/// A scan of 16 rings, or one, in a box by a sensor whose pose at its time is T_at(t_s); skewed.
template <typename Path>
Scan scan_of(const Box& box, bool open, int rings, int number, const Path& T_at, clouds::Random& random) {
  Scan scan;
  scan.begin_ns = number * kScan_ns;
  scan.end_ns = scan.begin_ns + kScan_ns;
  scan.planar = rings == 1;
  constexpr int kColumns = 600;
  for (int column = 0; column < kColumns; ++column) {
    const std::int64_t t_ns = scan.begin_ns + kScan_ns * column / kColumns;
    const Pose T = T_at(1e-9 * static_cast<double>(t_ns));
    for (int ring = 0; ring < rings; ++ring) {
      const double azimuth = 2.0 * M_PI * column / kColumns;
      const double elevation = rings == 1 ? 0.0 : (-15.0 + 2.0 * ring) * M_PI / 180.0;
      const Vec3 ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation));
      const double range = range_in(box, T.t, T.q * ray, open) + kNoise_m * random.normal();
      if (!(range < 30.0)) continue;
      scan.points.push_back(range * ray);
      scan.times_ns.push_back(t_ns);
      scan.places.push_back({static_cast<std::uint32_t>(ring), static_cast<std::uint32_t>(column)});
    }
  }
  return scan;
}

const Box kRoom{{-6, -4, -1}, {7, 5, 2}};

Pose along_arc(double t_s) {
  Vec6 screw;
  screw << 1.0 * t_s, 0.0, 0.0, 0.0, 0.0, 0.4 * t_s;
  return screw_motion(screw);
}

/// The worst gap between estimate and truth over `scans` scans of an arc, each pose told.
double worst_on_arc(LidarOdometry& odometry, int rings, int scans, bool gives_odometry) {
  clouds::Random random(7);
  double worst = 0.0;
  const Pose T_start = along_arc(0.1);
  for (int i = 0; i < scans; ++i) {
    if (gives_odometry) {
      if (i == 0) odometry.add(OdometryReading{0, along_arc(0.0), Mat6::Zero()});
      odometry.add(OdometryReading{(i + 1) * kScan_ns, along_arc(0.1 * (i + 1)), 1e-8 * Mat6::Identity()});
    }
    const ScanAnswer& answer = odometry.process(scan_of(kRoom, false, rings, i, along_arc, random));
    EXPECT_TRUE(answer.has_pose) << "scan " << i;
    worst = std::max(worst, clouds::gap(answer.T_map_scanner, T_start.inverse() * along_arc(0.1 * (i + 1))));
  }
  return worst;
}

TEST(LidarOdometry, FollowsAnArcByOdometry) {
  LidarOdometry odometry{ScanOptions()};
  EXPECT_LT(worst_on_arc(odometry, 16, 20, true), 0.015);
}

TEST(LidarOdometry, FollowsAnArcByItsOwnMotion) {
  LidarOdometry odometry{ScanOptions()};
  EXPECT_LT(worst_on_arc(odometry, 16, 20, false), 0.02);
}

TEST(LidarOdometry, FollowsAnArcInThePlane) {
  LidarOdometry odometry{ScanOptions()};
  EXPECT_LT(worst_on_arc(odometry, 1, 20, true), 0.03);
}

TEST(LidarOdometry, IsWorseWithoutDeskewing) {
  ScanOptions options;
  LidarOdometry straight(options);
  options.deskew = Deskew::none;
  LidarOdometry skewed(options);
  EXPECT_LT(3.0 * worst_on_arc(straight, 16, 20, true), worst_on_arc(skewed, 16, 20, true));
}

TEST(LidarOdometry, DoubtsATurnThatSkewHides) {
  // Most rays of a scan at whose end a turn begins were taken before it: as measured it fits the map unturned.
  double worst = 0.0;
  for (const double rate : {0.5, 1.0, 2.0}) {
    const auto path = [rate](double t_s) {
      return clouds::pose({0.8 * std::min(t_s, 1.0), 0.0, 0.0}, rate * std::max(0.0, t_s - 1.08));
    };
    ScanOptions options;
    options.deskew = Deskew::none;
    LidarOdometry odometry(options);
    odometry.add(OdometryReading{0, path(0.0), Mat6::Zero()});
    clouds::Random random(13);
    ScanAnswer before;
    for (int i = 0; i < 12; ++i) {
      odometry.add(OdometryReading{(i + 1) * kScan_ns, path(0.1 * (i + 1)), 1e-8 * Mat6::Identity()});
      for (int k = 10 * i; k < 10 * (i + 1); ++k) {
        const Vec3 turned = rotation_vector(path(0.01 * k).q.conjugate() * path(0.01 * (k + 1)).q);
        odometry.add(RateReading{k * kScan_ns / 10, (k + 1) * kScan_ns / 10, turned / 0.01});
      }
      const ScanAnswer answer = odometry.process(scan_of(kRoom, false, 16, i, path, random));
      if (answer.has_pose && before.has_pose && answer.epoch == before.epoch) {
        const Quat turned = before.T_map_scanner.q.conjugate() * answer.T_map_scanner.q;
        const Quat truth = path(0.1 * i).q.conjugate() * path(0.1 * (i + 1)).q;
        const double wrong = std::abs(rotation_vector(truth * turned.conjugate()).z());
        const double sigma = std::sqrt(answer.covariance(5, 5) - before.covariance(5, 5));
        EXPECT_LT(wrong, 5.0 * sigma) << "scan " << i << " at " << rate << " rad/s";
        worst = std::max(worst, wrong);
      }
      before = answer;
    }
  }
  EXPECT_GT(worst, 0.01);  // it is wrong, and says so
}

TEST(LidarOdometry, ResetIsANewStart) {
  LidarOdometry odometry{ScanOptions()};
  const double first = worst_on_arc(odometry, 16, 4, true);
  odometry.reset();
  EXPECT_EQ(worst_on_arc(odometry, 16, 4, true), first);
}

TEST(ScanFit, FindsTheMotionFromAGuessFarOff) {
  clouds::Random random(3);
  const auto still = [](double) { return Pose(); };
  const Pose moved = clouds::pose({0.25, -0.15, 0.05}, 0.09, 0.02);
  const RangeNoise noise{kNoise_m, 0.0};
  const auto surfels = [&](const Scan& scan) { return surfels_of(scan.points, scan.places, false, noise); };
  PlaneMap map(2.0, noise, false);
  map.add(surfels(scan_of(kRoom, false, 16, 0, still, random)), Pose(), Mat6::Zero());
  ScanRules rules;
  rules.reach_m = 0.8;
  const Scan scan = scan_of(
      kRoom, false, 16, 1, [&](double) { return moved; }, random);
  const ScanFit fit = register_scan(map, surfels(scan), Pose(), 0.1 * Mat6::Identity(), rules);
  EXPECT_TRUE(fit.converged);
  EXPECT_GT(fit.overlap, 0.8);
  EXPECT_EQ(fit.open, 0);
  EXPECT_LT(clouds::gap(fit.T_map_sensor, moved), 0.01);
}

TEST(LidarOdometry, SaysThatAPlainCorridorLeavesItsMotionOpen) {
  // Walls, floor and ceiling without an end: nothing tells the way along them. What is told nevertheless is within its own uncertainty.
  ScanOptions options;
  options.max_sigma_m = 0.25;
  LidarOdometry odometry(options);
  clouds::Random random(5);
  const Box corridor{{0, -1, -1}, {0, 1, 1.7}};
  const auto path = [](double t_s) { return clouds::pose({1.0 * t_s, 0.0, 0.0}, 0.0); };
  int told = 0;
  double sigma_m = 0.0;
  for (int i = 0; i < 25; ++i) {
    const ScanAnswer& answer = odometry.process(scan_of(corridor, true, 16, i, path, random));
    if (i == 0 || !answer.has_pose || answer.epoch > 0) continue;
    told = i;
    EXPECT_GT(answer.covariance(0, 0), sigma_m * sigma_m) << i;
    sigma_m = std::sqrt(answer.covariance(0, 0));
    EXPECT_LT(std::abs(answer.T_map_scanner.t.x() - 0.1 * i), 4.0 * sigma_m) << i;
  }
  EXPECT_GT(sigma_m, 0.1);
  EXPECT_LT(told, 20);  // from then on it says that it does not know
}

TEST(LidarOdometry, BridgesACorridorByOdometryWithItsUncertainty) {
  LidarOdometry odometry{ScanOptions()};
  clouds::Random random(5);
  const Box corridor{{0, -1, -1}, {0, 1, 1.7}};
  const auto path = [](double t_s) { return clouds::pose({1.0 * t_s, 0.0, 0.0}, 0.0); };
  odometry.add(OdometryReading{0, Pose(), Mat6::Zero()});
  ScanAnswer last;
  for (int i = 0; i < 15; ++i) {
    odometry.add(OdometryReading{(i + 1) * kScan_ns, path(0.1 * (i + 1)), 1e-5 * Mat6::Identity()});
    last = odometry.process(scan_of(corridor, true, 16, i, path, random));
    EXPECT_TRUE(last.has_pose) << i;
  }
  EXPECT_NEAR(last.T_map_scanner.t.x(), 1.4, 0.1);
  EXPECT_GT(last.covariance(0, 0), 4.0 * last.covariance(1, 1));
}

TEST(LidarOdometry, AJumpIsNoMotion) {
  // The room looks the same after half a turn, so not that far. Carried to another place of it within a scan, while odometry says that it stands: it says that it is lost or begins anew, or it is right within its covariance.
  for (const bool gives_odometry : {true, false}) {
    for (const double turn : {0.0, 1.6}) {
      ScanOptions options;
      options.restart_scans = 5;
      options.scan_turn_rad = 0.2;
      LidarOdometry odometry(options);
      clouds::Random random(11);
      const auto path = [&](double t_s) { return t_s < 0.95 ? Pose() : clouds::pose({3.0, 1.5, 0.0}, turn); };
      if (gives_odometry) odometry.add(OdometryReading{0, Pose(), Mat6::Zero()});
      int lost = 0;
      for (int i = 0; i < 17; ++i) {
        if (gives_odometry)
          odometry.add(OdometryReading{(i + 1) * kScan_ns, Pose(), 1e-6 * Mat6::Identity()});
        const ScanAnswer& answer = odometry.process(scan_of(kRoom, false, 16, i, path, random));
        if (!answer.has_pose || answer.epoch > 0) {
          ++lost;
          continue;
        }
        const Vec3 error = answer.T_map_scanner.t - path(0.1 * (i + 1)).t;
        EXPECT_LT(std::abs(error.x()), 5.0 * std::sqrt(answer.covariance(0, 0)) + 0.01)
            << "scan " << i << ", turn " << turn << ", odometry " << gives_odometry << ", overlap "
            << answer.counters.overlap;
      }
      EXPECT_LT(lost, 17);
    }
  }
}

TEST(LidarOdometry, SkipsWhatIsNoPointAndStartsWithAScanThatHasEnough) {
  LidarOdometry odometry{ScanOptions()};
  Scan empty;
  empty.end_ns = kScan_ns;
  EXPECT_FALSE(odometry.process(empty).has_pose);
  clouds::Random random(9);
  Scan scan = scan_of(
      kRoom, false, 16, 1, [](double) { return Pose(); }, random);
  scan.points[5] = {clouds::kNan, 0, 0};
  scan.points[6] = {clouds::kInf, 0, 0};
  EXPECT_TRUE(odometry.process(scan).has_pose);
  EXPECT_FALSE(odometry.process(scan).has_pose);  // the same moment again
}

}  // namespace
}  // namespace hallway::icp
