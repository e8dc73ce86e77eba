// SPDX-License-Identifier: MIT
#include "run/pictures/scans.hpp"

#include <hallway/range_scan.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <variant>

#include "base/error.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/run_log.hpp"
#include "run/pictures/log_part.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kOldest_ns = 1'000'000'000;
/// What is read before a moment: the oldest scan, and the motion during it.
constexpr std::int64_t kBefore_ns = 3'000'000'000;

bool has_lidar(const Record& record) {
  const Json sensors = sensors_of(record);
  return std::ranges::any_of(sensors, [](const Json& one) { return one.value("kind", "") == "range_scan"; });
}

std::vector<ScanRay> rays_of(const hw_range_scan_t& scan) {
  std::vector<ScanRay> rays;
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t& ray = *hw_ray_at(&scan, i);
    if (std::isnan(ray.range_m)) continue;
    const hw_point3_t direction = hw_ray_direction(&ray);
    ScanRay& added = rays.emplace_back();
    added.direction = Vec3(direction.x, direction.y, direction.z);
    added.range_m = ray.range_m;
    if (scan.intensity != nullptr) added.intensity = scan.intensity[i];
    if (scan.t_offset_ns != nullptr) added.offset_ns = scan.t_offset_ns[i];
  }
  return rays;
}

/// Takes the messages of a log in their order: a frame is before what is true of it.
class Collector {
 public:
  explicit Collector(const Record& record, const Instant& now) : sensors_(sensors_of(record)), now_(now) {}

  void take(const log::McapChannel& channel, const log::McapMessage& message) {
    t_ns_ = static_cast<std::int64_t>(message.log_time_ns);
    iteration_ = message.sequence;
    std::visit(*this, log::parse_run_message(channel, message));
  }

  void operator()(const log::FrameMessage& message) {
    const hw_frame_t& frame = reader_.read(std::as_bytes(std::span(message.bytes)));
    ends_ns_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      ends_ns_.push_back(sample.t_end_ns);
      if (sample.kind == HW_SAMPLE_RANGE_SCAN && t_ns_ >= now_.t_ns - kOldest_ns) add_scan(sample, k);
    }
  }
  void operator()(const log::SampleTruthMessage& message) {
    const log::SampleTruth& truth = message.truth;
    if (truth.sample >= ends_ns_.size()) return;
    std::int64_t end_ns = ends_ns_[truth.sample];
    if (const auto times = truth.values.find("t_s");
        times != truth.values.end() && times->second.size() == 2) {
      end_ns = nanoseconds(times->second[1]);
      for (auto& [id, last] : last_) {
        if (last.iteration != iteration_ || last.sample != truth.sample) continue;
        last.scan.begin_ns = nanoseconds(times->second[0]);
        last.scan.end_ns = end_ns;
      }
    }
    if (truth.position_m && end_ns >= 0)
      poses_.push_back({end_ns, to_pose(*truth.position_m, truth.orientation)});
  }
  void operator()(const log::IterationPose& pose) {
    if (!pose.orientation_known) return;
    const Pose T_world_body = to_pose(pose.position_m, pose.orientation);
    poses_.push_back({t_ns_, T_world_body});
    for (auto& [id, last] : last_) {
      if (last.iteration == iteration_) last.scan.T_world_body = T_world_body;
    }
  }
  template <typename Other>
  void operator()(const Other&) {}

  Scans finish() {
    Scans found{.scans = {}, .motion = import::TrueMotion(std::move(poses_))};
    for (auto& [id, last] : last_) found.scans.push_back(std::move(last.scan));
    return found;
  }

 private:
  /// The last scan of a sensor, and where it was.
  struct Last {
    std::uint32_t iteration = 0;
    std::uint32_t sample = 0;
    RecordedScan scan;
  };

  void add_scan(const hw_sample_t& sample, std::uint32_t k) {
    const auto& payload = *static_cast<const hw_range_scan_t*>(sample.payload);
    Last& last = last_[sample.sensor_id];
    last = {.iteration = iteration_, .sample = k, .scan = {}};
    RecordedScan& scan = last.scan;
    scan.T_world_body = now_.T_world_body;
    scan.begin_ns = sample.t_begin_ns;
    scan.end_ns = sample.t_end_ns;
    scan.has_times = payload.t_offset_ns != nullptr || sample.t_begin_ns == sample.t_end_ns;
    scan.rays = rays_of(payload);
    scan.max_range_m = std::numeric_limits<double>::infinity();
    if (sample.sensor_id >= sensors_.size()) return;
    const Json& sensor = sensors_[sample.sensor_id];
    scan.sensor = sensor.value("name", "");
    scan.T_body_sensor = mount_of(sensor);
    if (const Json range = value_at(sensor, {"max_range_m"}); range.is_number())
      scan.max_range_m = range.get<double>();
    if (const Json width = value_at(sensor, {"intrinsics", "beam_rad"}); width.is_number())
      scan.beam_rad = width.get<double>();
  }

  Json sensors_;
  Instant now_;
  host::FrameReader reader_;
  std::int64_t t_ns_ = 0;
  std::uint32_t iteration_ = 0;
  std::vector<std::int64_t> ends_ns_;  ///< of the samples of the last frame, by the sensors' clocks
  std::map<std::uint32_t, Last> last_;
  std::vector<import::TimedPose> poses_;
};

}  // namespace

Scans read_scans(const Record& record, const Instant& now) {
  const fs::path file = record.folder / files::kLog;
  if (!has_lidar(record) || !fs::exists(file)) return {};
  Collector collector(record, now);
  read_messages(file, std::max<std::int64_t>(now.t_ns - kBefore_ns, 0), now.t_ns,
                [&](const log::McapChannel& channel, const log::McapMessage& message) {
                  if (message.sequence <= now.iteration) collector.take(channel, message);
                });
  return collector.finish();
}

PlacedScan place_scan(const RecordedScan& scan, const import::TrueMotion& motion, ScanPlacement placement) {
  PlacedScan placed;
  const bool deskews =
      placement == ScanPlacement::kDeskewed && scan.has_times && motion.covers(scan.begin_ns, scan.end_ns);
  placed.placement = deskews ? ScanPlacement::kDeskewed : ScanPlacement::kAsMeasured;
  Pose T_world_sensor = scan.T_world_body * scan.T_body_sensor;
  std::int64_t of_ns = -1;
  for (const ScanRay& ray : scan.rays) {
    // By a clock that runs fast, the last rays are after the scan's true end.
    if (const std::int64_t t_ns = std::min(scan.begin_ns + ray.offset_ns, scan.end_ns);
        deskews && t_ns != of_ns) {
      T_world_sensor = motion.at(t_ns) * scan.T_body_sensor;
      of_ns = t_ns;
    }
    const double range_m = std::min(ray.range_m, scan.max_range_m);
    placed.origins.push_back(T_world_sensor.t);
    placed.ends.push_back(T_world_sensor * Vec3(range_m * ray.direction));
  }
  return placed;
}

}  // namespace hallway::run
