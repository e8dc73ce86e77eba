// SPDX-License-Identifier: MIT
#include "planes/finder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.hpp"
#include "geom/arrays.hpp"
#include "host/output/output_kind.hpp"
#include "host/samples/frame_builder.hpp"
#include "host/samples/point_kind.hpp"
#include "import/point_collector.hpp"

namespace hallway::planes {
namespace {

constexpr std::uint32_t kSensor = 0;

PlaneObservation copy_plane(const host::PlaneList& list, const hw_plane_t& plane) {
  PlaneObservation copy{.id = plane.id,
                        .plane = {to_vec3(plane.normal), plane.offset_m},
                        .centroid = to_vec3(plane.centroid),
                        .points = plane.n_points,
                        .rms = plane.rms_m,
                        .exclusive_share = plane.exclusive_share};
  for (std::size_t i = 0; i < copy.corners.size(); ++i) copy.corners[i] = to_vec3(plane.corners[i]);
  for (const hw_point3_t& point : list.hull_of(plane)) copy.hull.emplace_back(point.x, point.y, point.z);
  const auto members = list.members_of(plane);
  copy.members.assign(members.begin(), members.end());
  return copy;
}

std::vector<PlaneObservation> copy_planes(const host::Outputs& outputs) {
  std::vector<PlaneObservation> planes;
  if (const auto list = outputs.planes(0)) {
    for (const hw_plane_t& plane : list->planes) planes.push_back(copy_plane(*list, plane));
  }
  return planes;
}

double median_ms(std::vector<std::int64_t> times_ns) {
  const auto middle = times_ns.begin() + static_cast<std::ptrdiff_t>(times_ns.size() / 2);
  std::nth_element(times_ns.begin(), middle, times_ns.end());
  return static_cast<double>(*middle) * 1e-6;
}

}  // namespace

PlaneFinder::PlaneFinder(host::StageSpec plugin, std::vector<std::filesystem::path> folders,
                         host::LogSink log, std::optional<host::Isolation> isolation)
    : pipeline_({std::move(plugin)}, std::move(folders), {host::point_sensor("cloud", kSensor)},
                std::move(log), std::move(isolation)) {
  const auto& outputs = info().outputs;
  if (std::find(outputs.begin(), outputs.end(), HW_OUTPUT_PLANES) != outputs.end()) return;
  std::vector<std::string> names;
  for (const std::uint32_t kind : outputs) names.push_back(host::output_kind_name(kind));
  throw Error(ErrorCode::kBadInput,
              fmt::format("plugin `{}` finds no planes; it puts: {}", info().id,
                          names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "))));
}

Answer PlaneFinder::find(const std::vector<Vec3>& points, unsigned repeats, const import::PixelGrid& image) {
  if (points.size() > import::kMaxFramePoints) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("{} points, and a frame holds {}", points.size(), import::kMaxFramePoints));
  }
  host::FrameBuilder builder;
  builder.begin(0, 0);
  std::vector<hw_point3_t>& list = host::add_points(builder, kSensor);
  for (const Vec3& point : points) list.push_back({point.x(), point.y(), point.z()});
  if (image.width != 0) host::add_pixels(builder, image.width, image.height) = image.pixels;
  const hw_frame_t& frame = builder.finish();
  Answer answer;
  std::vector<std::int64_t> wall, cpu;
  for (unsigned i = 0; i < repeats; ++i) {
    pipeline_.reset();
    const host::Outputs& outputs = pipeline_.process(frame);
    wall.push_back(pipeline_.last_call().wall_ns);
    cpu.push_back(pipeline_.last_call().cpu_ns);
    if (i + 1 == repeats) answer.planes = copy_planes(outputs);
  }
  answer.ms = median_ms(std::move(wall));
  answer.cpu_ms = median_ms(std::move(cpu));
  return answer;
}

}  // namespace hallway::planes
