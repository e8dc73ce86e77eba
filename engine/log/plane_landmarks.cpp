// SPDX-License-Identifier: MIT
#include "log/plane_landmarks.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t {
  kId,
  kObservations,
  kStatus,
  kNormal,
  kOffset = kNormal + 3,
  kCorner,
  kPosition,
  kEdge = kPosition + 3
};

constexpr std::uint64_t kMaxWhole = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kLeastCorners = 3;

std::vector<CsvColumn> columns() {
  return {{"plane_id"}, {"observations"}, {"status"}, {"nx"}, {"ny"}, {"nz"},
          {"offset_m"}, {"corner"},       {"x"},      {"y"},  {"z"},  {"edge_certain"}};
}

PlaneLandmark read_plane(const CsvReader& row, LandmarkId id) {
  const auto status = landmark_status(row.text(kStatus));
  if (!status) throw row.bad_field(kStatus, "\"temporary\", \"mapped\" or \"dynamic\"");
  return {.id = id,
          .observations = row.whole(kObservations, kMaxWhole),
          .status = *status,
          .normal = row.vector(kNormal),
          .offset_m = row.number(kOffset)};
}

void check_complete(const CsvReader& row, const std::vector<PlaneLandmark>& planes) {
  if (!planes.empty() && planes.back().outline.size() < kLeastCorners)
    throw row.error(fmt::format("plane {} has fewer than {} corners", planes.back().id, kLeastCorners));
}

}  // namespace

std::vector<PlaneLandmark> parse_plane_landmarks(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  std::vector<PlaneLandmark> planes;
  UniqueIds ids;
  while (row.next()) {
    if (row.whole(kCorner, kMaxWhole) == 0) {
      check_complete(row, planes);
      planes.push_back(read_plane(row, ids.read(row, kId)));
    }
    if (planes.empty() || row.whole(kId, kNoLandmark - 1) != planes.back().id)
      throw row.bad_field(kCorner, "0 in the first row of a plane");
    PlaneLandmark& plane = planes.back();
    if (row.whole(kCorner, kMaxWhole) != plane.outline.size())
      throw row.bad_field(kCorner, fmt::format("{}", plane.outline.size()));
    plane.outline.push_back({.position_m = row.vector(kPosition), .edge_certain = row.whole(kEdge, 1) == 1});
  }
  check_complete(row, planes);
  return planes;
}

std::vector<PlaneLandmark> read_plane_landmarks(const std::filesystem::path& path) {
  return parse_plane_landmarks(read_file(path), path.string());
}

std::string print_plane_landmarks(std::span<const PlaneLandmark> planes) {
  RowWriter out(',');
  for (const CsvColumn& column : columns()) out.word(column.name);
  out.end_row();
  for (const PlaneLandmark& plane : planes) {
    for (std::size_t i = 0; i < plane.outline.size(); ++i) {
      const OutlineCorner& corner = plane.outline[i];
      out.whole(plane.id).whole(plane.observations).word(landmark_status_name(plane.status));
      out.numbers(plane.normal).number(plane.offset_m).whole(i).numbers(corner.position_m);
      out.whole(corner.edge_certain ? 1 : 0).end_row();
    }
  }
  return out.take();
}

void write_plane_landmarks(const std::filesystem::path& path, std::span<const PlaneLandmark> planes) {
  write_file_atomically(path, print_plane_landmarks(planes));
}

}  // namespace hallway::log
