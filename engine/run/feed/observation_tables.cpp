// SPDX-License-Identifier: MIT
#include "run/feed/observation_tables.hpp"

#include <hallway/planes.h>

#include <iterator>
#include <utility>

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

/// The rows of all samples of a sensor in a frame.
template <typename Samples, typename Row>
std::vector<Row> seen_by(const SourceFrame& frame, std::uint32_t kind, std::uint32_t sensor) {
  std::vector<Row> rows;
  for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
    const hw_sample_t& sample = frame.sample(k);
    if (sample.sensor_id != sensor || sample.kind != kind) continue;
    std::vector<Row> more =
        observations_of(*static_cast<const Samples*>(sample.payload), frame.identities_of(k));
    if (rows.empty())
      rows = std::move(more);
    else
      rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return rows;
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

ObservationTables::ObservationTables(const std::filesystem::path& folder, const Source& source) {
  for (const host::SensorInfo& sensor : source.sensors()) {
    const std::filesystem::path file = folder / file_of(sensor, source.sensors().size() == 1);
    if (sensor.kind == HW_SAMPLE_POINTS)
      points_.push_back({sensor.id, std::make_unique<log::ObservationFile>(file, source.has_identities(),
                                                                           source.has_tracks())});
    if (sensor.kind == HW_SAMPLE_PLANES)
      planes_.push_back({sensor.id, std::make_unique<log::ObservedPlaneFile>(file, source.has_identities())});
  }
}

void ObservationTables::add(std::uint32_t iteration, const SourceFrame& frame) {
  for (const auto& table : points_)
    table.file->add_frame(iteration,
                          seen_by<hw_points_t, log::Observation>(frame, HW_SAMPLE_POINTS, table.sensor));
  for (const auto& table : planes_)
    table.file->add_frame(iteration,
                          seen_by<hw_planes_t, log::PlaneObservation>(frame, HW_SAMPLE_PLANES, table.sensor));
}

void ObservationTables::close() {
  for (const auto& table : points_) table.file->close();
  for (const auto& table : planes_) table.file->close();
}

}  // namespace hallway::run
