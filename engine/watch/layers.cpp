// SPDX-License-Identifier: MIT
#include "watch/layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "watch/plugin_layers.hpp"

namespace hallway::watch {
namespace {

/// More beams than this fill the canvas, so that nothing else is seen.
constexpr std::size_t kMostBeams = 40;
/// A body of fewer dots is not seen beside the arrow.
constexpr double kLeastBodyDots = 5.0;
/// For so long the arrow of a command shows where it leads.
constexpr double kCommand_s = 2.0;
/// For so long what single rays met is shown.
constexpr std::int64_t kEchoes_ns = 3'000'000'000;
/// Contacts of the last second are larger.
constexpr std::int64_t kFresh_ns = 1'000'000'000;

std::optional<Pose> robot_pose(const Subject& subject) {
  return pose_shown(subject.moment, subject.past.place(subject.moment.iteration));
}

Vec2 on_ground(const Pose& pose, const Vec3& place) {
  return (pose * place).head<2>();
}

void draw_plan(const Subject& subject, const Drawing& drawing) {
  for (const Line& line : subject.scene.plan) drawing.line(line, Role::kWall);
}

void draw_landmarks(const Subject& subject, const Drawing& drawing) {
  for (const Vec2& place : subject.scene.landmarks) drawing.dot(place, Role::kLandmark);
}

void draw_beams(const Subject& subject, const Drawing& drawing) {
  const std::optional<Pose> pose = robot_pose(subject);
  if (!pose) return;
  const auto draw = [&](const Vec3& from, const Vec3& to) {
    drawing.line({on_ground(*pose, from), on_ground(*pose, to)}, Role::kRay, 2);
  };
  const std::vector<Ray>& rays = subject.moment.rays;
  const std::size_t every = rays.size() / kMostBeams + 1;
  for (std::size_t i = 0; i < rays.size(); i += every) draw(rays[i].from, rays[i].to);
}

void draw_seen(const Subject& subject, const Drawing& drawing) {
  const std::int64_t now_ns = subject.moment.t_ns;
  for (const Past::Echo& echo : subject.past.echoes(now_ns - kEchoes_ns, now_ns))
    drawing.dot(echo.place, Role::kSeen);
  const std::optional<Pose> pose = robot_pose(subject);
  if (!pose) return;
  for (const Ray& ray : subject.moment.rays) {
    if (ray.has_return) drawing.dot(on_ground(*pose, ray.to), Role::kSeen);
  }
  for (const Vec3& point : subject.moment.points) drawing.dot(on_ground(*pose, point), Role::kSeen);
  for (const std::vector<Vec3>& outline : subject.moment.outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i)
      drawing.line({on_ground(*pose, outline[i]), on_ground(*pose, outline[(i + 1) % outline.size()])},
                   Role::kSeen);
  }
}

/// Joins places that follow each other; where one is missing, the way is interrupted.
void draw_way(const Drawing& drawing, Role role, std::span<const PastPlace> places,
              std::optional<Vec2> (*place_of)(const PastPlace&)) {
  bool has_last = false;
  Vec2 last = Vec2::Zero();
  for (const PastPlace& one : places) {
    const std::optional<Vec2> next = place_of(one);
    if (next) {
      drawing.line({has_last ? last : *next, *next}, role);
      last = *next;
    }
    has_last = next.has_value();
  }
}

void draw_truth(const Subject& subject, const Drawing& drawing) {
  draw_way(drawing, Role::kTruth, subject.past.places(subject.moment.iteration),
           [](const PastPlace& place) { return place.truth; });
}

void draw_estimate(const Subject& subject, const Drawing& drawing) {
  draw_way(drawing, Role::kEstimate, subject.past.places(subject.moment.iteration),
           [](const PastPlace& place) {
             return place.estimate ? std::optional<Vec2>(place.estimate->t.head<2>()) : std::nullopt;
           });
  const PastPlace* now = subject.past.place(subject.moment.iteration);
  if (now != nullptr && now->estimate) drawing.glyph(now->estimate->t.head<2>(), U'o', Role::kEstimate);
}

void draw_mapped(const Subject& subject, const Drawing& drawing) {
  for (const Line& line : subject.scene.mapped_walls) drawing.line(line, Role::kMapped);
  for (const Vec2& place : subject.scene.mapped) drawing.dot(place, Role::kMapped);
}

void draw_contacts(const Subject& subject, const Drawing& drawing) {
  for (const log::ContactRow& contact : subject.past.contacts(subject.moment.t_ns)) {
    const Vec2 place(contact.position_m[0], contact.position_m[1]);
    const bool is_fresh = contact.t_ns > subject.moment.t_ns - kFresh_ns;
    drawing.glyph(place, is_fresh ? U'X' : U'x', Role::kContact);
  }
  const std::optional<Pose> pose = robot_pose(subject);
  if (!pose) return;
  double radius_m = 0.2;
  for (const Vec2& corner : subject.scene.outline) radius_m = std::max(radius_m, corner.norm());
  for (const Vec3& direction : subject.moment.pressed)
    drawing.glyph(on_ground(*pose, 1.2 * radius_m * direction), U'!', Role::kContact);
}

void draw_command(const Subject& subject, const Drawing& drawing) {
  const std::optional<Pose> pose = robot_pose(subject);
  const auto& obeyed = subject.moment.obeyed;
  if (!pose || !obeyed) return;
  const Vec3 way = kCommand_s * Vec3(obeyed->linear_m_s, obeyed->lateral_m_s, 0.0);
  drawing.line({on_ground(*pose, Vec3::Zero()), on_ground(*pose, way)}, Role::kRobot);
}

/// Towards +x, then counter-clockwise by an eighth of a turn each.
char32_t arrow_of(const Pose& pose, Dots dots) {
  const Vec3 ahead = pose.q * Vec3::UnitX();
  const long eighth = std::lround(std::atan2(ahead.y(), ahead.x()) * 4.0 / std::numbers::pi);
  const auto index = static_cast<std::size_t>((eighth + 8) % 8);
  return (dots == Dots::kAscii ? U">/^\\</v\\" : U"→↗↑↖←↙↓↘")[index];
}

void draw_robot(const Subject& subject, const Drawing& drawing) {
  const std::optional<Pose> pose = robot_pose(subject);
  if (!pose) return;
  const std::vector<Vec2>& outline = subject.scene.outline;
  double size = 0.0;
  for (const Vec2& corner : outline) size = std::max(size, (drawing.at(corner) - drawing.at(-corner)).norm());
  for (std::size_t i = 0; size >= kLeastBodyDots && i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    drawing.line({on_ground(*pose, Vec3(a.x(), a.y(), 0.0)), on_ground(*pose, Vec3(b.x(), b.y(), 0.0))},
                 Role::kRobot);
  }
  const bool has_heading = !subject.moment.T_world_body || subject.moment.orientation_known;
  drawing.glyph(pose->t.head<2>(), has_heading ? arrow_of(*pose, drawing.dots) : U'@', Role::kRobot);
}

constexpr std::array kLayers{
    Layer{'2', "beams", "beams of range sensors", &draw_beams},
    Layer{'4', "landmarks", "true landmarks", &draw_landmarks, true},
    Layer{'1', "plan", "the plan, cut at the sensors' height", &draw_plan},
    Layer{'8', "map", "what a plugin mapped in the end", &draw_mapped, true},
    Layer{'5', "way", "where the robot was", &draw_truth},
    Layer{'3', "seen", "what the sensors see, single rays for 3 s", &draw_seen},
    Layer{'6', "estimate", "where a plugin believes it was", &draw_estimate},
    Layer{'t', "topology", "a plugin's topological map", &draw_topology},
    Layer{'w', "drawing", "what a plugin draws", &draw_drawing},
    Layer{'7', "contacts", "contacts (x), pressed zones (!)", &draw_contacts},
    Layer{'9', "command", "the command, for two seconds", &draw_command},
    Layer{'0', "robot", "the robot", &draw_robot},
};

}  // namespace

void Drawing::text(Vec2 dots_in_cell, std::string_view text, Role role) const {
  for (const char32_t glyph : glyphs_of(text)) {
    canvas.glyph(dots_in_cell, dots == Dots::kAscii && glyph >= 0x80 ? U'?' : glyph, role);
    dots_in_cell.x() += shape_of(dots).columns;
  }
}

std::span<const Layer> layers() {
  return kLayers;
}

ShownLayers::ShownLayers(const Scene& scene) {
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    if (kLayers[i].is_of_points && !scene.plan.empty()) hidden_ |= 1u << i;
  }
}

bool ShownLayers::toggle(int key) {
  const auto found = std::ranges::find(kLayers, key, [](const Layer& layer) { return int{layer.key}; });
  if (found == kLayers.end()) return false;
  hidden_ ^= 1u << (found - kLayers.begin());
  return true;
}

void draw_layers(const Subject& subject, const ShownLayers& shown, const Drawing& drawing) {
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    if (shown.has(i)) kLayers[i].draw(subject, drawing);
  }
}

}  // namespace hallway::watch
