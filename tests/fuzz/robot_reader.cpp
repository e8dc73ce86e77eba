// SPDX-License-Identifier: MIT
//
// The bytes as a robot file. Whatever they are, the outcome is an Error that names the file, or a body that has a height, zones within it, and keys whose lines
// are in the file; the same after it was written and read.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "map/check.hpp"
#include "map/reader.hpp"
#include "map/robot_file.hpp"
#include "map/writer.hpp"

namespace {

using namespace hallway;

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_body(const map::RobotBody& body) {
  demand(std::isfinite(body.bottom_m) && std::isfinite(body.top_m) && body.bottom_m < body.top_m);
  if (body.is_cylinder()) {
    demand(std::isfinite(body.radius_m) && body.radius_m > 0.0);
    return;
  }
  demand(body.vertices.size() >= 4);
  for (const Vec3& corner : body.vertices) demand(corner.allFinite());
}

void check_keys(const std::vector<map::RobotKey>& keys) {
  for (const map::RobotKey& key : keys) demand(!key.key.empty() && key.line > 0);
}

void check_robot(const map::RobotFile& robot) {
  check_body(robot.body);
  for (const map::BumpZone& zone : robot.zones) {
    demand(!zone.name.empty() && zone.line > 0);
    demand(std::isfinite(zone.bottom_m) && std::isfinite(zone.top_m));
  }
  check_keys(robot.robot);
  check_keys(robot.drive);
  demand(robot.has_drive || (robot.robot.empty() && robot.drive.empty()));
  for (const map::RobotSensor& sensor : robot.sensors) check_keys(sensor.keys);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const map::Document document = map::parse(text, "fuzz.map");
    for (const map::Finding& finding : map::check(document)) demand(!finding.message.empty());
    map::RobotFile robot;
    try {
      robot = map::read_robot(document);
    } catch (const Error& error) {
      demand(std::string_view(error.what()).find("fuzz.map") != std::string_view::npos);
      return 0;
    }
    check_robot(robot);
    const map::RobotFile again = map::read_robot(map::parse(map::print(document), "fuzz.map"));
    demand(again.zones.size() == robot.zones.size() && again.sensors.size() == robot.sensors.size());
    demand(again.body.bottom_m == robot.body.bottom_m && again.body.top_m == robot.body.top_m);
    demand(again.drive.size() == robot.drive.size() && again.robot.size() == robot.robot.size());
  } catch (const Error&) {  // no map
    return 0;
  }
  return 0;
}
