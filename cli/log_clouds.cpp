// SPDX-License-Identifier: MIT
#include "log_clouds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "console.hpp"
#include "import/timed_poses.hpp"
#include "run/sources/abi_pose.hpp"
#include "sensor_choice.hpp"

namespace hallway::cli {

CloudExport::CloudExport(run::Source& source, const std::string& sensor, bool deskews, bool quiet)
    : sensor_(find_sensor(source.sensors(), sensor,
                          {"--sensor", {HW_SAMPLE_RANGE_SCAN, HW_SAMPLE_POINTS}, "rays or points"})),
      mount_(run::pose_of(sensor_.T_body_sensor)),
      deskews_(deskews),
      truth_(read_motion(source, sensor_.id, quiet)) {
  if (deskews_ && motion().poses().empty())
    throw Error(ErrorCode::kBadInput, "--deskew needs true poses, and the log has none with orientation");
  has_poses_ = std::ranges::all_of(truth_.end_ns,
                                   [&](std::int64_t end_ns) { return motion().covers(end_ns, end_ns); });
}

import::LidarCloud CloudExport::cloud(const run::SourceFrame& frame,
                                      std::uint32_t k){const hw_sample_t& sample = frame.sample(k);
import::LidarCloud cloud = import::cloud_of(sample);
if (deskews_) deskew(sample, true_reading(frame, k), cloud);
return cloud;
}  // namespace hallway::cli

std::optional<Pose> CloudExport::pose(const run::SourceFrame& frame, std::uint32_t k) {
  if (!has_poses_) return std::nullopt;
  const std::int64_t end_ns = true_reading(frame, k).end_ns;
  ++poses_;
  if (!motion().has(end_ns)) ++interpolated_;
  return motion().at(end_ns) * mount_;
}

void CloudExport::warn(std::vector<std::string>& warnings) const {
  if (deskewed_)
    print_warning(warnings, fmt::format("points are deskewed by interpolation between the log's true poses, "
                                        "which are at most {:.6g} s apart",
                                        static_cast<double>(longest_gap_ns_) * 1e-9));
  if (interpolated_ > 0)
    print_warning(warnings, fmt::format("{} of {} true poses are interpolated between those of the log",
                                        interpolated_, poses_));
}

void CloudExport::deskew(const hw_sample_t& sample, const TrueReading& reading, import::LidarCloud& cloud) {
  if (sample.t_begin_ns == sample.t_end_ns || cloud.points.empty()) return cloud.t_offset_ns.clear();
  const auto refuse_scan = [&](const std::string& cause) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("--deskew: scan {} of {} {}", sample.sequence, printable(sensor_.name), cause));
  };
  if (cloud.t_offset_ns.empty()) refuse_scan("has no times of its points");
  if (!motion().covers(reading.begin_ns, reading.end_ns))
    refuse_scan(fmt::format("is from {} to {} ns, and the log's true poses are from {} to {} ns",
                            reading.begin_ns, reading.end_ns, motion().poses().front().t_ns,
                            motion().poses().back().t_ns));
  // By a clock that runs fast, the last points are after the scan's true end.
  for (std::int64_t& offset : cloud.t_offset_ns) offset = std::min(offset, reading.end_ns - reading.begin_ns);
  import::deskew(cloud, reading.begin_ns, mount_, motion().at(reading.end_ns), motion());
  longest_gap_ns_ = std::max(longest_gap_ns_, motion().longest_gap_ns(reading.begin_ns, reading.end_ns));
  cloud.t_offset_ns.clear();
  deskewed_ = true;
}

}  // namespace hallway::cli
