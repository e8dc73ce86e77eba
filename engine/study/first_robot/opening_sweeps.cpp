// SPDX-License-Identifier: MIT
#include "study/first_robot/opening_sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "sense/standing_body.hpp"
#include "sim/scenario.hpp"
#include "trace/scene.hpp"

namespace hallway::study {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
constexpr double kReach_m = 9.0;      // of the followed hallway, to both sides of the opening
constexpr double kThickWall_m = 0.3;  // thickness of walls that nothing is behind
constexpr double kBoxHeight_m = 2.4;  // of the boxes: above and below the beam at every range that matters

/// Numbers of one opening, one after the other.
class OpeningDice {
 public:
  OpeningDice(OpeningKind kind, std::uint64_t seed)
      : random_(seed, stream_id("study.opening")), kind_(static_cast<std::uint32_t>(kind)) {}

  double within(double low, double high) { return random_.uniform(kind_, next_++, low, high); }
  double normal(double sigma) { return sigma * random_.normal(kind_, next_++); }
  bool chance(double share) { return random_.uniform(kind_, next_++) < share; }

 private:
  Random random_;
  std::uint32_t kind_;
  std::uint64_t next_ = 0;
};

PlanBox wall(double x_low, double x_high, double y_low, double y_high) {
  return {{x_low, y_low}, {x_high, y_high}, true};
}

/// The hallway in which the robot stands: the followed wall before and behind the opening, and the wall across.
void add_own_hallway(OpeningDice& dice, double wall_thickness_m, LabelledOpening& opening) {
  const double over_m = dice.within(1.2, 2.0);
  opening.boxes.push_back(wall(-kReach_m, 0.0, -wall_thickness_m, 0.0));
  opening.boxes.push_back(wall(opening.width_m, kReach_m, -wall_thickness_m, 0.0));
  opening.boxes.push_back(wall(-kReach_m, kReach_m, over_m, over_m + kThickWall_m));
}

/// Walls round a rectangle behind the wall's line, open towards it.
void add_enclosure(double x_low, double x_high, double depth_m, LabelledOpening& opening) {
  opening.boxes.push_back(wall(x_low - kThickWall_m, x_low, -depth_m, 0.0));
  opening.boxes.push_back(wall(x_high, x_high + kThickWall_m, -depth_m, 0.0));
  opening.boxes.push_back(
      wall(x_low - kThickWall_m, x_high + kThickWall_m, -depth_m - kThickWall_m, -depth_m));
}

/// A desk, cabinet or the like against a side wall or the back wall.
void add_furniture(OpeningDice& dice, double x_low, double x_high, double depth_m, LabelledOpening& opening) {
  const double along = dice.within(0.4, 1.2), deep = dice.within(0.3, 0.6);
  if (dice.chance(0.4)) {  // at the back
    const double x = dice.within(x_low, std::max(x_low, x_high - along));
    opening.boxes.push_back({{x, -depth_m}, {std::min(x + along, x_high), -depth_m + deep}, false});
    return;
  }
  const double y = -dice.within(std::min(0.7, depth_m - 0.3), depth_m - 0.2);
  const double y_low = std::max(y - along, -depth_m);
  if (dice.chance(0.5)) {
    opening.boxes.push_back({{x_low, y_low}, {x_low + deep, y}, false});
  } else {
    opening.boxes.push_back({{x_high - deep, y_low}, {x_high, y}, false});
  }
}

void make_covered(OpeningDice& dice, LabelledOpening& opening) {
  opening.width_m = dice.within(0.4, 1.0);
  opening.depth_m = dice.within(-0.02, 0.3);
  opening.across_m = opening.width_m;
  add_own_hallway(dice, kThickWall_m + 0.3, opening);
  opening.boxes.push_back({{0.0, -opening.depth_m - 0.3}, {opening.width_m, -opening.depth_m}, false});
}

void make_room(OpeningDice& dice, LabelledOpening& opening) {
  opening.width_m = dice.within(0.8, 1.0);
  opening.depth_m = dice.within(1.3, 4.5);
  const double before_m = dice.within(0.15, 1.2), behind_m = dice.within(0.15, 1.2);
  opening.across_m = opening.width_m + before_m + behind_m;
  add_own_hallway(dice, dice.within(0.1, 0.2), opening);
  add_enclosure(-before_m, opening.width_m + behind_m, opening.depth_m, opening);
  opening.is_cluttered = dice.chance(0.6);
  if (!opening.is_cluttered) return;
  const int pieces = 1 + (dice.chance(0.5) ? 1 : 0) + (dice.chance(0.3) ? 1 : 0);
  for (int i = 0; i < pieces; ++i)
    add_furniture(dice, -before_m, opening.width_m + behind_m, opening.depth_m, opening);
}

void make_hallway(OpeningDice& dice, LabelledOpening& opening) {
  opening.width_m = dice.within(1.2, 2.0);
  opening.depth_m = dice.chance(0.2) ? dice.within(2.6, 4.8) : dice.within(3.8, 12.0);
  opening.across_m = opening.width_m;
  add_own_hallway(dice, kThickWall_m, opening);
  add_enclosure(0.0, opening.width_m, opening.depth_m, opening);
  opening.is_cluttered = dice.chance(0.2);
  if (!opening.is_cluttered) return;
  const double y = -dice.within(0.5, opening.depth_m - 0.6), deep = dice.within(0.1, 0.3);
  const double x = dice.chance(0.5) ? 0.0 : opening.width_m - deep;
  opening.boxes.push_back({{x, y - 0.5}, {x + deep, y}, false});
}

void add_box(const PlanBox& box, trace::TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const double low[3] = {box.low.x(), box.low.y(), -0.5 * kBoxHeight_m};
  const double high[3] = {box.high.x(), box.high.y(), 0.5 * kBoxHeight_m};
  for (unsigned corner = 0; corner < 8; ++corner)
    mesh.vertices.emplace_back((corner & 1u) != 0 ? high[0] : low[0], (corner & 2u) != 0 ? high[1] : low[1],
                               (corner & 4u) != 0 ? high[2] : low[2]);
  static constexpr std::uint32_t kSides[4][4] = {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  for (const auto& side : kSides) {
    mesh.triangles.push_back({first + side[0], first + side[1], first + side[2]});
    mesh.triangles.push_back({first + side[0], first + side[2], first + side[3]});
  }
}

sense::SurfaceMaterial surface(const map::MaterialTable& table, const char* name) {
  return {.name = name, .echo_angle_rad = table.of(name).echo_deg * kRadPerDegree};
}

}  // namespace

std::string name_of(OpeningKind kind) {
  static constexpr const char* kNames[] = {"covered", "room", "hallway"};
  return kNames[static_cast<std::size_t>(kind)];
}

LabelledOpening make_opening(OpeningKind kind, std::uint64_t seed) {
  OpeningDice dice(kind, seed);
  LabelledOpening opening;
  opening.kind = kind;
  opening.wall_m = dice.within(0.38, 0.58);
  opening.along_m = std::clamp(opening.wall_m + dice.normal(0.07), 0.2, 0.7);
  opening.slant_rad = dice.within(-8.0, 8.0) * kRadPerDegree;
  opening.reckoned_rad = opening.slant_rad + dice.normal(2.0) * kRadPerDegree;
  if (kind == OpeningKind::kCovered) make_covered(dice, opening);
  if (kind == OpeningKind::kRoom) make_room(dice, opening);
  if (kind == OpeningKind::kHallway) make_hallway(dice, opening);
  return opening;
}

OpeningSonar sonar_of_scenario(const std::filesystem::path& scenario) {
  const sim::Scenario loaded = sim::load_scenario(scenario);
  for (const sim::SensorSpec& sensor : loaded.sensors) {
    const auto* sonar = std::get_if<sense::SonarSpec>(&sensor);
    if (sonar == nullptr) continue;
    OpeningSonar found{.sonar = *sonar,
                       .wall = surface(loaded.materials, "wall_white"),
                       .furniture = surface(loaded.materials, "black_cabinet")};
    // The mount is level in front of what it pings at; sweep_opening() places it.
    found.sonar.T_body_sensor.t = Vec3::Zero();
    return found;
  }
  throw Error(ErrorCode::kBadInput, "the scenario's robot has no sonar", {scenario.string(), 0, {}});
}

double LabelledSweep::into_rad() const {
  return -0.5 * std::numbers::pi - opening.reckoned_rad;
}

LabelledSweep sweep_opening(const LabelledOpening& opening, const OpeningSonar& sonar, std::uint64_t seed) {
  trace::TriangleMesh mesh;
  std::vector<std::uint16_t> of_triangle;
  for (const PlanBox& box : opening.boxes) {
    add_box(box, mesh);
    of_triangle.resize(mesh.triangles.size(), box.is_wall ? 0 : 1);
  }
  const trace::Scene scene(mesh, trace::Backend::kEmbree);
  const sense::Surfaces surfaces(mesh, {sonar.wall, sonar.furniture}, of_triangle);
  const sense::SonarSensor sensor(sonar.sonar, scene, surfaces, seed);
  const sense::StandingBody body({Quat(Eigen::AngleAxisd(opening.slant_rad, Vec3::UnitZ())),
                                  Vec3(opening.along_m, opening.wall_m, 0.0)});
  sense::SonarReading reading;
  sense::SonarTruth truth;
  sensor.read(static_cast<std::uint32_t>(opening.kind), 0, body, 1, reading, truth);
  LabelledSweep sweep{.seed = seed, .opening = opening};
  const auto& rays = sonar.sonar.pings.rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3 direction = sonar.sonar.T_body_sensor.q * sense::direction_of(rays[i]);
    sweep.pings.push_back({std::atan2(direction.y(), direction.x()), reading.range_m[i]});
  }
  return sweep;
}

std::vector<LabelledSweep> sweep_openings(std::uint32_t each, std::uint64_t first_seed,
                                          const OpeningSonar& sonar, unsigned threads) {
  std::vector<LabelledSweep> sweeps(std::size_t{each} * kOpeningKinds.size());
  parallel_for(sweeps.size(), 8, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const OpeningKind kind = kOpeningKinds[i / each];
      const std::uint64_t seed = first_seed + i % each;
      sweeps[i] = sweep_opening(make_opening(kind, seed), sonar, seed);
    }
  });
  return sweeps;
}

}  // namespace hallway::study
