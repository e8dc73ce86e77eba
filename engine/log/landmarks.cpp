// SPDX-License-Identifier: MIT
#include "log/landmarks.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kX, kY, kZ };

}  // namespace

std::vector<Landmark> parse_landmarks(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"landmark_id"}, {"x"}, {"y"}, {"z"}});
  std::vector<Landmark> landmarks;
  UniqueIds ids;
  while (row.next()) {
    const LandmarkId id = ids.read(row, kId);
    landmarks.push_back({id, row.vector(kX)});
  }
  return landmarks;
}

std::vector<Landmark> read_landmarks(const std::filesystem::path& path) {
  return parse_landmarks(read_file(path), path.string());
}

std::string print_landmarks(std::span<const Landmark> landmarks) {
  RowWriter out(',');
  out.word("landmark_id,x,y,z").end_row();
  for (const Landmark& landmark : landmarks) out.whole(landmark.id).numbers(landmark.position_m).end_row();
  return out.take();
}

void write_landmarks(const std::filesystem::path& path, std::span<const Landmark> landmarks) {
  write_file_atomically(path, print_landmarks(landmarks));
}

}  // namespace hallway::log
