// SPDX-License-Identifier: MIT
#include "run/pictures/pictures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "render/colour.hpp"
#include "render/draw.hpp"
#include "render/png.hpp"
#include "run/pictures/instant_layers.hpp"
#include "run/pictures/landmark_layers.hpp"
#include "run/pictures/picture_frame.hpp"
#include "run/pictures/plane_layers.hpp"
#include "run/pictures/robot_things.hpp"
#include "run/pictures/scan_layers.hpp"
#include "run/pictures/topology_layers.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

/// Whether one of the times is after `from` and not after `to`.
bool is_any_between(const std::vector<std::int64_t>& times, double from_s, double to_s) {
  return std::ranges::any_of(
      times, [&](std::int64_t t) { return t > nanoseconds(from_s) && t <= nanoseconds(to_s); });
}

/// The positions as a line, broken where poses are missing and at the times of `breaks`.
std::vector<Vec3> line_of(std::span<const log::StampedPose> poses, const Pose& T_world_frame,
                          const std::vector<std::int64_t>& breaks) {
  double period_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < poses.size(); ++i)
    period_s = std::min(period_s, poses[i].t_s - poses[i - 1].t_s);
  std::vector<Vec3> line;
  line.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool gap = i > 0 && (poses[i].t_s - poses[i - 1].t_s > 1.5 * period_s ||
                               is_any_between(breaks, poses[i - 1].t_s, poses[i].t_s));
    if (gap) line.push_back(Vec3::Constant(std::nan("")));
    line.push_back(T_world_frame * to_vec3(poses[i].position_m));
  }
  return line;
}

/// Poses in other parts of the map are in frames of reference of their own.
std::string path_label(const Record& record) {
  if (record.poses_in_other_parts == 0) return "estimated path";
  return fmt::format("estimated path ({} poses in other parts of the map not shown)",
                     record.poses_in_other_parts);
}

/// The poses up to a moment, or all.
std::span<const log::StampedPose> until(const std::vector<log::StampedPose>& poses,
                                        const std::optional<Instant>& now) {
  if (!now) return poses;
  const auto later = std::ranges::upper_bound(
      poses, now->t_ns, {}, [](const log::StampedPose& pose) { return nanoseconds(pose.t_s); });
  return {poses.begin(), later};
}

void add_paths(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
               const Pose& T_world_map, const std::optional<Instant>& now = std::nullopt) {
  const std::vector<std::int64_t> breaks = kidnap_times(record);
  const auto truth = until(record.truth, now), trajectory = until(record.trajectory, now);
  if (spec.shows(now ? sim::PictureLayer::kTrail : sim::PictureLayer::kTruth) && !truth.empty()) {
    picture.polylines.push_back({.points = line_of(truth, Pose(), breaks),
                                 .colour = render::palette::kTruth,
                                 .width_px = 5.0,
                                 .label = "true path"});
  }
  if (spec.shows(sim::PictureLayer::kEstimate) && !trajectory.empty()) {
    picture.polylines.push_back({.points = line_of(trajectory, T_world_map, breaks),
                                 .colour = render::palette::kEstimate,
                                 .width_px = 1.8,
                                 .label = path_label(record)});
    // Where the estimate has diverged it does not begin where the robot did.
    const Vec3 start = record.truth.empty() ? T_world_map * to_vec3(record.trajectory.front().position_m)
                                            : to_vec3(record.truth.front().position_m);
    picture.labels.push_back({.position = start, .text = "start"});
  }
}

/// A sensor at a moment, or else at the last pose that is known.
void add_frustum(render::Picture& picture, const Record& record, const Json& sensor, const Pose& T_world_map,
                 const std::optional<Instant>& now = std::nullopt) {
  const auto number = [&](const char* key) {
    const Json value = value_at(sensor, {key});
    return value.is_number() ? value.get<double>() : std::nan("");
  };
  render::FrustumMark mark{.horizontal_fov = number("horizontal_fov_rad"),
                           .vertical_fov = number("vertical_fov_rad"),
                           .range_m = number("max_range_m"),
                           .label = now ? "field of view" : "field of view at the end"};
  if (!(mark.horizontal_fov > 0.0) || !(mark.vertical_fov > 0.0) || !(mark.range_m > 0.0)) return;
  const Pose T_body_sensor = mount_of(sensor);
  if (now) {
    mark.T_world_sensor = now->T_world_body * T_body_sensor;
  } else if (!record.truth.empty()) {
    mark.T_world_sensor = pose_of(record.truth.back()) * T_body_sensor;
  } else if (!record.trajectory.empty()) {
    mark.T_world_sensor = T_world_map * pose_of(record.trajectory.back()) * T_body_sensor;
  } else {
    return;
  }
  picture.frustums.push_back(mark);
}

std::string number_text(const Json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : std::string("unknown");
}

/// What metrics.json says of the walls; empty where it says nothing.
std::string walls_text(const Json& metrics) {
  const Json planes = value_at(metrics, {"planes"});
  if (!planes.is_object()) return {};
  const Json map = planes.value("final", Json::object());
  std::string text =
      fmt::format(", {} of {} walls mapped", map.value("walls_mapped", 0), planes.value("walls_true", 0));
  if (value_at(map, {"corner_m"}).is_object())
    text += ", corners " + number_text(value_at(map, {"corner_m", "rms"}), "{:.4f}") + " m RMS";
  return text;
}

/// ", 98.0 % of the frames have a pose"; empty where metrics.json does not say so.
std::string coverage_text(const Json& metrics, const char* what, const char* text) {
  const Json share = value_at(metrics, {"coverage", what});
  return share.is_number() ? fmt::format(", {:.1f} % {}", 100.0 * share.get<double>(), text) : std::string();
}

/// What went wrong with the path; empty where nothing did.
std::string verdict_text(const Json& metrics) {
  const Json verdict = value_at(metrics, {"verdict"});
  return verdict.is_string() && verdict != "ok" ? verdict.get<std::string>() + ": " : std::string();
}

std::string subtitle_of(const Record& record) {
  const Json& metrics = record.metrics;
  std::string text = verdict_text(metrics) + fmt::format("{} iterations", record.run.value("iterations", 0)) +
                     coverage_text(metrics, "poses", "with a pose");
  const auto add_error = [&](const char* what, const Json& error, const char* format) {
    if (error.is_number()) text += what + number_text(error, format) + " m";
  };
  add_error(", path RMSE ", value_at(metrics, {"position_rmse_m", "aligned"}), "{:.3f}");
  const std::string landmarks = coverage_text(metrics, "landmarks", "of the seen landmarks mapped");
  const Json mapped = value_at(metrics, {"landmarks_mapped"});
  text += landmarks;
  if (landmarks.empty() && mapped.is_number() && mapped.get<std::uint64_t>() > 0)
    text += fmt::format(", {} landmarks mapped", mapped.get<std::uint64_t>());
  add_error(", landmark RMSE ", value_at(metrics, {"landmark_rmse_m", "final_aligned"}), "{:.4f}");
  if (record.topology)
    text += fmt::format(", topology of {} nodes, loop {}", record.topology->nodes.size(),
                        log::loop_state_name(record.topology->loop));
  return text + walls_text(metrics);
}

/// Where the poses stand in the world.
Pose path_place(const Record& record) {
  const std::optional<Pose> T_world_planes = align_planes(record);
  return T_world_planes ? *T_world_planes : align_path(record).value_or(Pose());
}

/// Where the map of the end stands in the world.
Pose map_place(const Record& record) {
  return align_landmarks(record).value_or(path_place(record));
}

/// True landmarks as small dots: what is mapped at a moment no folder says.
void add_landmark_dots(render::Picture& picture, const Record& record) {
  render::Markers dots{.colour = render::palette::kMutedInk, .size_px = 2.2, .label = "true landmarks"};
  for (const log::Landmark& landmark : record.true_landmarks)
    dots.positions.push_back(to_vec3(landmark.position_m));
  if (!dots.positions.empty()) picture.markers.push_back(std::move(dots));
}

/// How long lines without an end are drawn in a world without extent.
constexpr double kReach_m = 100.0;

/// What a picture of a moment shows over the map.
void add_instant(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
                 const Instant& now) {
  using enum sim::PictureLayer;
  const bool from_robot = spec.view == sim::PictureView::kCamera;  // it does not see itself
  picture.subtitle = instant_text(record, now);
  if (spec.shows(kTruth)) add_landmark_dots(picture, record);
  const bool deskews = spec.shows(kDeskewed);
  Scans scans;
  if (spec.shows(kSeen) || deskews || spec.shows(kFrustum)) scans = read_scans(record, now);
  const Box frame = frame_of(record, picture.surfaces);
  const double reach_m = frame.isEmpty() ? kReach_m : frame.diagonal().norm();
  if (spec.shows(kFrustum) && !from_robot) {
    for (const Json& sensor : sensors_of(record)) add_frustum(picture, record, sensor, Pose(), now);
    add_sectors(picture, scans, reach_m);
  }
  const Pose T_world_path = path_place(record);
  add_paths(picture, record, spec, T_world_path, now);
  if (spec.shows(kSeen)) add_seen(picture, record, now);
  if (spec.shows(kSeen) || deskews)
    add_scans(picture, scans, deskews ? ScanPlacement::kDeskewed : ScanPlacement::kAsMeasured, reach_m);
  if (const log::Topology* topology = spec.shows(kTopology) ? topology_at(record, now) : nullptr)
    add_topology(picture, record, *topology, T_world_path);
  if (spec.shows(kDrawing)) add_drawing(picture, record, now);
  if (spec.shows(kCommand) && !from_robot) add_command(picture, record, now);
  if (spec.shows(kBody) && !from_robot) add_body(picture, record, now);
  if (spec.shows(kContacts)) add_contacts(picture, record, now);
  if (spec.shows(kEvents)) add_events(picture, record, now);
}

/// The view ahead from the first sensor, or else from the body.
void look_ahead(const Record& record, const Instant& now, render::View& view) {
  const Json sensor = sensor_of(record);
  const Pose eye = sensor.is_object() ? now.T_world_body * mount_of(sensor) : now.T_world_body;
  view.eye = eye.t;
  view.target = eye * Vec3::UnitX();
  const Json fov = value_at(sensor, {"vertical_fov_rad"});
  constexpr double kWidest = 2.0;
  view.vertical_fov = fov.is_number() && fov.get<double>() > 0.0 ? std::min(fov.get<double>(), kWidest)
                                                                 : std::numbers::pi / 3.0;
}

/// How the map is opened: as the picture's description says, else as the building suggests.
render::Plan plan_for(const world::CompiledWorld& world, const sim::PictureSpec& spec,
                      const MapView& map_view) {
  if (spec.cut_z_m) return {render::Faces::kAll, spec.cut_z_m};
  const auto& leak = world.partition.enclosure.leak;
  std::optional<Vec3> focus = map_view.pvs_from_m;
  if (map_view.leak && leak) focus = leak->way.front();
  return render::plan_of(world.partition, focus);
}

std::string draw_png(const render::Picture& picture, const sim::PictureSpec& spec, render::View view,
                     const DrawOptions& options) {
  if (options.vertical_fov) view.vertical_fov = *options.vertical_fov;
  if (options.area && view.kind == render::ViewKind::kTop) {
    const Box ground(Vec3(options.area->min().x(), options.area->min().y(), 0.0),
                     Vec3(options.area->max().x(), options.area->max().y(), 0.0));
    view.crop = crop_of(ground, render::map_area(picture, spec.width_px, spec.height_px));
  }
  return render::encode_png(render::draw(picture, view, spec.width_px, spec.height_px));
}

/// The ground of a picture of something small, whose usual frame would be wider, with a rim.
Eigen::AlignedBox2d area_of(const render::Picture& picture) {
  constexpr double kRim = 0.08;
  Eigen::AlignedBox2d area;
  const auto extend = [&](const Vec3& point) { area.extend(Vec2(point.head<2>())); };
  for (const render::Surface& surface : picture.surfaces)
    std::ranges::for_each(surface.polygon.vertices, extend);
  for (const render::Polyline& line : picture.polylines) std::ranges::for_each(line.points, extend);
  for (const render::Label& label : picture.labels) extend(label.position);
  for (const render::Segments& lines : picture.segments)
    for (const auto& pair : lines.pairs) std::ranges::for_each(pair, extend);
  const Vec2 rim = Vec2::Constant(kRim * area.sizes().maxCoeff());
  return {area.min() - rim, area.max() + rim};
}

std::string map_subtitle(const world::CompiledWorld& world, const MapView& view) {
  const auto& enclosure = world.partition.enclosure;
  if (view.pvs_from_m) return "potentially visible set";
  if (view.leak && enclosure.leak) {
    return fmt::format("leak: {} of {} occupants reach the void", enclosure.leaking.size(),
                       world.occupants.size());
  }
  if (view.leak) return enclosure.sealed ? "sealed: no leak" : "encloses nothing";
  if (view.bsp_depth) {
    return fmt::format("tree of {} nodes and {} leaves", world.partition.tree.nodes.size(),
                       world.partition.tree.leaves.size());
  }
  return {};
}

}  // namespace

render::View view_of_plan(const sim::PictureSpec& spec, const render::Plan& plan, render::Renderer renderer) {
  render::View view;
  const bool is_perspective =
      spec.view == sim::PictureView::kPerspective || spec.view == sim::PictureView::kCamera;
  view.kind = is_perspective ? render::ViewKind::kPerspective : render::ViewKind::kTop;
  view.cut_z_m = plan.cut_z_m;
  view.eye = spec.eye_m;
  view.target = spec.target_m;
  view.renderer = renderer;
  return view;
}

render::Plan picture_plan(const Record& record, const sim::PictureSpec& spec, const MapView& map_view) {
  const bool from_inside = spec.view == sim::PictureView::kCamera;
  return record.world && !from_inside ? plan_for(*record.world, spec, map_view)
                                      : render::Plan{{}, spec.cut_z_m};
}

render::Picture compose_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view,
                                render::Faces faces, std::optional<double> error_scale) {
  render::Picture picture;
  picture.title = printable(record.run.value("name", "run"));
  picture.subtitle = subtitle_of(record);
  if (record.world && (spec.shows(sim::PictureLayer::kMap) || map_view.anything()))
    add_map(picture, *record.world, map_view, faces, record.models);
  if (spec.iteration) {
    add_instant(picture, record, spec, instant_of(record, *spec.iteration));
    cut_to(frame_of(record, picture.surfaces), picture);
    return picture;
  }
  const Pose T_world_path = path_place(record);
  const Pose T_world_map = map_place(record);
  add_planes(picture, record, spec, T_world_map);
  for (const Json& sensor : sensors_of(record)) {
    if (spec.shows(sim::PictureLayer::kFrustum)) add_frustum(picture, record, sensor, T_world_path);
  }
  add_landmarks(picture, record, spec, T_world_map, error_scale);
  add_paths(picture, record, spec, T_world_path);
  if (record.topology && spec.shows(sim::PictureLayer::kTopology))
    add_topology(picture, record, *record.topology, T_world_path);
  if (spec.shows(sim::PictureLayer::kContacts)) add_contacts(picture, record, std::nullopt);
  if (spec.shows(sim::PictureLayer::kEvents)) add_events(picture, record, std::nullopt);
  cut_to(frame_of(record, picture.surfaces), picture);
  return picture;
}

render::Picture compose_map_picture(const MapSubject& subject, const MapView& map_view, render::Faces faces) {
  render::Picture picture;
  picture.title = printable(subject.title);
  picture.subtitle = map_subtitle(subject.world, map_view);
  add_map(picture, subject.world, map_view, faces, subject.meshes);
  if (subject.document != nullptr) add_map_things(picture, *subject.document, subject.world, subject.things);
  return picture;
}

void check_picture_name(const std::string& file) {
  if (file.ends_with(".png")) return;
  throw Error(ErrorCode::kUsage,
              fmt::format("a picture is a file that ends in .png, not \"{}\"", printable(file)));
}

std::optional<double> error_scale_of(const Record& record) {
  return error_scale_of(record, map_place(record));
}

std::string draw_run_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view,
                             const DrawOptions& options) {
  if (spec.view == sim::PictureView::kPanels)
    return render::encode_png(draw_panels(record, spec, options.renderer));
  const render::Plan plan = picture_plan(record, spec, map_view);
  const render::Picture picture = compose_picture(record, spec, map_view, plan.faces, options.error_scale);
  const Box frame = frame_of(record, picture.surfaces);
  DrawOptions framed = options;
  if (!framed.area && !frame.isEmpty())
    framed.area = Eigen::AlignedBox2d(frame.min().head<2>(), frame.max().head<2>());
  render::View view = view_of_plan(spec, plan, options.renderer);
  if (spec.view == sim::PictureView::kCamera)
    look_ahead(record, instant_of(record, spec.iteration.value()), view);
  return draw_png(picture, spec, view, framed);
}

std::string draw_map_picture(const MapSubject& subject, const sim::PictureSpec& spec, const MapView& map_view,
                             const DrawOptions& options) {
  const render::Plan plan = plan_for(subject.world, spec, map_view);
  return draw_png(compose_map_picture(subject, map_view, plan.faces), spec,
                  view_of_plan(spec, plan, options.renderer), options);
}

std::string draw_robot_picture(const map::RobotFile& robot, const std::string& title,
                               const sim::PictureSpec& spec, const MapThings& things,
                               const DrawOptions& options) {
  render::Picture picture = compose_robot_picture(robot, things);
  picture.title = printable(title);
  DrawOptions framed = options;
  if (!framed.area) framed.area = area_of(picture);
  return draw_png(picture, spec, view_of_plan(spec, {render::Faces::kAll, spec.cut_z_m}, options.renderer),
                  framed);
}

}  // namespace hallway::run
