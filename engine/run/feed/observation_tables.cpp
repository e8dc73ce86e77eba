// SPDX-License-Identifier: MIT
#include "run/feed/observation_tables.hpp"

#include <hallway/planes.h>

#include "record/files.hpp"
#include "record/plane_observations.hpp"

namespace hallway::run {
namespace {

namespace files = record::files;

std::string file_of(const host::SensorInfo& sensor, bool alone) {
  const std::filesystem::path name =
      sensor.kind == HW_SAMPLE_PLANES ? files::kObservedPlanes : files::kObservations;
  return alone ? name.string() : name.stem().string() + "_" + sensor.name + name.extension().string();
}

template <typename T>
void append(std::vector<T>& list, std::vector<T>&& more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<log::Observation> observations_of(const hw_points_t& points,
                                              std::span<const log::LandmarkId> identities) {
  std::vector<log::Observation> list;
  list.reserve(points.count);
  for (std::uint64_t i = 0; i < points.count; ++i) {
    const hw_point3_t& point = *hw_point_at(&points, i);
    list.push_back({.landmark = identities.empty() ? log::kNoLandmark : identities[i],
                    .point = {point.x, point.y, point.z},
                    .track = points.track == nullptr ? log::kNoTrack : points.track[i]});
  }
  return list;
}

std::vector<log::PlaneObservation> observations_of(const hw_planes_t& planes,
                                                   std::span<const log::LandmarkId> identities) {
  std::vector<log::PlaneObservation> list;
  list.reserve(planes.count);
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    list.push_back(record::plane_observation(planes, i));
    if (!identities.empty()) list.back().true_plane = identities[i];
  }
  return list;
}

ObservationTables::ObservationTables(const Source& source) {
  for (const host::SensorInfo& sensor : source.sensors()) {
    if (sensor.kind != HW_SAMPLE_POINTS && sensor.kind != HW_SAMPLE_PLANES) continue;
    seen_.push_back({.sensor = sensor.id,
                     .kind = sensor.kind,
                     .file = file_of(sensor, source.sensors().size() == 1),
                     .points = log::ObservationLog(source.has_identities(), source.has_tracks()),
                     .planes = log::PlaneObservationLog(source.has_identities())});
  }
}

void ObservationTables::add(std::uint32_t iteration, const SourceFrame& frame) {
  for (Seen& seen : seen_) {
    std::vector<log::Observation> points;
    std::vector<log::PlaneObservation> planes;
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      const hw_sample_t& sample = frame.sample(k);
      if (sample.sensor_id != seen.sensor || sample.kind != seen.kind) continue;
      if (seen.kind == HW_SAMPLE_POINTS)
        append(points,
               observations_of(*static_cast<const hw_points_t*>(sample.payload), frame.identities_of(k)));
      else
        append(planes,
               observations_of(*static_cast<const hw_planes_t*>(sample.payload), frame.identities_of(k)));
    }
    if (seen.kind == HW_SAMPLE_POINTS)
      seen.points.add_frame(iteration, points);
    else
      seen.planes.add_frame(iteration, planes);
  }
}

void ObservationTables::write(const std::filesystem::path& folder) const {
  for (const Seen& seen : seen_) {
    if (seen.kind == HW_SAMPLE_POINTS)
      log::write_observations(folder / seen.file, seen.points);
    else
      log::write_observed_planes(folder / seen.file, seen.planes);
  }
}

}  // namespace hallway::run
