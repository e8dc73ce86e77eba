// SPDX-License-Identifier: MIT
#include "run/pictures/instant_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "render/colour.hpp"
#include "run/pictures/picture_frame.hpp"
#include "run/pictures/robot_shape.hpp"

namespace hallway::run {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// Of the extent of the picture: how long the arrow of the fastest command is at least, and the radius of the arc.
constexpr double kArrowShare = 0.05;
constexpr double kArcShare = 0.025;
constexpr int kArcSteps = 24;

Vec3 on_body(const Instant& now, const Vec2& place, double z) {
  return now.T_world_body * Vec3(place.x(), place.y(), z);
}

void add_shape(render::Picture& picture, const RobotShape& shape, const Instant& now) {
  render::Patches areas{.colour = render::palette::kTruth, .opacity = 0.35, .label = "robot"};
  render::Segments edges{.colour = render::palette::kInk, .width_px = 1.6};
  for (const double z : {shape.bottom_m, shape.top_m}) {
    std::vector<Vec3>& area = areas.polygons.emplace_back();
    for (std::size_t i = 0; i < shape.corners.size(); ++i) {
      area.push_back(on_body(now, shape.corners[i], z));
      edges.pairs.push_back({area.back(), on_body(now, shape.corners[(i + 1) % shape.corners.size()], z)});
    }
  }
  if (!shape.is_round) {
    for (const Vec2& corner : shape.corners)
      edges.pairs.push_back({on_body(now, corner, shape.bottom_m), on_body(now, corner, shape.top_m)});
  }
  // Where the front is: a line from the middle.
  double front = 0.0;
  for (const Vec2& corner : shape.corners) front = std::max(front, corner.x());
  edges.pairs.push_back(
      {on_body(now, Vec2::Zero(), shape.top_m), on_body(now, Vec2(front, 0.0), shape.top_m)});
  picture.patches.push_back(std::move(areas));
  picture.segments.push_back(std::move(edges));
}

/// Empty before the first.
const log::ObeyedCommand* obeyed_at(const Record& record, std::uint32_t iteration) {
  const auto& obeyed = record.history->obeyed;
  const auto later = std::ranges::upper_bound(obeyed, iteration, {}, &log::ObeyedCommand::iteration);
  return later == obeyed.begin() ? nullptr : &*std::prev(later);
}

double extent_of_world(const Record& record, const render::Picture& picture) {
  const Box frame = frame_of(record, picture.surfaces);
  return frame.isEmpty() ? 1.0 : frame.diagonal().head<2>().norm();
}

/// 1, 2, 5, 10, …: for how many seconds of its fastest command a robot would drive a visible way.
double seconds_shown(const Record& record, double extent_m) {
  double fastest = 0.0;
  for (const log::ObeyedCommand& command : record.history->obeyed)
    fastest = std::max(fastest, std::hypot(command.linear_m_s, command.lateral_m_s));
  double seconds = 1.0;
  for (int i = 0; i < 9 && fastest > 0.0 && fastest * seconds < kArrowShare * extent_m; ++i)
    seconds *= i % 3 == 1 ? 2.5 : 2.0;
  return seconds;
}

/// The barbs of an arrow from `a` to `b`, in the body's plane.
void add_head(render::Segments& lines, const Instant& now, const Vec2& a, const Vec2& b, double size_m) {
  if (!((b - a).norm() > 0.0)) return;
  const Vec2 back = (a - b).normalized() * size_m;
  for (const double angle : {0.45, -0.45}) {
    const Vec2 barb = b + Eigen::Rotation2Dd(angle) * back;
    lines.pairs.push_back({on_body(now, b, 0.0), on_body(now, barb, 0.0)});
  }
}

void add_arc(render::Segments& lines, const Instant& now, double angle, double radius_m) {
  const double swept = std::clamp(angle, -1.9 * std::numbers::pi, 1.9 * std::numbers::pi);
  Vec2 last = Vec2(radius_m, 0.0);
  for (int i = 1; i <= kArcSteps; ++i) {
    const Vec2 next = Eigen::Rotation2Dd(swept * i / kArcSteps) * Vec2(radius_m, 0.0);
    lines.pairs.push_back({on_body(now, last, 0.0), on_body(now, next, 0.0)});
    if (i == kArcSteps) add_head(lines, now, last, next, 0.4 * radius_m);
    last = next;
  }
}

/// Where the robot truly was just before or after a time.
std::optional<Vec3> place_at(const Record& record, std::int64_t t_ns, bool before) {
  const auto later = std::ranges::lower_bound(
      record.truth, t_ns, {}, [](const log::StampedPose& pose) { return nanoseconds(pose.t_s); });
  if (before && later != record.truth.begin()) return to_vec3(std::prev(later)->position_m);
  if (later == record.truth.end()) return std::nullopt;
  return to_vec3(later->position_m);
}

void mark_event(render::Picture& picture, render::Markers& marks, const std::optional<Vec3>& place,
                const std::string& text) {
  if (!place) return;
  marks.positions.push_back(*place);
  picture.labels.push_back({.position = *place, .text = text, .colour = marks.colour});
}

}  // namespace

void add_body(render::Picture& picture, const Record& record, const Instant& now) {
  const std::optional<RobotShape> shape = robot_shape(record.run);
  if (shape) add_shape(picture, *shape, now);
  picture.markers.push_back({.positions = {now.T_world_body.t},
                             .colour = render::palette::kInk,
                             .size_px = 6.0,
                             .label = shape ? "" : "robot"});
}

void add_seen(render::Picture& picture, const Record& record, const Instant& now) {
  render::Markers points{.colour = render::palette::kSensor, .size_px = 4.0, .label = "points in view"};
  render::Segments rays{.colour = render::palette::kSensor, .width_px = 0.8, .opacity = 0.18};
  render::Segments outlines{.colour = render::palette::kSensor, .width_px = 2.2, .label = "planes in view"};
  const std::vector<SeenSample>& seen = record.history->seen;
  const auto first = std::ranges::lower_bound(seen, now.iteration, {}, &SeenSample::iteration);
  for (auto it = first; it != seen.end() && it->iteration == now.iteration; ++it) {
    const SeenSample& sample = *it;
    const Vec3 eye = now.T_world_body * sample.eye;
    for (const Vec3& point : sample.points) {
      points.positions.push_back(now.T_world_body * point);
      rays.pairs.push_back({eye, points.positions.back()});
    }
    for (const std::vector<Vec3>& outline : sample.outlines) {
      for (std::size_t i = 0; i < outline.size(); ++i)
        outlines.pairs.push_back(
            {now.T_world_body * outline[i], now.T_world_body * outline[(i + 1) % outline.size()]});
    }
  }
  if (!rays.pairs.empty()) picture.segments.push_back(std::move(rays));
  if (!outlines.pairs.empty()) picture.segments.push_back(std::move(outlines));
  if (!points.positions.empty()) picture.markers.push_back(std::move(points));
}

void add_command(render::Picture& picture, const Record& record, const Instant& now) {
  const log::ObeyedCommand* command = obeyed_at(record, now.iteration);
  if (command == nullptr) return;
  const double extent_m = extent_of_world(record, picture);
  const double seconds = seconds_shown(record, extent_m);
  render::Segments lines{.colour = render::palette::kInk,
                         .width_px = 2.4,
                         .label = fmt::format("command, for {:.0f} s", seconds)};
  const Vec2 way = seconds * Vec2(command->linear_m_s, command->lateral_m_s);
  if (way.norm() > 0.0) {
    lines.pairs.push_back({on_body(now, Vec2::Zero(), 0.0), on_body(now, way, 0.0)});
    add_head(lines, now, Vec2::Zero(), way, std::min(0.3 * way.norm(), 0.4 * kArcShare * extent_m));
  }
  if (command->angular_rad_s != 0.0)
    add_arc(lines, now, seconds * command->angular_rad_s, kArcShare * extent_m);
  if (!lines.pairs.empty()) picture.segments.push_back(std::move(lines));
}

void add_contacts(render::Picture& picture, const Record& record, const std::optional<Instant>& now) {
  const double normal_m = 0.5 * kArcShare * extent_of_world(record, picture);
  render::Markers old{.shape = render::MarkerShape::kCross,
                      .colour = render::palette::kError,
                      .size_px = 6.0,
                      .label = "contacts"};
  render::Markers fresh{.shape = render::MarkerShape::kCross,
                        .colour = render::palette::kError,
                        .size_px = 14.0,
                        .label = "contacts of the last second"};
  render::Segments normals{.colour = render::palette::kError, .width_px = 2.4};
  for (const log::ContactRow& contact : record.contacts) {
    if (now && contact.t_ns > now->t_ns) break;
    const Vec3 place = to_vec3(contact.position_m);
    const bool is_fresh = now && contact.t_ns > now->t_ns - kSecond_ns;
    (is_fresh ? fresh : old).positions.push_back(place);
    if (is_fresh) normals.pairs.push_back({place, place + normal_m * to_vec3(contact.normal)});
  }
  if (!normals.pairs.empty()) picture.segments.push_back(std::move(normals));
  for (render::Markers* marks : {&old, &fresh}) {
    if (!marks->positions.empty()) picture.markers.push_back(std::move(*marks));
  }
}

void add_events(render::Picture& picture, const Record& record, const std::optional<Instant>& now) {
  render::Markers marks{.shape = render::MarkerShape::kDiamond,
                        .colour = render::palette::kEstimate,
                        .size_px = 11.0,
                        .label = "events"};
  const std::vector<std::int64_t> kidnaps = kidnap_times(record);
  std::size_t kidnap = 0;
  for (const log::EventRow& event : record.events) {
    if (now && event.t_ns > now->t_ns) break;
    const std::string text = printable(event.what.empty() ? event.kind : event.kind + " " + event.what, 40);
    if (event.kind != "kidnap") {
      mark_event(picture, marks, place_at(record, event.t_ns, false), text);
      continue;
    }
    const std::int64_t after = kidnaps[kidnap++];
    mark_event(picture, marks, place_at(record, after, true), text);
    if (!now || after <= now->t_ns)
      mark_event(picture, marks, place_at(record, after, false), "after kidnap");
  }
  if (!marks.positions.empty()) picture.markers.push_back(std::move(marks));
}

std::string instant_text(const Record& record, const Instant& now) {
  std::string text =
      fmt::format("iteration {}, {:.2f} s", now.iteration, static_cast<double>(now.t_ns) * 1e-9);
  const log::ObeyedCommand* command = obeyed_at(record, now.iteration);
  if (command == nullptr) return text;
  text += fmt::format(", command {:.3g} m/s", command->linear_m_s);
  if (command->lateral_m_s != 0.0) text += fmt::format(", sideways {:.3g} m/s", command->lateral_m_s);
  text += fmt::format(", {:.3g} rad/s ({}", command->angular_rad_s, command_cause_name(command->cause));
  return text + (command->changes.empty() ? ")" : ": " + command->changes + ")");
}

}  // namespace hallway::run
