// SPDX-License-Identifier: MIT
#include "log/map_landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kX, kY, kZ, kObservations, kStatus, kCovariance };

constexpr std::size_t kCovarianceSize = 6;

constexpr std::array<std::string_view, 3> kStatusNames = {"temporary", "mapped", "dynamic"};

LandmarkStatus read_status(const CsvReader& row) {
  const auto status = landmark_status(row.text(kStatus));
  if (!status) throw row.bad_field(kStatus, "\"temporary\", \"mapped\" or \"dynamic\"");
  return *status;
}

/// Whether the table has covariances. Throws for a header with a part of their columns.
bool has_covariances(const CsvReader& row) {
  std::size_t parts = 0;
  for (std::size_t i = 0; i < kCovarianceSize; ++i) parts += row.has(kCovariance + i) ? 1u : 0u;
  if (parts != 0 && parts != kCovarianceSize)
    throw row.error("the header has a part of the columns cov_xx … cov_zz; give all or none");
  return parts != 0;
}

/// Empty where the row's six fields are.
std::optional<std::array<double, kCovarianceSize>> read_covariance(const CsvReader& row) {
  std::size_t empty = 0;
  for (std::size_t i = 0; i < kCovarianceSize; ++i) empty += row.text(kCovariance + i).empty() ? 1u : 0u;
  if (empty == kCovarianceSize) return std::nullopt;
  std::array<double, kCovarianceSize> covariance{};
  for (std::size_t i = 0; i < kCovarianceSize; ++i) covariance[i] = row.number(kCovariance + i);
  return covariance;
}

/// PLY knows whole numbers of 32 bits at most.
std::uint64_t ply_uint(std::uint64_t value) {
  return std::min<std::uint64_t>(value, std::numeric_limits<std::uint32_t>::max());
}

}  // namespace

std::string_view landmark_status_name(LandmarkStatus status) {
  return kStatusNames.at(static_cast<std::size_t>(status));
}

std::optional<LandmarkStatus> landmark_status(std::string_view name) {
  const auto found = std::ranges::find(kStatusNames, name);
  if (found == kStatusNames.end()) return std::nullopt;
  return static_cast<LandmarkStatus>(found - kStatusNames.begin());
}

std::vector<MapLandmark> parse_map_landmarks(std::string_view text, const std::string& file) {
  CsvReader row(text, file,
                {{"id"},
                 {"x"},
                 {"y"},
                 {"z"},
                 {"observations"},
                 {"status"},
                 {"cov_xx", false},
                 {"cov_xy", false},
                 {"cov_xz", false},
                 {"cov_yy", false},
                 {"cov_yz", false},
                 {"cov_zz", false}});
  const bool covariances = has_covariances(row);
  std::vector<MapLandmark> landmarks;
  UniqueIds ids;
  while (row.next()) {
    const LandmarkId id = ids.read(row, kId);
    const std::uint64_t observations = row.whole(kObservations, std::numeric_limits<std::uint64_t>::max());
    landmarks.push_back({id, row.vector(kX), observations, read_status(row)});
    if (covariances) landmarks.back().covariance = read_covariance(row);
  }
  return landmarks;
}

std::vector<MapLandmark> read_map_landmarks(const std::filesystem::path& path) {
  return parse_map_landmarks(read_file(path), path.string());
}

std::string print_map_landmarks(std::span<const MapLandmark> landmarks) {
  RowWriter out(',');
  const bool covariances =
      std::ranges::any_of(landmarks, [](const MapLandmark& l) { return l.covariance.has_value(); });
  out.word("id,x,y,z,observations,status");
  if (covariances) out.word("cov_xx,cov_xy,cov_xz,cov_yy,cov_yz,cov_zz");
  out.end_row();
  for (const MapLandmark& landmark : landmarks) {
    out.whole(landmark.id).numbers(landmark.position_m).whole(landmark.observations);
    out.word(landmark_status_name(landmark.status));
    if (landmark.covariance) {
      out.numbers(*landmark.covariance);
    } else if (covariances) {
      for (std::size_t i = 0; i < kCovarianceSize; ++i) out.word("");
    }
    out.end_row();
  }
  return out.take();
}

void write_map_landmarks(const std::filesystem::path& path, std::span<const MapLandmark> landmarks) {
  write_file_atomically(path, print_map_landmarks(landmarks));
}

std::string print_landmarks_ply(std::span<const MapLandmark> landmarks) {
  RowWriter out(' ');
  for (const std::string_view line : {"ply", "format ascii 1.0", "comment landmarks in the map frame, metres",
                                      "comment status: 0 temporary, 1 mapped, 2 dynamic"}) {
    out.word(line).end_row();
  }
  out.word("element vertex").whole(landmarks.size()).end_row();
  for (const std::string_view property :
       {"double x", "double y", "double z", "uint id", "uint observations", "uchar status"}) {
    out.word("property").word(property).end_row();
  }
  out.word("end_header").end_row();
  for (const MapLandmark& landmark : landmarks) {
    out.numbers(landmark.position_m).whole(ply_uint(landmark.id)).whole(ply_uint(landmark.observations));
    out.whole(static_cast<std::uint64_t>(landmark.status)).end_row();
  }
  return out.take();
}

void write_landmarks_ply(const std::filesystem::path& path, std::span<const MapLandmark> landmarks) {
  write_file_atomically(path, print_landmarks_ply(landmarks));
}

}  // namespace hallway::log
