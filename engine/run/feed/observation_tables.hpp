// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
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

/// What the sensors of a run saw, as tables that replay reads: observations.csv of a sensor of points, observed_planes.csv of one of planes. Where there
/// are several sensors, the name of each stands in that of its table: observations_NAME.csv. Other kinds have no table.
class ObservationTables {
 public:
  explicit ObservationTables(const Source& source);

  /// Frames in their order.
  void add(std::uint32_t iteration, const SourceFrame& frame);
  /// Throws Error{kIo}.
  void write(const std::filesystem::path& folder) const;

 private:
  /// What one sensor saw.
  struct Seen {
    std::uint32_t sensor = 0;  ///< id
    std::uint32_t kind = 0;
    std::string file;
    log::ObservationLog points;
    log::PlaneObservationLog planes;
  };

  std::vector<Seen> seen_;
};

}  // namespace hallway::run
