// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
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

/// What is known of a source beside its frames.
struct SourceFacts {
  host::SensorInfo sensor{};    ///< the one sensor
  bool has_identities = false;  ///< whether the observations name their true landmarks or planes
  bool has_tracks = false;      ///< whether the sensor follows its points in any frame
  std::optional<std::vector<log::Landmark>> true_landmarks{};  ///< world, where that is known
  std::optional<std::vector<log::TruePlane>> true_planes{};    ///< likewise
};

/// Where a run's input comes from: a simulator or a log. A frame is a pure function of its number.
class Source {
 public:
  explicit Source(SourceFacts facts = {}) : facts_(std::move(facts)) {}
  virtual ~Source() = default;

  /// How many frames there are.
  virtual std::uint32_t iterations() const = 0;
  /// Replaces `frame` by frame `iteration`, below iterations().
  virtual void read(std::uint32_t iteration, SourceFrame& frame) = 0;

  const SourceFacts& facts() const { return facts_; }
  const host::SensorInfo& sensor() const { return facts_.sensor; }
  bool has_identities() const { return facts_.has_identities; }
  bool has_tracks() const { return facts_.has_tracks; }
  const std::optional<std::vector<log::Landmark>>& true_landmarks() const { return facts_.true_landmarks; }
  const std::optional<std::vector<log::TruePlane>>& true_planes() const { return facts_.true_planes; }

 protected:
  SourceFacts facts_;
};

}  // namespace hallway::run
