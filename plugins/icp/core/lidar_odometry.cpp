// SPDX-License-Identifier: MIT
#include "icp/core/lidar_odometry.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"
#include "icp/core/scan_doubt.hpp"

namespace hallway::icp {
namespace {

constexpr double kLeastNoise = 0.002;  // of ranges that are said to be exact [m]
constexpr int kPasses = 2;             // with a velocity that the scan itself tells
constexpr std::size_t kLeastSurfels = 8;
constexpr double kScanTurn_rad = 0.1;
// Of what a planar scan does not see: how far the search may leave the plane from scan to scan
constexpr double kPlanar_m = 0.002;
constexpr double kPlanar_rad = 0.001;
constexpr double kUnseen_m = 0.01;  // and how far the scanner may have left it, since nothing tells
constexpr double kUnseen_rad = 0.02;
constexpr double kSurelyFound = 0.9;  // overlap that ends a search
constexpr double kBetter = 0.1;  // of overlap: by which a searched turn must fit better than the prediction
constexpr double kSearched = 0.04;  // variance of a prediction that is another turn [m^2, rad^2]
constexpr double kUsual = 0.8;      // of the usual overlap: below it a prediction may have been wrong
constexpr double kDoubtful = 0.7;   // likewise: below it the place may be another
constexpr double kOverlapGain = 0.2;
constexpr double kForgetAfter_m = 5.0;  // way between two looks at what is far
constexpr double kReachGrows = 3.0;     // reach over the error of predictions
constexpr double kReachFades = 0.9;

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(to_ns - from_ns);
}

double largest_sigma(const Mat3& covariance) {
  return std::sqrt(std::max(0.0, spectrum(covariance).values(2)));
}

Pose turned_by(const Pose& pose, double yaw) {
  return {(pose.q * Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()))).normalized(), pose.t};
}

}  // namespace

const ScanAnswer& LidarOdometry::process(const Scan& given) {
  const Scan scan = usable_scan(given);
  answer_.has_pose = false;
  if (map_ && scan.end_ns <= last_ns_) {  // no motion is known between moments that are one
    ++answer_.counters.lost;
    return answer_;
  }
  if (!map_) {
    begin_again(scan);
  } else {
    const Deskew source = motion_.source(options_.deskew, last_ns_, scan.end_ns);
    answer_.counters.source = options_.deskew == Deskew::none ? 0 : static_cast<int>(source);
    Located located = locate(scan, source);
    answer_.counters.iterations = located.fit.iterations;
    answer_.counters.residual_m = located.fit.residual_m;
    answer_.counters.overlap = located.fit.overlap;
    answer_.counters.open = located.fit.open - (scan.planar ? 3 : 0);
    answer_.counters.sigma_m = largest_sigma(located.fit.covariance.topLeftCorner<3, 3>());
    answer_.counters.sigma_rad = largest_sigma(located.fit.covariance.bottomRightCorner<3, 3>());
    if (accepted(located.fit) && located.fit.overlap < kDoubtful * overlap_) {
      waver(scan, located);
    } else if (accepted(located.fit)) {
      keep(scan, located);
    } else {
      miss(scan, located);
    }
  }
  if (map_) answer_.counters.patches = map_->size();
  if (!answer_.has_pose) ++answer_.counters.lost;
  motion_.forget_before(last_ns_);
  return answer_;
}

RangeNoise LidarOdometry::noise() const {
  return {std::max(options_.noise_m, kLeastNoise), options_.noise_per_m};
}

/// Makes a map of one scan, which is at the map's origin.
void LidarOdometry::start(const Scan& scan, const std::vector<Surfel>& surfels) {
  map_.emplace(options_.map_cube_m, noise(), scan.planar);
  map_->add(surfels, Pose(), Mat6::Zero());
  T_map_last_ = T_map_cleared_ = Pose();
  own_.setZero();
  doubt_.setZero();
  path_.setZero();
  last_ns_ = scan.end_ns;
  missed_ = 0;
}

void LidarOdometry::begin_again(const Scan& scan) {
  const Deskew source = motion_.source(options_.deskew, scan.begin_ns, scan.end_ns);
  const std::vector<Surfel> surfels = surfels_of_straight(scan, source, velocity_);
  if (surfels.size() < kLeastSurfels) return;
  start(scan, surfels);
  first_ = scan;
  overlap_ = 0.0;
  miss_m_ = options_.scan_reach_m / kReachGrows;
  answer_.has_pose = true;
  answer_.T_map_scanner = Pose();
  answer_.covariance.setZero();
}

/// The scan's surfels as met at its end.
std::vector<Surfel> LidarOdometry::surfels_of_straight(const Scan& scan, Deskew source,
                                                       const Vec6& velocity) const {
  const bool as_measured =
      options_.deskew == Deskew::none || scan.times_ns.empty() || scan.end_ns <= scan.begin_ns;
  return surfels_of(as_measured ? scan.points
                                : deskewed(scan.points, scan.times_ns, scan.end_ns,
                                           motion_.track(source, scan.begin_ns, scan.end_ns, velocity)),
                    scan.places, scan.planar, noise());
}

Expected LidarOdometry::expected_of(const Scan& scan, Deskew source, const Vec6& velocity) const {
  Expected expected = motion_.expected(source, last_ns_, scan.end_ns, velocity);
  if (!scan.planar) return expected;
  // Nothing is seen of z, roll and pitch: the scanner stays in its plane.
  Vec6 screw = screw_of(expected.motion);
  screw(2) = screw(3) = screw(4) = 0.0;
  expected.motion = screw_motion(screw);
  for (const int i : {2, 3, 4}) {
    expected.covariance.row(i).setZero();
    expected.covariance.col(i).setZero();
    expected.covariance(i, i) = i == 2 ? kPlanar_m * kPlanar_m : kPlanar_rad * kPlanar_rad;
  }
  return expected;
}

ScanFit LidarOdometry::fit(const std::vector<Surfel>& surfels, const Pose& guess,
                           const Mat6& covariance) const {
  ScanRules rules;
  rules.noise = noise();
  rules.reach_m = std::clamp(kReachGrows * miss_m_, 3.0 * rules.noise.noise_m,
                             std::max(options_.scan_reach_m, 3.0 * rules.noise.noise_m));
  return register_scan(*map_, surfels, guess, covariance, rules);
}

/// Tries turns to either side of the prediction, each with the skew that it would make; the one with most overlap counts.
LidarOdometry::Located LidarOdometry::search_turns(const Scan& scan, Deskew source, double dt) const {
  Located best;
  const int steps = static_cast<int>(options_.scan_turn_rad / kScanTurn_rad + 0.5);
  for (int step = 1; step <= steps && best.fit.overlap < kSurelyFound; ++step) {
    for (const double side : {1.0, -1.0}) {
      const double turn = side * step * kScanTurn_rad;
      Vec6 velocity = velocity_;
      velocity(5) += turn / dt;
      Located next = locate_with(scan, source, velocity, source == Deskew::motion ? 0.0 : turn);
      if (next.fit.converged && next.fit.overlap > best.fit.overlap) best = std::move(next);
    }
  }
  return best;
}

LidarOdometry::Located LidarOdometry::locate_with(const Scan& scan, Deskew source, const Vec6& velocity,
                                                  double turn_rad) const {
  Located located;
  located.expected = expected_of(scan, source, velocity);
  if (turn_rad != 0.0) {
    located.expected.motion = turned_by(located.expected.motion, turn_rad);
    for (const int i : {0, 1, 2, 3, 4, 5})
      if (!scan.planar || i < 2 || i == 5) located.expected.covariance(i, i) += kSearched;
  }
  located.surfels = surfels_of_straight(scan, source, velocity);
  const Pose guess = T_map_last_ * located.expected.motion;
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_map_last_.q.toRotationMatrix();
  const Mat6 covariance = carried_covariance(own_, guess.t - T_map_last_.t) +
                          turn * located.expected.covariance * turn.transpose();
  if (located.surfels.size() < kLeastSurfels) {
    located.fit.T_map_sensor = guess;
    located.fit.covariance = covariance;
    return located;
  }
  located.fit = fit(located.surfels, guess, covariance);
  if (options_.deskew != Deskew::none)
    located.fit.covariance += turn * motion_.deskew_covariance(source) * turn.transpose();
  return located;
}

/// Registers a scan; where its own velocity is not measured, it is deskewed anew with the one found.
LidarOdometry::Located LidarOdometry::locate(const Scan& scan, Deskew source) {
  const double dt = seconds_between(last_ns_, scan.end_ns);
  const Vec6 before = velocity_;
  const bool turns = source == Deskew::motion;  // are not measured
  Located located = locate_with(scan, source, velocity_);
  const Pose predicted = located.expected.motion;
  const double enough = std::max(options_.scan_overlap, kUsual * overlap_);
  if (!(located.fit.converged && located.fit.overlap >= enough) && located.surfels.size() >= kLeastSurfels &&
      options_.scan_turn_rad > 0.0) {
    ++answer_.counters.searches;
    Located found = search_turns(scan, source, dt);
    if (accepted(found.fit) && found.fit.overlap > located.fit.overlap + kBetter) located = std::move(found);
  }
  for (int pass = 1; pass < kPasses && source != Deskew::odometry; ++pass) {
    if (!accepted(located.fit)) break;
    velocity_ = screw_of(T_map_last_.inverse() * located.fit.T_map_sensor) / dt;
    if (options_.deskew == Deskew::none) break;
    // The first scan was as skewed as this one: both anew, or the error of its velocity would be in the map.
    if (first_) start(Scan(*first_), surfels_of_straight(*first_, source, velocity_));
    const Vec6 used = velocity_;
    Located next = locate_with(scan, source, velocity_);
    if (!accepted(next.fit)) break;
    located = std::move(next);
    velocity_ = screw_of(T_map_last_.inverse() * located.fit.T_map_sensor) / dt;
    located.fit.covariance += doubt_of_velocity(located.fit.T_map_sensor.q, dt * (velocity_ - used), turns);
  }
  if (accepted(located.fit)) {
    Mat6& covariance = located.fit.covariance;
    const bool measured = source == Deskew::odometry;
    if (options_.deskew == Deskew::none && !scan.times_ns.empty())
      covariance +=
          doubt_of_skew(T_map_last_.inverse() * located.fit.T_map_sensor) + doubt_of_skew(predicted);
    if (!measured && !first_)
      covariance += doubt_of_change(located.fit.T_map_sensor.q, dt * (velocity_ - before), turns);
    located.doubt = doubt_of_overlap(located.fit.overlap, overlap_,
                                     !measured                ? Measured::nothing
                                     : motion_.measures_all() ? Measured::all
                                                              : Measured::level,
                                     turns || measured);
  }
  if (!accepted(located.fit)) velocity_ = before;
  return located;
}

bool LidarOdometry::accepted(const ScanFit& fit) const {
  return fit.converged && fit.overlap >= options_.scan_overlap;
}

bool LidarOdometry::certain(const Mat6& covariance) const {
  return largest_sigma(covariance.topLeftCorner<3, 3>()) <= options_.max_sigma_m &&
         largest_sigma(covariance.bottomRightCorner<3, 3>()) <= options_.max_sigma_rad;
}

/// The reach follows how far predictions were wrong.
void LidarOdometry::judge_prediction(const Located& located) {
  const Pose guess = T_map_last_ * located.expected.motion;
  const Pose wrong = guess.inverse() * located.fit.T_map_sensor;
  const double missed_m = wrong.t.norm() + 5.0 * angle_of(wrong.q);
  miss_m_ = std::max(missed_m, kReachFades * miss_m_);
}

/// Follows a registration that fits far worse than usual: within a sharp turn it is about right, after a jump it is a place that looks alike. Neither goes into the map or is an answer.
void LidarOdometry::waver(const Scan& scan, const Located& located) {
  move_to(scan, located);
  first_.reset();
  if (++missed_ >= options_.restart_scans) restart(scan);
}

/// The motion to a registered place: its error is that of both ends against the map.
void LidarOdometry::move_to(const Scan& scan, const Located& located) {
  const ScanFit& fit = located.fit;
  const Vec3 arm = fit.T_map_sensor.t - T_map_last_.t;
  path_ = carried_covariance(path_ + own_ + doubt_, arm) + fit.covariance + located.doubt;
  if (scan.planar) {
    Vec6 unseen = Vec6::Zero();
    unseen(2) = kUnseen_m * kUnseen_m;
    unseen(3) = unseen(4) = kUnseen_rad * kUnseen_rad;
    path_ += Mat6(unseen.asDiagonal());
  }
  path_ = 0.5 * (path_ + path_.transpose().eval());
  own_ = fit.covariance;
  doubt_ = located.doubt;
  T_map_last_ = fit.T_map_sensor;
  last_ns_ = scan.end_ns;
}

void LidarOdometry::keep(const Scan& scan, const Located& located) {
  const ScanFit& fit = located.fit;
  const Pose motion = T_map_last_.inverse() * fit.T_map_sensor;
  judge_prediction(located);
  overlap_ += (overlap_ > 0.0 ? kOverlapGain : 1.0) * (fit.overlap - overlap_);
  velocity_ = screw_of(motion) / seconds_between(last_ns_, scan.end_ns);
  motion_.learn_bias(last_ns_, scan.end_ns, motion.q);
  move_to(scan, located);
  missed_ = 0;
  first_.reset();
  map_->add(located.surfels, T_map_last_, own_);
  if ((T_map_last_.t - T_map_cleared_.t).norm() > kForgetAfter_m) {
    map_->forget_beyond(T_map_last_.t, options_.map_range_m);
    T_map_cleared_ = T_map_last_;
  }
  answer_.has_pose = certain(fit.covariance + located.doubt);
  answer_.T_map_scanner = T_map_last_;
  answer_.covariance = path_;
}

/// Goes on as predicted; after many such scans with a new map.
void LidarOdometry::miss(const Scan& scan, const Located& located) {
  const Pose guess = T_map_last_ * located.expected.motion;
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_map_last_.q.toRotationMatrix();
  const Vec3 arm = guess.t - T_map_last_.t;
  own_ = carried_covariance(own_, arm) + turn * located.expected.covariance * turn.transpose();
  path_ = carried_covariance(path_, arm);
  T_map_last_ = guess;
  last_ns_ = scan.end_ns;
  miss_m_ = options_.scan_reach_m / kReachGrows;
  if (++missed_ >= options_.restart_scans || first_) restart(scan);
}

void LidarOdometry::restart(const Scan& scan) {
  const std::uint64_t epoch = answer_.epoch + 1;
  begin_again(scan);
  if (answer_.has_pose) answer_.epoch = epoch;
}

}  // namespace hallway::icp
