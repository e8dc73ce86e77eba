// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "icp/core/plane_map.hpp"
#include "icp/core/scan.hpp"
#include "icp/core/scan_fit.hpp"
#include "icp/core/scan_motion.hpp"
#include "icp/core/scan_options.hpp"

namespace hallway::icp {

/// Totals since the start, and facts of the last scan.
struct ScanCounters {
  std::uint64_t lost = 0;      ///< scans without a pose
  std::uint64_t searches = 0;  ///< scans whose prediction failed, so that turns were tried
  std::uint64_t patches = 0;   ///< of the map
  int iterations = 0;
  int open = 0;    ///< directions of motion that the surroundings left open
  int source = 0;  ///< what it was deskewed by: 0 nothing, 1 odometry, 2 imu, 3 motion
  double residual_m = 0.0;
  double overlap = 0.0;
  double sigma_m = 0.0;    ///< largest standard deviation of the scan's position against the map
  double sigma_rad = 0.0;  ///< likewise of its rotation
};

/// What one scan gave.
struct ScanAnswer {
  bool has_pose = false;
  Pose T_map_scanner;              ///< at the scan's end; defined when has_pose
  Mat6 covariance = Mat6::Zero();  ///< of its error since the map's first scan, as in ScanFit
  std::uint64_t epoch = 0;         ///< how often the map was begun anew
  ScanCounters counters;
};

/// Where a scanner is, by registering each scan, deskewed to its end, with a map of those before that are near (in the manner of KISS-ICP, Vizzo et al. 2023, with
/// planes). No loop is closed. The map's frame is the scanner's at the end of the first scan.
class LidarOdometry {
 public:
  explicit LidarOdometry(const ScanOptions& options) : options_(options) {}

  void reset() { *this = LidarOdometry(options_); }

  void add(const OdometryReading& reading) { motion_.add(reading); }
  void add(const RateReading& reading) { motion_.add(reading); }
  /// One scan; readings up to its end have been added. Points that are not usable are passed over.
  const ScanAnswer& process(const Scan& scan);

  /// The map's patches.
  std::vector<Patch> patches() const { return map_ ? map_->patches() : std::vector<Patch>(); }

 private:
  /// A registration, and the surfels that it was made with.
  struct Located {
    ScanFit fit;
    Expected expected;
    std::vector<Surfel> surfels;
    Mat6 doubt = Mat6::Zero();  // of the answer beyond the fit's covariance; no part of the map's
  };

  RangeNoise noise() const;
  void start(const Scan& scan, const std::vector<Surfel>& surfels);
  void begin_again(const Scan& scan);
  std::vector<Surfel> surfels_of_straight(const Scan& scan, Deskew source, const Vec6& velocity) const;
  Expected expected_of(const Scan& scan, Deskew source, const Vec6& velocity) const;
  Located locate(const Scan& scan, Deskew source);
  Located locate_with(const Scan& scan, Deskew source, const Vec6& velocity, double turn_rad = 0.0) const;
  ScanFit fit(const std::vector<Surfel>& surfels, const Pose& guess, const Mat6& covariance) const;
  Located search_turns(const Scan& scan, Deskew source, double dt) const;
  bool accepted(const ScanFit& fit) const;
  bool certain(const Mat6& covariance) const;
  void keep(const Scan& scan, const Located& located);
  void waver(const Scan& scan, const Located& located);
  void move_to(const Scan& scan, const Located& located);
  void restart(const Scan& scan);
  void miss(const Scan& scan, const Located& located);
  void judge_prediction(const Located& located);

  ScanOptions options_;
  ScanMotion motion_;
  std::optional<PlaneMap> map_;
  std::optional<Scan> first_;     // while its own motion is not known
  Pose T_map_last_;               // at the end of the last scan, as registered or predicted
  Mat6 own_ = Mat6::Zero();       // covariance of T_map_last_ against the map
  Mat6 doubt_ = Mat6::Zero();     // as in Located, of the last scan
  Mat6 path_ = Mat6::Zero();      // and since the first scan
  Vec6 velocity_ = Vec6::Zero();  // scanner's frame, per second
  double overlap_ = 0.0;          // usual of late
  double miss_m_ = 0.0;           // how far predictions were wrong of late
  std::int64_t last_ns_ = 0;
  int missed_ = 0;  // scans without a pose since the last one with
  Pose T_map_cleared_;
  ScanAnswer answer_;
};

}  // namespace hallway::icp
