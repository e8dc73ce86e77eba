// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "import/scan_cloud.hpp"
#include "run/pictures/history.hpp"
#include "run/pictures/record.hpp"

namespace hallway::run {

/// A ray of a scan, in the sensor's frame.
struct ScanRay {
  Vec3 direction = Vec3::UnitX();                             ///< a unit vector
  double range_m = 0.0;                                       ///< infinite: nothing in range; never NaN
  float intensity = std::numeric_limits<float>::quiet_NaN();  ///< NaN: not known
  std::int64_t offset_ns = 0;                                 ///< after the begin of the scan
};

/// A scan of a log, with what is true of it.
struct RecordedScan {
  std::string sensor{};  ///< its name
  Pose T_body_sensor{};  ///< as plugins are told
  Pose T_world_body{};   ///< true, at the time of the frame that the scan is in
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;      ///< true times, where the log has them; else those of the sensor's clock
  bool has_times = false;       ///< whether rays have times of their own
  double max_range_m = 0.0;     ///< infinite where it is not known
  double beam_rad = 0.0;        ///< full width of a beam; 0 where it is not known
  std::vector<ScanRay> rays{};  ///< those with an answer, of all layers
};

/// The scans of a moment, and how the body truly moved around it.
struct Scans {
  std::vector<RecordedScan> scans{};  ///< by sensor
  import::TrueMotion motion{{}};
};

/// Reads the last scan of each sensor of rays from the log: that of the frame of a moment, or of an earlier one up to a second before. Of a finished log only that part is read.
/// Empty where the run has no such sensor, and where there is no log. Throws Error{kBadInput, kIo}.
Scans read_scans(const Record& record, const Instant& now);

/// How a scan is placed in the world.
enum class ScanPlacement {
  kAsMeasured,  ///< as a whole, by the true pose at its frame's time: a robot that moves skews it
  kDeskewed,    ///< each ray by the true pose at its own time
};

/// A scan in the world, metres.
struct PlacedScan {
  std::vector<Vec3> origins{};  ///< of the sensor, for each ray of the scan
  std::vector<Vec3>
      ends{};  ///< where the ray ends; of one without a return at the greatest range, not finite where that is not known
  ScanPlacement placement = ScanPlacement::kAsMeasured;  ///< as it was possible
};

/// Places the rays of a scan. Without true poses over the whole scan, or times of its rays, it is placed as measured.
PlacedScan place_scan(const RecordedScan& scan, const import::TrueMotion& motion, ScanPlacement placement);

}  // namespace hallway::run
