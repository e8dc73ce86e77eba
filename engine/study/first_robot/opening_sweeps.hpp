// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "map/materials.hpp"
#include "sense/sonar_sensor.hpp"

namespace hallway::study {

// Sweeps of a sonar at openings of which is known what they lead to (thesis 2.2.4, figures 11 and 12). The frame of an opening: the followed wall lies along x and
// ends at the origin; the robot is above it (y > 0), looks along x and has the opening on its right.

/// What an opening leads to.
enum class OpeningKind : std::uint8_t {
  kCovered,  ///< nowhere: a cabinet stands in it that infrared does not see
  kRoom,
  kHallway,
};
inline constexpr std::array kOpeningKinds{OpeningKind::kCovered, OpeningKind::kRoom, OpeningKind::kHallway};

/// "covered", "room", "hallway".
std::string name_of(OpeningKind kind);

/// An upright box from the floor to above the sonar.
struct PlanBox {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  bool is_wall = true;  ///< else furniture
};

/// An opening, and where the robot stands at it.
struct LabelledOpening {
  OpeningKind kind = OpeningKind::kRoom;
  double width_m = 0.9;  ///< of the opening, along the wall
  double depth_m =
      2.0;  ///< from the wall's line to the end of what is behind; of what covers it, to its front
  double across_m = 2.0;  ///< width of the room or hallway behind
  bool is_cluttered = false;
  double wall_m = 0.47;          ///< distance of the sonar from the wall's line
  double along_m = 0.47;         ///< way of the sonar past the wall's end
  double slant_rad = 0.0;        ///< heading of the robot, to the left of the wall's direction
  double reckoned_rad = 0.0;     ///< what the robot takes its heading for
  std::vector<PlanBox> boxes{};  ///< all that reflects sound, in the frame of the opening
};

/// An opening of a kind. Rooms are 1.3 to 4.5 m deep and have doorways of 0.8 to 1 m; hallways are 1.2 to 2 m wide and 3.8 to 12 m long, one in five ends after
/// 2.6 to 4.8 m; what covers an opening is up to 0.3 m behind the wall's line. The robot stands up to 8 degrees slanted, and knows its heading to 2 degrees (one
/// sigma). The same seed and kind give the same opening.
LabelledOpening make_opening(OpeningKind kind, std::uint64_t seed);

/// A sonar, and what it is said of the surfaces of an office.
struct OpeningSonar {
  sense::SonarSpec sonar{};
  sense::SurfaceMaterial wall{};
  sense::SurfaceMaterial furniture{};
};

/// The sonar "sonar" of a scenario, with the scenario's walls and cabinets. Throws Error{kBadInput} where it has none, and what sim::load_scenario() throws.
OpeningSonar sonar_of_scenario(const std::filesystem::path& scenario);

/// One ping of a sweep.
struct HeardPing {
  double direction_rad = 0.0;                                ///< body frame, from forward to the left
  double range_m = std::numeric_limits<double>::infinity();  ///< infinite: no echo
};

/// What a robot that stands at an opening hears.
struct LabelledSweep {
  std::uint64_t seed = 0;
  bool faults = false;
  LabelledOpening opening{};
  std::vector<HeardPing> pings{};

  /// Direction into the opening, as the robot reckons it: body frame.
  double into_rad() const;
};

/// One sweep at an opening. O(pings * rays of a beam).
LabelledSweep sweep_opening(const LabelledOpening& opening, const OpeningSonar& sonar, std::uint64_t seed);

/// Sweeps at `each` openings of each kind, by kind, then by seed. The same on any number of threads.
/// @param first_seed  of the first opening of each kind
std::vector<LabelledSweep> sweep_openings(std::uint32_t each, std::uint64_t first_seed,
                                          const OpeningSonar& sonar, unsigned threads);

}  // namespace hallway::study
