// SPDX-License-Identifier: MIT
#include "log_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/arrays.hpp"
#include "host/samples/imu_kind.hpp"
#include "host/samples/point_kind.hpp"
#include "import/rig_recording.hpp"

namespace hallway::cli {
namespace {

/// An intensity as the ABI allows it; other numbers say nothing.
float abi_intensity(float value) {
  return value >= 0.0f && std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
}

/// A recording of a rig as a source of frames that counts what is missing in those it gives.
class RigSource : public run::Source {
 public:
  /// @param steps  how many frames to give; 0 for all
  RigSource(std::unique_ptr<import::RigRecording> recording, std::uint32_t steps)
      : recording_(std::move(recording)), iterations_(recording_->frames()) {
    facts_.sensors = recording_->sensors();
    if (steps > 0) iterations_ = std::min(iterations_, steps);
  }

  std::uint32_t iterations() const override { return iterations_; }
  /// About the frames that were read.
  std::vector<std::string> missing() const {
    std::vector<std::string> lines;
    if (not_finite_ > 0)
      lines.push_back(
          fmt::format("{} points that are not finite were left out, of {} frames", not_finite_, counted_));
    if (recording_->has_truth() && without_truth_ > 0)
      lines.push_back(fmt::format("{} of {} frames have no true pose near enough in time (--truth-within)",
                                  without_truth_, counted_));
    return lines;
  }

 private:
  void fill(std::uint32_t iteration, run::SourceFrame& frame) override {
    recording_->read(iteration, rig_);
    host::FrameBuilder& builder = frame.begin(iteration, rig_.t_ns);
    frame.T_world_body = rig_.T_world_body;
    std::uint64_t not_finite = 0;
    for (std::uint32_t k = 0; k < rig_.samples.size(); ++k) {
      const import::RigSample& sample = rig_.samples[k];
      std::visit([&](const auto& content) { add(sample, content, builder); }, sample.content);
      if (const auto* cloud = std::get_if<import::LidarCloud>(&sample.content))
        not_finite += cloud->not_finite;
      if (sample.T_world_body && sample.t_end_ns != rig_.t_ns)
        frame.sample_truths.push_back({.sample = k,
                                       .position_m = to_array(sample.T_world_body->t),
                                       .orientation = to_array(sample.T_world_body->q)});
    }
    if (iteration < counted_) return;  // read again
    counted_ = iteration + 1;
    not_finite_ += not_finite;
    if (!rig_.T_world_body) ++without_truth_;
  }

  void add(const import::RigSample& sample, const import::LidarCloud& cloud,
           host::FrameBuilder& builder) const {
    std::vector<hw_point3_t>& points = host::add_points(builder, facts_.sensors[sample.sensor].id);
    builder.set_reading(sample.sequence, sample.t_begin_ns, sample.t_end_ns);
    for (const auto& [x, y, z] : cloud.points) points.push_back({x, y, z});
    const host::RayLists data = host::add_point_data(builder);
    data.t_offset_ns = cloud.t_offset_ns;
    data.ring = cloud.ring;
    std::ranges::transform(cloud.intensity, std::back_inserter(data.intensity), abi_intensity);
  }

  void add(const import::RigSample& sample, const import::ImuSample& imu, host::FrameBuilder& builder) const {
    hw_imu_t& into = host::add_imu(builder, facts_.sensors[sample.sensor].id);
    builder.set_reading(sample.sequence, sample.t_begin_ns, sample.t_end_ns);
    std::ranges::copy(imu.angular_rad_s, into.angular_rad_s);
    std::ranges::copy(imu.force_m_s2, into.force_m_s2);
  }

  std::unique_ptr<import::RigRecording> recording_;
  std::uint32_t iterations_;
  import::RigFrame rig_;
  std::uint32_t counted_ = 0;  ///< frames before this one
  std::uint64_t not_finite_ = 0;
  std::uint32_t without_truth_ = 0;
};

std::unique_ptr<import::RigRecording> open_rig_recording(import::Kind kind, const LogChoice& log,
                                                         const ImportChoice& choice) {
  import::RigOptions options;
  if (choice.truth_within_s) options.truth_within_ns = std::llround(*choice.truth_within_s * 1e9);
  if (log.period_s) options.period_ns = std::llround(*log.period_s * 1e9);
  if (kind == import::Kind::kKitti) return import::open_kitti_rig(log.log);
  if (kind == import::Kind::kEuroc) return import::open_euroc_rig(log.log, options);
  return import::open_pcd_imu_rig(log.log, options);
}

}  // namespace

OpenedLog open_rig(import::Kind kind, const LogChoice& log, const ImportChoice& choice) {
  std::unique_ptr<import::RigRecording> recording = open_rig_recording(kind, log, choice);
  OpenedLog opened;
  opened.name = recording_name(log.log);
  opened.period_ns = recording->period_ns();
  auto source = std::make_unique<RigSource>(std::move(recording), log.steps);
  opened.missing = [counts = source.get()] { return counts->missing(); };
  opened.source = std::move(source);
  return opened;
}

}  // namespace hallway::cli
