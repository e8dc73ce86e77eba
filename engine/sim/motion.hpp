// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sense/bump_sensor.hpp"
#include "sense/trajectory.hpp"

namespace hallway::sim {

/// How a robot moves, for its sensors. Times are up to that of the present frame, as far back as sensors need them.
class Motion : public sense::Trajectory {
 public:
  /// What the body touched after one time and until another.
  virtual std::vector<sense::BumpContact> contacts_in(std::int64_t after_ns, std::int64_t until_ns) const = 0;
  /// The way of each rim since time 0; as many as the drive has wheels. Metres.
  virtual std::vector<double> wheel_travel_at(std::int64_t t_ns) const = 0;
};

}  // namespace hallway::sim
