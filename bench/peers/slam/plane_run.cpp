// SPDX-License-Identifier: MIT
#include "plane_run.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "log/true_planes.hpp"

namespace hallway::peers {
namespace {

constexpr double kFarthestEnd_m = 0.3;  // of a piece from the corner that it is

struct Sensor {
  Pose3 T_body_sensor{};
  double half_fov_rad = 0.0;
  double max_depth_m = 0.0;
  bool bounds_sides = false;
  bool occlusion = true;
};

double heading_of(double w, double z) {
  return 2.0 * std::atan2(z, w);
}

/// p, of the frame that the pose is in, in the pose's own frame.
Point2 seen_from(const Pose3& pose, const Point2& p) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  const double x = p[0] - pose[0], y = p[1] - pose[1];
  return {c * x + s * y, -s * x + c * y};
}

double cross(const Point2& a, const Point2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

Point2 less(const Point2& a, const Point2& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

/// Whether a->b lies between the origin and p.
bool hides(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 way = less(b, a);
  const double across = cross(p, way);
  if (std::abs(across) < 1e-12) return false;
  const double share = cross(a, way) / across;  // of the way to p
  const double along = cross(a, p) / across;    // of a->b
  return share > 1e-9 && share < 1.0 - 1e-6 && along > -1e-9 && along < 1.0 + 1e-9;
}

bool in_view(const Sensor& sensor, const Point2& p) {
  if (std::abs(std::atan2(p[1], p[0])) > sensor.half_fov_rad) return false;
  const double depth = sensor.bounds_sides ? std::hypot(p[0], p[1]) : p[0];
  return sensor.max_depth_m <= 0.0 || depth <= sensor.max_depth_m;
}

/// Says which ends of a frame's pieces are corners. `walls`: as the sensor sees them.
void judge(const Sensor& sensor, const std::vector<Facing>& walls, std::vector<SeenWall>& frame) {
  for (SeenWall& seen : frame) {
    for (int k = 0; k < 2; ++k) {
      const Point2 corner = k == 0 ? walls[seen.wall].a : walls[seen.wall].b;
      const auto distance = [&](const SeenWall& other) {
        const Point2 off = less(k == 0 ? other.piece.a : other.piece.b, corner);
        return std::hypot(off[0], off[1]);
      };
      bool is_corner = in_view(sensor, corner) && distance(seen) < kFarthestEnd_m;
      for (std::size_t w = 0; w < walls.size() && is_corner && sensor.occlusion; ++w)
        is_corner = w == seen.wall || !hides(walls[w].a, walls[w].b, corner);
      // Of several pieces of one wall it is the end of the nearest.
      for (const SeenWall& other : frame)
        is_corner = is_corner && (other.wall != seen.wall || distance(other) >= distance(seen));
      seen.corner[k] = is_corner;
    }
  }
}

std::string setting(const nlohmann::json& run, const std::string& sensor, const std::string& name,
                    const std::string& otherwise) {
  for (const auto& row : run.at("settings")) {
    if (row.at("key") == "sensor." + sensor + "." + name) return row.at("value").get<std::string>();
  }
  return otherwise;
}

Sensor read_sensor(const nlohmann::json& run, PlaneRun& result) {
  for (const auto& json : run.at("sensors")) {
    if (json.at("kind") != "planes") continue;
    const auto name = json.at("name").get<std::string>();
    const auto& t = json.at("T_body_sensor").at("position_m");
    const auto& q = json.at("T_body_sensor").at("orientation_wxyz");
    Sensor sensor;
    sensor.T_body_sensor = {t[0].get<double>(), t[1].get<double>(), heading_of(q[0], q[3])};
    sensor.half_fov_rad = 0.5 * json.at("horizontal_fov_rad").get<double>();
    sensor.max_depth_m = json.at("max_range_m").get<double>();
    sensor.bounds_sides = setting(run, name, "bounded_sides", "false") == "true";
    sensor.occlusion = setting(run, name, "occlusion", "true") == "true";
    result.noise_m = std::stod(setting(run, name, "noise_m", "0"));
    result.noise_angle_rad = std::stod(setting(run, name, "noise_angle_deg", "0")) * std::numbers::pi / 180.0;
    result.noise_end_m = std::stod(setting(run, name, "noise_end_m", "0"));
    return sensor;
  }
  throw Error(ErrorCode::kBadInput, "the run has no sensor of planes");
}

}  // namespace

PlaneRun read_plane_run(const std::filesystem::path& folder) {
  PlaneRun run;
  const auto json = nlohmann::json::parse(read_file(folder / "run.json"));
  const Sensor sensor = read_sensor(json, run);
  std::map<log::LandmarkId, std::size_t> index;
  for (const log::TruePlane& wall : log::read_true_planes(folder / "true_walls.csv")) {
    index[wall.id] = run.walls.size();
    run.walls.push_back(
        {{wall.corners_m[0][0], wall.corners_m[0][1]}, {wall.corners_m[1][0], wall.corners_m[1][1]}});
  }
  const std::string file = (folder / "observed_planes.csv").string();
  const log::ReadPlaneObservations read = log::parse_observed_planes(read_file(file), file);
  if (read.damage) throw Error(ErrorCode::kBadInput, log::describe(*read.damage, read.log, file));
  for (const log::IterationPose& pose : log::read_poses(folder / "truth_poses.csv")) {
    const Pose3 T{pose.position_m[0], pose.position_m[1],
                  heading_of(pose.orientation[0], pose.orientation[3])};
    const Point2 at = placed(T, {sensor.T_body_sensor[0], sensor.T_body_sensor[1]});
    run.poses.push_back({at[0], at[1], T[2] + sensor.T_body_sensor[2]});
  }
  for (std::uint32_t i = 0; i < run.poses.size(); ++i) {
    std::vector<SeenWall>& frame = run.frames.emplace_back();
    if (i >= read.log.iterations()) continue;
    for (const log::PlaneObservation& seen : read.log.frame(i)) {
      const auto wall = index.find(seen.true_plane);
      if (wall == index.end()) continue;
      const auto& corners = seen.corners_m;
      frame.push_back({wall->second, {{corners[0][0], corners[0][1]}, {corners[1][0], corners[1][1]}}});
    }
    std::vector<Facing> local;
    for (const Facing& wall : run.walls)
      local.push_back({seen_from(run.poses[i], wall.a), seen_from(run.poses[i], wall.b)});
    judge(sensor, local, frame);
  }
  return run;
}

}  // namespace hallway::peers
