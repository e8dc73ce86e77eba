// SPDX-License-Identifier: MIT
#include "run/pictures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "record/sensor_json.hpp"
#include "render/colour.hpp"
#include "render/draw.hpp"
#include "render/png.hpp"
#include "run/abi_pose.hpp"
#include "run/landmark_layers.hpp"
#include "run/panels.hpp"
#include "run/wall_layers.hpp"

namespace hallway::run {
namespace {

Vec3 vector_of(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

Pose pose_of(const log::StampedPose& pose) {
  const auto& q = pose.orientation;
  return {Quat(q[0], q[1], q[2], q[3]).normalized(), vector_of(pose.position_m)};
}

/// The positions as a line, broken where poses are missing.
std::vector<Vec3> line_of(const std::vector<log::StampedPose>& poses, const Pose& T_world_frame) {
  double period_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < poses.size(); ++i)
    period_s = std::min(period_s, poses[i].t_s - poses[i - 1].t_s);
  std::vector<Vec3> line;
  line.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool gap = i > 0 && poses[i].t_s - poses[i - 1].t_s > 1.5 * period_s;
    if (gap) line.push_back(Vec3::Constant(std::nan("")));
    line.push_back(T_world_frame * vector_of(poses[i].position_m));
  }
  return line;
}

void add_paths(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
               const Pose& T_world_map) {
  if (spec.shows(sim::PictureLayer::kTruth) && !record.truth.empty()) {
    picture.polylines.push_back({.points = line_of(record.truth, Pose()),
                                 .colour = render::palette::kTruth,
                                 .width_px = 5.0,
                                 .dashed = false,
                                 .label = "true path"});
  }
  if (spec.shows(sim::PictureLayer::kEstimate) && !record.trajectory.empty()) {
    picture.polylines.push_back({.points = line_of(record.trajectory, T_world_map),
                                 .colour = render::palette::kEstimate,
                                 .width_px = 1.8,
                                 .dashed = false,
                                 .label = "estimated path"});
    picture.labels.push_back(
        {.position = T_world_map * vector_of(record.trajectory.front().position_m), .text = "start"});
  }
}

/// The sensor at the last pose that is known.
void add_frustum(render::Picture& picture, const Record& record, const Pose& T_world_map) {
  const auto sensors = record.run.find("sensors");
  if (sensors == record.run.end() || !sensors->is_array() || sensors->empty()) return;
  const auto& sensor = sensors->front();
  const auto number = [&](const char* key) {
    const auto value = sensor.find(key);
    return value != sensor.end() && value->is_number() ? value->template get<double>() : std::nan("");
  };
  render::FrustumMark mark;
  mark.horizontal_fov = number("horizontal_fov_rad");
  mark.vertical_fov = number("vertical_fov_rad");
  mark.range_m = number("max_range_m");
  mark.label = "field of view at the end";
  if (!(mark.horizontal_fov > 0.0) || !(mark.vertical_fov > 0.0) || !(mark.range_m > 0.0)) return;
  Pose T_body_sensor;
  const auto mount = sensor.find("T_body_sensor");
  if (mount != sensor.end()) T_body_sensor = run::pose_of(record::read_pose(*mount));
  if (!record.truth.empty()) {
    mark.T_world_sensor = pose_of(record.truth.back()) * T_body_sensor;
  } else if (!record.trajectory.empty()) {
    mark.T_world_sensor = T_world_map * pose_of(record.trajectory.back()) * T_body_sensor;
  } else {
    return;
  }
  picture.frustum = mark;
}

std::string number_text(const nlohmann::ordered_json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : std::string("unknown");
}

/// What metrics.json says of the walls; empty where it says nothing.
std::string walls_text(const nlohmann::ordered_json& metrics) {
  const auto planes = metrics.find("planes");
  if (planes == metrics.end() || !planes->is_object()) return {};
  const nlohmann::ordered_json& map = planes->value("final", nlohmann::ordered_json::object());
  std::string text =
      fmt::format(", {} of {} walls mapped", map.value("walls_mapped", 0), planes->value("walls_true", 0));
  const auto corners = map.find("corner_m");
  if (corners != map.end() && corners->is_object())
    text += ", corners " + number_text(corners->value("rms", nlohmann::ordered_json()), "{:.4f}") + " m RMS";
  return text;
}

std::string subtitle_of(const Record& record) {
  const auto& metrics = record.metrics;
  std::string text = fmt::format("{} iterations", metrics.value("iterations", 0));
  const auto& mapped = metrics.value("landmarks_mapped", nlohmann::ordered_json());
  if (mapped.is_number() && mapped.get<std::uint64_t>() > 0)
    text += fmt::format(", {} landmarks mapped", mapped.get<std::uint64_t>());
  const auto rmse = metrics.find("landmark_rmse_m");
  if (rmse != metrics.end() && rmse->is_object() && rmse->contains("final_aligned") &&
      (*rmse)["final_aligned"].is_number()) {
    text += ", landmark RMSE " + number_text((*rmse)["final_aligned"], "{:.4f}") + " m";
  }
  text += walls_text(metrics);
  const auto positions = metrics.find("position_rmse_m");
  if (positions != metrics.end() && positions->is_object() && (*positions)["aligned"].is_number()) {
    text += ", path RMSE " + number_text((*positions)["aligned"], "{:.3f}") + " m";
  }
  return text;
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

render::View view_of(const sim::PictureSpec& spec, const render::Plan& plan) {
  render::View view;
  view.kind =
      spec.view == sim::PictureView::kPerspective ? render::ViewKind::kPerspective : render::ViewKind::kTop;
  view.cut_z_m = plan.cut_z_m;
  view.eye = spec.eye_m;
  view.target = spec.target_m;
  return view;
}

std::string draw_png(const render::Picture& picture, const sim::PictureSpec& spec, const render::Plan& plan) {
  return render::encode_png(render::draw(picture, view_of(spec, plan), spec.width_px, spec.height_px));
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

/// Colours of runs beside each other, after Okabe and Ito; none is that of the truth.
render::Rgb comparison_colour(std::size_t index) {
  constexpr std::array<render::Rgb, 6> kColours{
      {{213, 94, 0}, {0, 158, 115}, {170, 51, 119}, {230, 159, 0}, {86, 180, 233}, {60, 60, 60}}};
  return index < kColours.size() ? kColours[index] : render::submap_colour(index);
}

/// The path and the landmarks of one run among others. Those that are drawn first are wider, and show behind what covers them.
void add_compared(render::Picture& picture, const Compared& run, const sim::PictureSpec& spec,
                  render::Rgb colour, double wider_px) {
  const Pose T_world_path = align_path(run.record).value_or(Pose());
  const Pose T_world_map = align_landmarks(run.record).value_or(T_world_path);
  const LandmarkPlaces mapped = mapped_places(run.record, T_world_map);
  render::Markers marks{.positions = {},
                        .shape = render::MarkerShape::kDot,
                        .colour = colour,
                        .size_px = 3.5 + wider_px,
                        .label = {}};
  for (const log::MapLandmark& landmark :
       run.record.landmarks) {  // in the file's order, so that the picture is the same
    if (const auto place = mapped.find(landmark.id); place != mapped.end())
      marks.positions.push_back(place->second);
  }
  if (spec.shows(sim::PictureLayer::kLandmarks) && !marks.positions.empty())
    picture.markers.push_back(std::move(marks));
  if (spec.shows(sim::PictureLayer::kEstimate) && !run.record.trajectory.empty()) {
    picture.polylines.push_back({.points = line_of(run.record.trajectory, T_world_path),
                                 .colour = colour,
                                 .width_px = 1.8 + wider_px,
                                 .dashed = false,
                                 .label = printable(run.name)});
  }
}

}  // namespace

render::Picture compose_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec,
                                   render::Faces faces) {
  const Record& first = runs.front().record;
  render::Picture picture;
  picture.title = printable(first.run.value("name", "run"));
  picture.subtitle = fmt::format("{} runs of the same input", runs.size());
  if (first.world && spec.shows(sim::PictureLayer::kMap)) {
    add_map(picture, *first.world, {}, faces);
    picture.surfaces.insert(picture.surfaces.end(), first.models.begin(), first.models.end());
  }
  if (spec.shows(sim::PictureLayer::kTruth)) {
    add_true_landmarks(picture, first);
    if (!first.truth.empty()) {
      picture.polylines.push_back({.points = line_of(first.truth, Pose()),
                                   .colour = render::palette::kTruth,
                                   .width_px = 5.0,
                                   .dashed = false,
                                   .label = "true path"});
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double covering = static_cast<double>(std::min<std::size_t>(runs.size() - 1 - i, 5));
    add_compared(picture, runs[i], spec, comparison_colour(i), 1.7 * covering);
  }
  return picture;
}

render::Picture compose_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view,
                                render::Faces faces) {
  render::Picture picture;
  picture.title = printable(record.run.value("name", "run"));
  picture.subtitle = subtitle_of(record);
  if (record.world && (spec.shows(sim::PictureLayer::kMap) || map_view.anything())) {
    add_map(picture, *record.world, map_view, faces);
    if (!map_view.wireframe)
      picture.surfaces.insert(picture.surfaces.end(), record.models.begin(), record.models.end());
  }
  const std::optional<Pose> T_world_planes = align_planes(record);
  const Pose T_world_path = T_world_planes ? *T_world_planes : align_path(record).value_or(Pose());
  const Pose T_world_map = align_landmarks(record).value_or(T_world_path);
  add_walls(picture, record, spec, T_world_map);
  if (spec.shows(sim::PictureLayer::kFrustum)) add_frustum(picture, record, T_world_path);
  add_landmarks(picture, record, spec, T_world_map);
  add_paths(picture, record, spec, T_world_path);
  return picture;
}

render::Picture compose_map_picture(const MapSubject& subject, const MapView& map_view, render::Faces faces) {
  render::Picture picture;
  picture.title = printable(subject.title);
  picture.subtitle = map_subtitle(subject.world, map_view);
  add_map(picture, subject.world, map_view, faces);
  if (!map_view.wireframe) {
    picture.surfaces.insert(picture.surfaces.end(), subject.meshes.begin(), subject.meshes.end());
  }
  return picture;
}

std::string draw_run_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view) {
  if (spec.view == sim::PictureView::kPanels) return render::encode_png(draw_panels(record, spec));
  const render::Plan plan =
      record.world ? plan_for(*record.world, spec, map_view) : render::Plan{{}, spec.cut_z_m};
  return draw_png(compose_picture(record, spec, map_view, plan.faces), spec, plan);
}

std::string draw_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec) {
  const Record& first = runs.front().record;
  const render::Plan plan = first.world ? plan_for(*first.world, spec, {}) : render::Plan{{}, spec.cut_z_m};
  return draw_png(compose_comparison(runs, spec, plan.faces), spec, plan);
}

std::string draw_map_picture(const MapSubject& subject, const sim::PictureSpec& spec,
                             const MapView& map_view) {
  const render::Plan plan = plan_for(subject.world, spec, map_view);
  return draw_png(compose_map_picture(subject, map_view, plan.faces), spec, plan);
}

}  // namespace hallway::run
