// SPDX-License-Identifier: MIT
#include "map/entities.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/text.hpp"
#include "map/entity_keys.hpp"

namespace hallway::map {
namespace {

constexpr double kMaxPointsPerM2 = 1e6;
constexpr double kMaxPointsPer100m = 1e6;
constexpr double kMaxCloudReach_m = 1e5;
constexpr double kMaxSpeed_m_s = 1e3;
constexpr std::int64_t kMaxGroups = 1'000'000;
constexpr std::int64_t kUsualGroups = 4;

/// The keys that say which points move, and how.
void read_motion(const EntityKeys& keys, LandmarkCloud& cloud) {
  cloud.moving_share = keys.number_or("moving_share", 0.0, 0.0, 1.0);
  cloud.speed_m_s = keys.number_or("speed", 1.0, 0.0, kMaxSpeed_m_s);
  if (keys.has("motion")) {
    const std::string motion = keys.text("motion");
    if (motion != "independent" && motion != "group") {
      throw keys.error("`motion` is `" + printable(motion, 60) + "`; it must be independent or group",
                       "motion");
    }
    if (motion == "group") cloud.motion = CloudMotion::kGroup;
  }
  const std::int64_t groups = keys.has("groups") ? keys.integer("groups") : kUsualGroups;
  if (groups < 1 || groups > kMaxGroups) {
    throw keys.error("`groups` must be a whole number from 1 to " + std::to_string(kMaxGroups), "groups");
  }
  cloud.groups = static_cast<std::uint32_t>(groups);
}

/// "`hall`, `door` and an unnamed one".
std::string list_of(const std::vector<RobotStart>& starts) {
  constexpr std::size_t kMost = 20;
  if (starts.empty()) return "none";
  std::string out;
  for (std::size_t i = 0; i < std::min(starts.size(), kMost); ++i) {
    const std::string& name = starts[i].name;
    out += (i == 0 ? "" : ", ") + (name.empty() ? "an unnamed one" : "`" + printable(name, 60) + "`");
  }
  return starts.size() > kMost ? out + ", …" : out;
}

Error second_start(const EntityKeys& keys, const std::string& name, int first_line) {
  const std::string which = name.empty() ? "without a name" : "named `" + printable(name, 60) + "`";
  return keys.error("a second robot start " + which + "; the first is at line " + std::to_string(first_line),
                    "name");
}

Error reserved_start(const EntityKeys& keys) {
  return keys.error("no robot start may be named `free`: scenarios mean any free place by it", "name");
}

}  // namespace

std::vector<RobotStart> robot_starts(const Document& document) {
  std::vector<RobotStart> starts;
  std::map<std::string, int> lines;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_robot_start") continue;
    const EntityKeys keys(document, entity);
    keys.refuse_unknown();
    RobotStart start;
    if (keys.has("name")) start.name = keys.text("name");
    const auto [first, is_new] = lines.emplace(start.name, entity.line);
    if (!is_new) throw second_start(keys, first->first, first->second);
    if (start.name == kFreeStart) throw reserved_start(keys);
    start.T_world_body = {from_yaw_pitch_roll(keys.angle(), 0.0, 0.0), keys.origin_m()};
    start.entity = keys.index();
    start.line = entity.line;
    starts.push_back(std::move(start));
  }
  return starts;
}

std::optional<RobotStart> default_robot_start(const Document& document) {
  std::vector<RobotStart> starts = robot_starts(document);
  if (starts.size() == 1) return std::move(starts.front());
  const auto unnamed = std::ranges::find(starts, std::string(), &RobotStart::name);
  return unnamed == starts.end() ? std::nullopt : std::optional(std::move(*unnamed));
}

std::optional<RobotStart> find_robot_start(const Document& document, std::string_view name) {
  const std::vector<RobotStart> starts = robot_starts(document);
  if (!name.empty()) {
    const auto found = std::ranges::find(starts, name, &RobotStart::name);
    if (found != starts.end()) return *found;
    std::vector<std::string> names;
    for (const RobotStart& start : starts) names.push_back(start.name);
    throw Error(ErrorCode::kBadInput,
                "the map has no robot start `" + printable(name, 60) + "`" + suggestion(name, names) +
                    "; it has " + list_of(starts),
                {document.file, 0, {}});
  }
  if (auto start = default_robot_start(document)) return start;
  if (starts.empty()) return std::nullopt;
  throw Error(ErrorCode::kBadInput,
              "the map has several robot starts, and none is chosen: " + list_of(starts),
              {document.file, starts.front().line, {}});
}

std::vector<LandmarkCloud> landmark_clouds(const Document& document) {
  std::vector<LandmarkCloud> clouds;
  std::set<std::string> names;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != "hw_landmark_cloud") continue;
    const EntityKeys keys(document, entity);
    keys.refuse_unknown();
    LandmarkCloud cloud;
    cloud.name = keys.text("name");
    cloud.path = keys.text("path");
    cloud.per_100m = keys.number("per_100m", 0.0, kMaxPointsPer100m);
    cloud.sideways_m = keys.number("sideways_m", 0.0, kMaxCloudReach_m);
    cloud.height_m = keys.number("height_m", 0.0, kMaxCloudReach_m);
    cloud.seed = keys.seed_or("seed", 0);
    read_motion(keys, cloud);
    cloud.entity = keys.index();
    cloud.line = entity.line;
    if (!names.insert(cloud.name).second) {
      throw keys.error("a second landmark cloud named `" + printable(cloud.name, 60) + "`", "name");
    }
    clouds.push_back(std::move(cloud));
  }
  return clouds;
}

FacePoints face_points(const Document& document) {
  const Entity* world = document.worldspawn();
  if (!world) return {};
  const EntityKeys keys(document, *world);
  return {keys.number_or("_points_per_m2", 0.0, 0.0, kMaxPointsPerM2), keys.seed_or("_point_seed", 0)};
}

}  // namespace hallway::map
