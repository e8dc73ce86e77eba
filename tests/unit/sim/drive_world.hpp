// SPDX-License-Identifier: MIT
// A robot with a drive in a room of 10 m by 10 m, whose floor is at z = 0.
#pragma once

#include <memory>
#include <string>

#include "sim/driven_robot.hpp"
#include "sim/simulator.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim::test {

using namespace hallway::test;

inline std::string room() {
  return block(-500, -500, -20, 500, 500, 0) + block(-520, -500, 0, -500, 500, 250) +
         block(500, -500, 0, 520, 500, 250) + block(-500, -520, 0, 500, -500, 250) +
         block(-500, 500, 0, 500, 520, 250);
}

inline std::string start_at(const std::string& origin, const std::string& name = "") {
  const std::string named = name.empty() ? "" : "\"name\" \"" + name + "\"\n";
  return "{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"" + origin + "\"\n" + named + "}\n";
}

inline std::string driven_text(const std::string& robot = "",
                               const std::string& drive = "kind = 'differential'\n",
                               const std::string& more = "") {
  return "map = \"small.map\"\nseed = 5\nsteps = 400\nperiod_s = 0.1\n[robot]\nradius_m = 0.2\nbottom_m = "
         "0.03\n"
         "top_m = 0.5\n" +
         robot + "[robot.drive]\n" + drive +
         "[sensor.bumper]\nkind = 'bump'\n[sensor.wheels]\nkind = 'encoders'\n" + more;
}

/// A simulator and its robot.
struct DriveWorld {
  explicit DriveWorld(const std::string& scenario, const std::string& entities = start_at("0 0 50")) {
    folder.write("small.map", map_text(room(), entities));
    folder.write("commands.csv", "t_ns,forward_m_s,angular_rad_s\n0,0.5,0\n5000000000,1e300,0\n");
    simulator = std::make_unique<Simulator>(load_scenario(folder.write("s.toml", scenario)), 1,
                                            trace::Backend::kBruteForce);
    robot =
        std::make_unique<DrivenRobot>(*simulator->driven_world(), simulator->scenario(), simulator->path());
  }

  Pose pose() const { return robot->pose_at(std::int64_t{robot->frame()} * 100'000'000); }

  TempFolder folder;
  std::unique_ptr<Simulator> simulator;
  std::unique_ptr<DrivenRobot> robot;
};

inline DriveAnswer forward(double m_s, double left_m_s = 0.0) {
  return {.command = drive::Command{.forward_m_s = m_s, .lateral_m_s = left_m_s}};
}

}  // namespace hallway::sim::test
