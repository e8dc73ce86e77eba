// SPDX-License-Identifier: MIT
#include "import/imu_stream.hpp"

#include <algorithm>
#include <utility>

#include "geom/arrays.hpp"

namespace hallway::import {

ImuStream::ImuStream(std::vector<ImuSample> samples)
    : samples_(std::move(samples)), intervals_(intervals_of(samples_)) {}

void ImuStream::add_samples(std::int64_t before_ns, std::uint32_t sensor, const TrueTrack& exact,
                            RigFrame& frame) const {
  const auto first = std::ranges::upper_bound(intervals_, before_ns, {}, &Interval::end_ns);
  for (auto i = static_cast<std::size_t>(first - intervals_.begin());
       i < samples_.size() && intervals_[i].end_ns <= frame.t_ns; ++i) {
    frame.samples.push_back({.sensor = sensor,
                             .sequence = i,
                             .t_begin_ns = intervals_[i].begin_ns,
                             .t_end_ns = intervals_[i].end_ns,
                             .content = samples_[i],
                             .T_world_body = exact.at(intervals_[i].end_ns)});
  }
}

host::SensorInfo rig_sensor(std::uint32_t id, std::uint32_t kind, const char* name,
                            const Pose& T_body_sensor) {
  host::SensorInfo sensor;
  sensor.id = id;
  sensor.kind = kind;
  sensor.name = name;
  std::ranges::copy(to_array(T_body_sensor.t), sensor.T_body_sensor.position);
  std::ranges::copy(to_array(T_body_sensor.q), sensor.T_body_sensor.orientation);
  return sensor;
}

}  // namespace hallway::import
