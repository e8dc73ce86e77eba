// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"
#include "host/plugin.hpp"
#include "log/landmarks.hpp"
#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "log/true_planes.hpp"

namespace hallway::run {

/// One iteration of input: what the sensor saw and, for the evaluator alone, what is true.
struct SourceFrame {
  std::int64_t t_ns = 0;
  bool is_of_planes = false;                   ///< what was seen is `planes`; else `observations`
  std::vector<log::Observation> observations;  ///< sensor frame; identities are never shown to a plugin
  std::vector<log::PlaneObservation> planes;   ///< likewise
  bool is_tracked = false;                     ///< the sensor follows its points: Observation::track counts
  std::optional<Pose> T_world_body;            ///< where known
  bool orientation_known = true;               ///< false: only the position of T_world_body is meant

  /// Replaces `ids` by the true landmark or plane of each thing that was seen, in their order.
  void identities(std::vector<log::LandmarkId>& ids) const {
    ids.clear();
    for (const log::Observation& seen : observations) ids.push_back(seen.landmark);
    for (const log::PlaneObservation& seen : planes) ids.push_back(seen.true_plane);
  }
};

/// Where a run's input comes from: a simulator or a log. A frame is a pure function of its number.
class Source {
 public:
  virtual ~Source() = default;

  /// How many frames there are.
  virtual std::uint32_t iterations() const = 0;
  /// Replaces `frame` by frame `iteration`, below iterations().
  virtual void read(std::uint32_t iteration, SourceFrame& frame) = 0;
  /// The one sensor.
  virtual const host::SensorInfo& sensor() const = 0;
  /// Whether the observations name their true landmarks or planes.
  virtual bool has_identities() const = 0;
  /// Whether the sensor follows its points in any frame.
  virtual bool has_tracks() const { return false; }
  /// Where the true landmarks are (world), if that is known.
  virtual const std::optional<std::vector<log::Landmark>>& true_landmarks() const = 0;
  /// Where the true planes are (world), if that is known.
  virtual const std::optional<std::vector<log::TruePlane>>& true_planes() const {
    static const std::optional<std::vector<log::TruePlane>> kNone;
    return kNone;
  }
};

}  // namespace hallway::run
