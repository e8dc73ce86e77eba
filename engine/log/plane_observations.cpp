// SPDX-License-Identifier: MIT
#include "log/plane_observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "log/csv_reader.hpp"
#include "log/plane_fields.hpp"
#include "log/plane_names.hpp"

namespace hallway::log {
namespace {

/// Both tables begin with the iteration and a name of the plane, which is its id or its true plane; then comes the geometry.
enum Column : std::size_t {
  kIteration,
  kName,
  kNormal,
  kOffset = kNormal + 3,
  kCentroid,
  kCorners = kCentroid + 3,
  kPoints = kCorners + 12,
  kRms,
  kExclusiveShare,
  kHull = kPoints  ///< of the table of observed planes
};

std::vector<std::string_view> geometry_columns() {
  const std::vector<std::string_view> names = split(kPlaneColumns, ',');
  return {names.begin() + kNormal, names.begin() + kPoints};
}

void read_geometry(const CsvReader& row, PlaneObservation& plane) {
  plane.normal = row.vector(kNormal);
  plane.offset_m = row.number(kOffset);
  plane.centroid_m = row.vector(kCentroid);
  plane.corners_m = read_corners(row, kCorners);
}

void add_geometry(RowWriter& out, const PlaneObservation& plane) {
  out.numbers(plane.normal).number(plane.offset_m).numbers(plane.centroid_m);
  for (const auto& corner : plane.corners_m) out.numbers(corner);
}

/// Of a table of observed planes as it is written.
struct ObservedColumns {
  bool identities = false;
  bool hulls = false;

  std::string header() const {
    std::string text = "iteration";
    if (identities) text += "," + std::string(plane_names::kTruePlaneColumn);
    for (const std::string_view name : geometry_columns()) text += "," + std::string(name);
    return hulls ? text + ",hull" : text;
  }
  void add_row(RowWriter& out, std::uint32_t iteration, const PlaneObservation& plane) const {
    out.whole(iteration);
    if (identities && plane.true_plane == kNoLandmark) out.word("-1");
    if (identities && plane.true_plane != kNoLandmark) out.whole(plane.true_plane);
    add_geometry(out, plane);
    if (hulls) out.word(hull_text(plane.hull_m));
    out.end_row();
  }
  /// Empty frames need no row but the last one, without which the log would seem to end earlier.
  void add_empty_row(RowWriter& out, std::uint32_t iteration) const {
    out.whole(iteration);
    for (std::size_t column = identities ? kName : kNormal; column < kHull; ++column) out.word("");
    if (hulls) out.word("");
    out.end_row();
  }
};

bool is_empty_frame(const CsvReader& row) {
  for (std::size_t column = kName; column < kHull; ++column) {
    if (!row.text(column).empty()) return false;
  }
  return true;
}

}  // namespace

std::vector<IterationPlane> parse_planes(std::string_view text, const std::string& file) {
  std::vector<CsvColumn> columns;
  for (const std::string_view name : split(kPlaneColumns, ',')) columns.push_back({name});
  CsvReader row(text, file, columns);
  std::vector<IterationPlane> planes;
  while (row.next()) {
    const auto iteration = static_cast<std::uint32_t>(row.whole(kIteration, kMaxIteration));
    if (!planes.empty() && iteration < planes.back().iteration)
      throw row.bad_field(kIteration, "an iteration not before that of the row above");
    PlaneObservation& plane = planes.emplace_back(IterationPlane{iteration, {}}).plane;
    plane.id = row.whole(kName, UINT64_MAX);
    read_geometry(row, plane);
    plane.points = row.whole(kPoints, UINT64_MAX);
    plane.rms_m = row.number(kRms);
    plane.exclusive_share = row.number(kExclusiveShare);
  }
  return planes;
}

void add_row(RowWriter& out, const IterationPlane& row) {
  const PlaneObservation& plane = row.plane;
  out.whole(row.iteration).whole(plane.id);
  add_geometry(out, plane);
  out.whole(plane.points).number(plane.rms_m).number(plane.exclusive_share).end_row();
}

bool is_of_planes(std::string_view text) {
  const std::string_view header = text.substr(0, text.find('\n'));
  const std::vector<std::string_view> names = split(header, ',');
  return std::any_of(names.begin(), names.end(),
                     [](std::string_view name) { return trim(name) == "offset_m"; });
}

ReadPlaneObservations parse_observed_planes(std::string_view text, const std::string& file) {
  std::vector<CsvColumn> columns{{"iteration"}, {plane_names::kTruePlaneColumn, false}};
  for (const std::string_view name : geometry_columns()) columns.push_back({name});
  columns.push_back({"hull", false});
  CsvReader row(text, file, columns);
  FrameRows<PlaneObservationLog, PlaneObservation> rows(PlaneObservationLog(row.has(kName)), "a plane");
  std::uint64_t iteration = 0, place = 0;  // the table does not number the planes of a frame
  auto damage = rows.read_all(
      row, kIteration, [&] { return is_empty_frame(row); },
      [&] {
        const std::uint64_t present = row.whole(kIteration, kMaxIteration);
        place = present == iteration ? place : 0;
        iteration = present;
        PlaneObservation plane{.true_plane = row.landmark_or_none(kName), .exclusive_share = 1.0};
        read_geometry(row, plane);
        plane.hull_m = read_hull(row, kHull);
        plane.id = place++;
        return plane;
      });
  return {rows.finish(), std::move(damage)};
}

std::string describe(const Damage& damage, const PlaneObservationLog& kept, const std::string& file) {
  return fmt::format("{}:{}: {}; kept what stands before: {} planes, iterations below {}", file, damage.line,
                     damage.cause, kept.all().size(), kept.iterations());
}

std::string print_observed_planes(const PlaneObservationLog& log) {
  const ObservedColumns columns{log.has_identities(), any_hull(log.all())};
  RowWriter out(',');
  out.word(columns.header()).end_row();
  for (const std::uint32_t iteration : log.filled_iterations()) {
    for (const PlaneObservation& plane : log.frame(iteration)) columns.add_row(out, iteration, plane);
  }
  if (log.iterations() > 0 && log.frame(log.iterations() - 1).empty())
    columns.add_empty_row(out, log.iterations() - 1);
  return out.take();
}

ObservedPlaneFile::ObservedPlaneFile(std::filesystem::path path, bool has_identities)
    : path_(std::move(path)), has_identities_(has_identities) {}

void ObservedPlaneFile::begin_rows() {
  rows_.emplace(path_, ',', ObservedColumns{has_identities_, has_hulls_}.header());
}

void ObservedPlaneFile::add_hull_column() {
  has_hulls_ = true;
  if (!rows_) return;
  rows_->close();
  const std::filesystem::path before = path_.string() + ".without_hulls";
  std::error_code failure;
  std::filesystem::rename(path_, before, failure);
  if (failure) throw Error(ErrorCode::kIo, "cannot rename: " + failure.message(), {.file = path_.string()});
  begin_rows();
  std::ifstream lines(before);
  std::string line;
  std::getline(lines, line);  // the header
  while (std::getline(lines, line)) rows_->next_row().word(line).word("").end_row();
  if (!lines.eof()) throw Error(ErrorCode::kIo, "cannot read", {.file = before.string()});
  std::filesystem::remove(before, failure);
}

void ObservedPlaneFile::add_frame(std::uint32_t iteration, std::span<const PlaneObservation> planes) {
  last_empty_.reset();
  if (planes.empty()) {
    last_empty_ = iteration;
    return;
  }
  if (!has_hulls_ && any_hull(planes)) add_hull_column();
  if (!rows_) begin_rows();
  for (const PlaneObservation& plane : planes)
    ObservedColumns{has_identities_, has_hulls_}.add_row(rows_->next_row(), iteration, plane);
}

void ObservedPlaneFile::close() {
  if (!rows_) begin_rows();
  if (last_empty_)
    ObservedColumns{has_identities_, has_hulls_}.add_empty_row(rows_->next_row(), *last_empty_);
  rows_->close();
}

void write_observed_planes(const std::filesystem::path& path, const PlaneObservationLog& log) {
  write_file_atomically(path, print_observed_planes(log));
}

}  // namespace hallway::log
