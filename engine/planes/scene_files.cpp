// SPDX-License-Identifier: MIT
#include "planes/scene_files.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::planes {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPlanesEnd = "_planes";
constexpr std::string_view kPlaneColumns = "label,cx,cy,cz,nx,ny,nz,ux,uy,uz,half_u,half_v,points,sigma";

enum Column : std::size_t {
  kLabel,
  kCentre,
  kNormal = kCentre + 3,
  kAxis = kNormal + 3,
  kHalfU = kAxis + 3,
  kHalfV,
  kPoints,
  kNoise
};

std::vector<log::CsvColumn> columns() {
  std::vector<log::CsvColumn> list;
  for (const std::string_view name : split(kPlaneColumns, ',')) list.push_back({name});
  return list;
}

SceneRectangle read_rectangle(const log::CsvReader& row) {
  SceneRectangle rectangle;
  rectangle.label = static_cast<std::int64_t>(row.whole(kLabel, INT64_MAX));
  rectangle.centre = to_vec3(row.vector(kCentre));
  rectangle.normal = to_vec3(row.vector(kNormal));
  rectangle.u = to_vec3(row.vector(kAxis));
  rectangle.half_u = row.number(kHalfU);
  rectangle.half_v = row.number(kHalfV);
  rectangle.points = static_cast<std::uint32_t>(row.whole(kPoints, UINT32_MAX));
  rectangle.noise = row.number(kNoise);
  constexpr double kUnit = 1e-3;
  if (std::abs(rectangle.normal.norm() - 1) > kUnit || std::abs(rectangle.u.norm() - 1) > kUnit)
    throw row.error("a normal and an axis have unit length");
  if (std::abs(rectangle.normal.norm() - 1) > 1e-9) rectangle.normal.normalize();  // else keeps its bits
  return rectangle;
}

/// Those of its planes that have points.
void read_planes(const fs::path& path, LabelledCloud& scene) {
  const std::string content = read_file(path);
  log::CsvReader row(content, printable(path.string(), 4096), columns());
  Scene described;
  std::set<std::int64_t> seen;
  const std::set<std::int64_t> used(scene.cloud.labels.begin(), scene.cloud.labels.end());
  while (row.next()) {
    const SceneRectangle rectangle = read_rectangle(row);
    if (!seen.insert(rectangle.label).second) throw row.error("a label that stands there twice");
    if (used.contains(rectangle.label)) described.rectangles.push_back(rectangle);
  }
  for (const std::int64_t label : used) {
    if (label != kNoLabel && !seen.contains(label))
      throw row.error("label " + std::to_string(label) + " of a point has no plane");
  }
  std::sort(described.rectangles.begin(), described.rectangles.end(),
            [](const SceneRectangle& a, const SceneRectangle& b) { return a.label < b.label; });
  scene.truth = truth_of(described);
  scene.truth.labels = scene.cloud.labels;
}

}  // namespace

std::vector<SceneFile> list_scenes(const fs::path& folder) {
  std::vector<SceneFile> scenes;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path path = entry->path();
    const std::string name = path.stem().string();
    if (path.extension() != ".csv" || name.ends_with(kPlanesEnd)) continue;
    fs::path planes = folder / (name + std::string(kPlanesEnd) + ".csv");
    std::error_code ignored;
    if (!fs::exists(planes, ignored)) planes.clear();
    scenes.push_back({name, path, planes});
  }
  const std::string shown = printable(folder.string(), 4096);
  if (code) throw Error(ErrorCode::kIo, "cannot read the folder: " + code.message(), {.file = shown});
  if (scenes.empty()) throw Error(ErrorCode::kBadInput, "has no scenes NAME.csv", {.file = shown});
  std::sort(scenes.begin(), scenes.end(),
            [](const SceneFile& a, const SceneFile& b) { return a.name < b.name; });
  return scenes;
}

LabelledCloud read_scene(const SceneFile& file) {
  LabelledCloud scene;
  scene.cloud = read_cloud(file.points, {});
  if (scene.cloud.labels.empty()) {
    throw Error(ErrorCode::kBadInput, "has no points with a column `label`",
                {.file = printable(file.points.string(), 4096)});
  }
  if (file.planes.empty()) {
    scene.truth = truth_of_labels(scene.cloud);
  } else {
    read_planes(file.planes, scene);
  }
  return scene;
}

LabelledCloud as_read(const Scene& scene) {
  LabelledCloud read{.cloud = {.points = scene.points, .labels = scene.labels, .n_rows = scene.points.size()},
                     .truth = truth_of(scene)};
  for (std::uint64_t i = 0; i < scene.points.size(); ++i) read.cloud.rows.push_back(i);
  return read;
}

std::string print_scene_points(const Scene& scene) {
  log::RowWriter out(',');
  out.word("x,y,z,label").end_row();
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Vec3& point = scene.points[i];
    out.number(point.x()).number(point.y()).number(point.z()).word(std::to_string(scene.labels[i])).end_row();
  }
  return out.take();
}

std::string print_scene_planes(const Scene& scene) {
  log::RowWriter out(',');
  out.word(kPlaneColumns).end_row();
  for (const SceneRectangle& r : scene.rectangles) {
    out.whole(static_cast<std::uint64_t>(r.label));
    for (const Vec3& v : {r.centre, r.normal, r.u}) out.number(v.x()).number(v.y()).number(v.z());
    out.number(r.half_u).number(r.half_v).whole(r.points).number(r.noise).end_row();
  }
  return out.take();
}

}  // namespace hallway::planes
