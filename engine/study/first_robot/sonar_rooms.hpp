// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "study/first_robot/sweep_calibration.hpp"
#include "study/study.hpp"

namespace hallway::study {

// `hallway study sonar-rooms`: calibrates the rule of the first robot that distinguishes a room from a hallway (thesis 2.2.4) and checks it on other openings.

/// What is asked for.
struct SonarRoomsRequest {
  std::uint32_t each =
      400;  ///< openings of each kind, with and without faults each: to fit on, and as many again to check
  std::uint64_t first_seed = 1;  ///< of the openings to fit on; those to check follow
  bool quick = false;
  std::filesystem::path maps{};  ///< with cubicles.toml and cubicles_faults.toml, whose sonar and walls count
  SweepRule rule{};
  SweepRuleParameters present{};  ///< of the plugin, to compare with
  /// No doorway is longer along the wall: the robot drives past what it classifies as a room, and turns back where the wall does not go on within this length.
  double longest_doorway_m = 1.1;
  unsigned threads = 1;
};

struct SonarRoomsResult {
  Calibration calibration{};
  Confusion fitted{};   ///< of the best parameters on the openings that were fitted on
  Confusion checked{};  ///< on the other ones
  Confusion present{};  ///< of the present parameters on the other ones
  Outcome outcome{};
};

/// Name, figures and size, for write_outcome(). It has no plan of runs.
Study sonar_rooms_study();

/// Sweeps, calibrates and checks. Throws what sonar_of_scenario() throws.
SonarRoomsResult study_sonar_rooms(const SonarRoomsRequest& request);

/// A plan of a sweep: what stands there, the robot and its pings (thesis figures 11, 12).
Chart sweep_chart(const LabelledSweep& sweep, const std::string& file, const std::string& figures);

}  // namespace hallway::study
