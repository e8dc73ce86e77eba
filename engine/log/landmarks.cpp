// SPDX-License-Identifier: MIT
#include "log/landmarks.hpp"

#include <algorithm>

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kX, kY, kZ, kMoving };

}  // namespace

std::vector<Landmark> parse_landmarks(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"landmark_id"}, {"x"}, {"y"}, {"z"}, {"moving", false}});
  std::vector<Landmark> landmarks;
  UniqueIds ids;
  while (row.next()) {
    const LandmarkId id = ids.read(row, kId);
    landmarks.push_back({id, row.vector(kX), row.has(kMoving) && row.whole(kMoving, 1) == 1});
  }
  return landmarks;
}

std::vector<Landmark> read_landmarks(const std::filesystem::path& path) {
  return parse_landmarks(read_file(path), path.string());
}

std::string print_landmarks(std::span<const Landmark> landmarks) {
  RowWriter out(',');
  const bool any_moves = std::ranges::any_of(landmarks, [](const Landmark& l) { return l.moving; });
  out.word(any_moves ? "landmark_id,x,y,z,moving" : "landmark_id,x,y,z").end_row();
  for (const Landmark& landmark : landmarks) {
    out.whole(landmark.id).numbers(landmark.position_m);
    if (any_moves) out.whole(landmark.moving ? 1 : 0);
    out.end_row();
  }
  return out.take();
}

void write_landmarks(const std::filesystem::path& path, std::span<const Landmark> landmarks) {
  write_file_atomically(path, print_landmarks(landmarks));
}

}  // namespace hallway::log
