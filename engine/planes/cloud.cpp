// SPDX-License-Identifier: MIT
#include "planes/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "image/png.hpp"
#include "import/pcd.hpp"
#include "import/ply.hpp"
#include "import/point_records.hpp"
#include "import/word_lines.hpp"
#include "import/words.hpp"
#include "log/csv_reader.hpp"
#include "planes/fit.hpp"

namespace hallway::planes {
namespace {

namespace fs = std::filesystem;

enum class CloudKind { kPly, kPcd, kCsv, kObj, kDepth };

constexpr std::string_view kPngMagic{"\x89PNG\r\n\x1a\n", 8};

std::optional<CloudKind> kind_of(std::string_view content, const fs::path& path) {
  if (content.starts_with("ply")) return CloudKind::kPly;
  if (content.starts_with("# .PCD")) return CloudKind::kPcd;
  if (content.starts_with(kPngMagic)) return CloudKind::kDepth;
  const std::string extension = import::lower_case(path.extension().string());
  constexpr std::pair<std::string_view, CloudKind> kNames[] = {{".ply", CloudKind::kPly},
                                                               {".pcd", CloudKind::kPcd},
                                                               {".csv", CloudKind::kCsv},
                                                               {".obj", CloudKind::kObj},
                                                               {".png", CloudKind::kDepth}};
  for (const auto& [name, kind] : kNames) {
    if (name == extension) return kind;
  }
  return std::nullopt;
}

enum Column : std::size_t { kX, kY, kZ, kLabel };

double coordinate(const log::CsvReader& row, std::size_t column) {
  const auto value = import::parse_coordinate(row.text(column));
  if (!value) throw row.bad_field(column, "a number");
  return *value;
}

std::int64_t label_of(std::string_view text, std::int64_t unlabelled, const auto& bad) {
  if (text.empty()) return kNoLabel;
  const auto label = parse_int(text);
  if (!label) throw bad();
  return *label < 0 || *label == unlabelled ? kNoLabel : *label;
}

/// Labels of all rows go to `labels` where the file has a column of them.
void read_csv(std::string_view content, const std::string& file, const CloudOptions& options,
              import::PointCollector& out, std::vector<std::int64_t>& labels) {
  const CloudColumns& names = options.columns;
  log::CsvReader row(content, file, {{names.x}, {names.y}, {names.z}, {names.label, false}});
  while (row.next()) {
    out.add(coordinate(row, kX), coordinate(row, kY), coordinate(row, kZ));
    if (!row.has(kLabel)) continue;
    labels.push_back(label_of(row.text(kLabel), options.unlabelled,
                              [&] { return row.bad_field(kLabel, "a whole number"); }));
  }
}

void read_obj(std::string_view content, const std::string& file, import::PointCollector& out) {
  import::WordLines lines(content, file);
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.front() != "v") continue;
    double xyz[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = words.size() > i + 1 ? import::parse_coordinate(words[i + 1]) : std::nullopt;
      if (!value) throw lines.error("a vertex is `v` and three numbers");
      xyz[i] = *value;
    }
    out.add(xyz[0], xyz[1], xyz[2]);
  }
}

/// Points of the image, with their pixels as rows.
void read_depth(std::string_view content, const CloudOptions& options, import::PointCollector& out,
                std::vector<std::uint64_t>& pixels) {
  if (!options.camera) throw Error(ErrorCode::kUsage, "a depth image is read with --intrinsics fx,fy,cx,cy");
  const Gray16 image = decode_gray16(content, import::kMaxFramePoints);
  import::add_depth_points(image, *options.camera, 1, out, options.units_per_metre);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (image.values[i] != 0) pixels.push_back(i);
  }
}

/// For each point that was kept the value of its row.
template <typename T>
std::vector<T> of_points(const std::vector<std::uint64_t>& rows, const std::vector<T>& of_rows) {
  std::vector<T> values;
  values.reserve(rows.size());
  for (const std::uint64_t row : rows) values.push_back(of_rows[row]);
  return values;
}

Cloud parse_named(std::string_view content, const fs::path& path, const CloudOptions& options) {
  const std::string file = printable(path.string(), 4096);
  const auto kind = kind_of(content, path);
  if (content.empty() || !kind) {
    throw Error(ErrorCode::kBadInput, content.empty()
                                          ? "is empty"
                                          : "is no point cloud that is read here: PLY, PCD, CSV, OBJ, "
                                            "or a depth image in PNG");
  }
  Cloud cloud;
  import::Frame frame;
  import::PointCollector out(frame, 1, &cloud.rows);
  std::vector<std::int64_t> labels;
  std::vector<std::uint64_t> pixels;
  if (*kind == CloudKind::kPly) import::read_ply(content, file, out);
  if (*kind == CloudKind::kPcd) import::read_pcd(content, file, out);
  if (*kind == CloudKind::kCsv) read_csv(content, file, options, out, labels);
  if (*kind == CloudKind::kObj) read_obj(content, file, out);
  if (*kind == CloudKind::kDepth) read_depth(content, options, out, pixels);
  cloud.n_rows = out.given();
  cloud.not_finite = frame.not_finite;
  cloud.image = std::move(frame.image);
  cloud.points.reserve(frame.points.size());
  for (const auto& point : frame.points) cloud.points.emplace_back(point[0], point[1], point[2]);
  if (!labels.empty()) cloud.labels = of_points(cloud.rows, labels);
  if (*kind == CloudKind::kDepth) cloud.rows = of_points(cloud.rows, pixels);
  return cloud;
}

/// Runs `work`; its errors name the file.
template <typename Work>
auto naming(const fs::path& path, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (!error.where().file.empty() || error.code() == ErrorCode::kUsage) throw;
    throw Error(error.code(), error.message(), {.file = printable(path.string(), 4096)});
  }
}

}  // namespace

Cloud parse_cloud(std::string_view content, const fs::path& name, const CloudOptions& options) {
  return naming(name, [&] { return parse_named(content, name, options); });
}

Cloud read_cloud(const fs::path& path, const CloudOptions& options) {
  return parse_cloud(read_file(path, import::kMaxCloudBytes), path, options);
}

std::vector<std::int64_t> read_labels(const fs::path& path, const Cloud& cloud, std::int64_t unlabelled) {
  const std::string content = read_file(path, import::kMaxCloudBytes);
  log::LineReader lines(content, printable(path.string(), 4096));
  std::vector<std::int64_t> labels;
  for (bool first = true; lines.next(); first = false) {
    if (first && !parse_int(lines.line())) continue;  // a header
    labels.push_back(
        label_of(lines.line(), unlabelled, [&] { return lines.error("a label is a whole number"); }));
  }
  // The rows of an image are its pixels: as many labels as the last one needs.
  const std::uint64_t needed = cloud.rows.empty() ? 0 : cloud.rows.back() + 1;
  if (labels.size() < needed || labels.size() < cloud.n_rows) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("has {} labels for {} rows", labels.size(), std::max(needed, cloud.n_rows)),
                {.file = lines.file()});
  }
  return of_points(cloud.rows, labels);
}

Truth truth_of_labels(const Cloud& cloud) {
  std::map<std::int64_t, std::vector<Vec3>> points;
  for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
    if (cloud.labels[i] != kNoLabel) points[cloud.labels[i]].push_back(cloud.points[i]);
  }
  Truth truth{.labels = cloud.labels};
  for (const auto& [label, list] : points)
    truth.planes.push_back({.label = label, .plane = least_squares_plane(list)});
  return truth;
}

}  // namespace hallway::planes
