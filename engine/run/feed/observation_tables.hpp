// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// The rows of a sample of points.
/// @param identities  of its elements, or none
std::vector<log::Observation> observations_of(const hw_points_t& points,
                                              std::span<const log::LandmarkId> identities);
/// The rows of a sample of planes, with hulls, without members.
std::vector<log::PlaneObservation> observations_of(const hw_planes_t& planes,
                                                   std::span<const log::LandmarkId> identities);

/// Writes what the sensors of a run saw while it goes on, as tables that replay reads: observations.csv of a sensor of points, observed_planes.csv of one of planes. Where there
/// are several sensors, the name of each stands in that of its table: observations_NAME.csv. Other kinds have no table. All functions throw Error{kIo}.
class ObservationTables {
 public:
  ObservationTables(const std::filesystem::path& folder, const Source& source);

  /// Frames in their order.
  void add(std::uint32_t iteration, const SourceFrame& frame);
  /// No more frames come.
  void close();

 private:
  template <typename File>
  struct Table {
    std::uint32_t sensor = 0;  ///< id
    std::unique_ptr<File> file;
  };

  std::vector<Table<log::ObservationFile>> points_;
  std::vector<Table<log::ObservedPlaneFile>> planes_;
};

}  // namespace hallway::run
