// SPDX-License-Identifier: MIT
#include "log_readings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "console.hpp"
#include "geom/arrays.hpp"

namespace hallway::cli {

std::optional<Pose> true_pose(const run::SourceFrame& frame) {
  return frame.orientation_known ? frame.T_world_body : std::nullopt;
}

TrueReading true_reading(const run::SourceFrame& frame, std::uint32_t k) {
  const hw_sample_t& sample = frame.sample(k);
  TrueReading reading{sample.t_begin_ns, sample.t_end_ns, {}};
  const auto truth = std::ranges::find(frame.sample_truths, k, &log::SampleTruth::sample);
  if (truth == frame.sample_truths.end()) {
    if (reading.end_ns == frame.t_ns()) reading.T_world_body = true_pose(frame);
    return reading;
  }
  const auto times = truth->values.find("t_s");
  const bool has_times = times != truth->values.end() && times->second.size() == 2;
  if (has_times) {
    reading.begin_ns = std::llround(times->second[0] * 1e9);
    reading.end_ns = std::llround(times->second[1] * 1e9);
  }
  if (truth->position_m) {
    reading.T_world_body = to_pose(*truth->position_m, truth->orientation);
  } else if (has_times || reading.end_ns == frame.t_ns()) {
    reading.T_world_body = true_pose(frame);
    reading.end_ns = frame.t_ns();
  }
  return reading;
}

void each_frame(run::Source& source, bool quiet,
                const std::function<void(std::uint32_t iteration, const run::SourceFrame& frame)>& take) {
  run::SourceFrame frame;
  Progress progress("convert", source.iterations(), quiet);
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    if (interrupted()) throw Error(ErrorCode::kInterrupted, "interrupted");
    source.read(i, frame);
    take(i, frame);
    progress.update(i + 1);
  }
}

LogMotion read_motion(run::Source& source, std::uint32_t sensor, bool quiet) {
  std::vector<import::TimedPose> poses;
  std::vector<std::int64_t> ends_ns;
  each_frame(source, quiet, [&](std::uint32_t, const run::SourceFrame& frame) {
    if (const auto pose = true_pose(frame)) poses.push_back({frame.t_ns(), *pose});
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      const TrueReading reading = true_reading(frame, k);
      if (reading.T_world_body && reading.end_ns >= 0)
        poses.push_back({reading.end_ns, *reading.T_world_body});
      if (frame.sample(k).sensor_id == sensor) ends_ns.push_back(reading.end_ns);
    }
  });
  return {import::TrueMotion(std::move(poses)), std::move(ends_ns)};
}

}  // namespace hallway::cli
