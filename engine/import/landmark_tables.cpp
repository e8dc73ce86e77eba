// SPDX-License-Identifier: MIT
#include "import/landmark_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "import/point_table.hpp"
#include "import/word_lines.hpp"
#include "import/words.hpp"
#include "log/csv_reader.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using TruePoses = std::vector<std::optional<Pose>>;  ///< by frame

/// What the ids of a table are.
enum class Ids { kTracks, kIdentities };

class TableRecording : public Recording {
 public:
  TableRecording(PointTable table, Ids ids, std::string sensor, TruePoses poses,
                 std::optional<std::vector<log::Landmark>> landmarks)
      : table_(std::move(table)),
        ids_(ids),
        sensor_(std::move(sensor)),
        poses_(std::move(poses)),
        landmarks_(std::move(landmarks)) {}

  std::uint32_t frames() const override { return table_.frames(); }
  void read(std::uint32_t index, Frame& frame) override {
    const auto begin = static_cast<std::ptrdiff_t>(table_.begin[index]);
    const auto end = static_cast<std::ptrdiff_t>(table_.begin[index + 1]);
    frame = Frame();
    frame.t_ns = table_.t_ns[index];
    frame.points.assign(table_.points.begin() + begin, table_.points.begin() + end);
    std::vector<std::uint64_t>& ids = ids_ == Ids::kTracks ? frame.tracks : frame.identities;
    ids.assign(table_.ids.begin() + begin, table_.ids.begin() + end);
    if (index < poses_.size()) frame.T_world_body = poses_[index];
  }
  std::int64_t period_ns() const override {
    constexpr std::int64_t kUsual_ns = 100'000'000;
    return mean_period_ns(table_.t_ns.front(), table_.t_ns.back(), table_.t_ns.size(), kUsual_ns);
  }
  std::string sensor() const override { return sensor_; }
  bool has_truth() const override { return !poses_.empty(); }
  bool has_tracks() const override { return ids_ == Ids::kTracks; }
  bool has_identities() const override { return ids_ == Ids::kIdentities; }
  const std::optional<std::vector<log::Landmark>>& true_landmarks() const override { return landmarks_; }

 private:
  PointTable table_;
  Ids ids_;
  std::string sensor_;
  TruePoses poses_;
  std::optional<std::vector<log::Landmark>> landmarks_;
};

/// The file that was asked for; else the one beside `table` whose name ends in `ending` where the table's ends in `end`, if it is there.
std::optional<fs::path> file_beside(const fs::path& asked_for, const fs::path& table, std::string_view end,
                                    std::string_view ending) {
  if (!asked_for.empty()) return asked_for;
  std::string name = table.filename().string();
  if (!name.ends_with(end)) return std::nullopt;
  name.replace(name.size() - end.size(), end.size(), ending);
  std::error_code code;
  const fs::path path = table.parent_path() / name;
  return fs::exists(path, code) ? std::optional(path) : std::nullopt;
}

std::string shown(const fs::path& path) {
  return printable(path.string(), 4096);
}

Quat orientation_in(const log::CsvReader& rows, std::size_t first_column) {
  constexpr double kMostSkew = 1e-3;
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r(i, j) = rows.number(first_column + static_cast<std::size_t>(3 * i + j));
  }
  const double skew = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(skew <= kMostSkew) || r.determinant() < 0.0) throw rows.error("r00 to r22 are no rotation");
  return Quat(r).normalized();
}

/// The poses of the first `frames` frames that have one. Poses of later frames are checked and left out: no frame's points go with them.
TruePoses read_camera_poses(const fs::path& path, std::uint32_t frames) {
  const std::string text = read_file(path);
  log::CsvReader rows(text, shown(path),
                      {{"frame"},
                       {"r00"},
                       {"r01"},
                       {"r02"},
                       {"r10"},
                       {"r11"},
                       {"r12"},
                       {"r20"},
                       {"r21"},
                       {"r22"},
                       {"tx"},
                       {"ty"},
                       {"tz"}});
  enum Column : std::size_t { kFrame, kRotation, kPosition = 10 };
  // Camera: x right, y down, z forward; body: x forward, y left, z up.
  Eigen::Matrix3d body_axes;
  body_axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Pose T_body_camera{Quat(body_axes), Vec3::Zero()};
  TruePoses poses;
  std::int64_t last = -1;
  while (rows.next()) {
    const std::uint32_t frame = rows.later_iteration(kFrame, last);
    last = frame;
    const Vec3 t = to_vec3(rows.vector(kPosition));
    const Pose T_world_camera{orientation_in(rows, kRotation), t};
    if (frame >= frames) continue;
    poses.resize(frame + std::size_t{1});
    poses[frame] = T_body_camera * T_world_camera * T_body_camera.inverse();
  }
  return poses;
}

/// The numbers of the lines of a text that are no comments, one list for each line. Throws for lines that have not `least` to `most` of them.
std::vector<std::vector<double>> read_number_lines(const fs::path& path, std::size_t least,
                                                   std::size_t most) {
  const std::string text = read_file(path);
  WordLines lines(text, shown(path));
  std::vector<std::vector<double>> rows;
  while (lines.next()) {
    if (lines.words().front().starts_with('%')) continue;
    if (lines.words().size() < least || lines.words().size() > most) {
      throw lines.error(
          fmt::format("{} to {} numbers are needed, {} words found", least, most, lines.words().size()));
    }
    rows.emplace_back();
    for (const std::string_view word : lines.words()) {
      const auto number = parse_coordinate(word);
      if (!number || !std::isfinite(*number)) {
        throw lines.error(fmt::format("a number is needed, \"{}\" found", printable(word, 40)));
      }
      rows.back().push_back(*number);
    }
  }
  return rows;
}

TruePoses read_robot_path(const fs::path& path) {
  TruePoses poses;
  for (const auto& row : read_number_lines(path, 6, 6)) {
    poses.push_back(Pose{from_yaw_pitch_roll(row[3], row[4], row[5]), Vec3(row[0], row[1], row[2])});
  }
  return poses;
}

std::vector<log::Landmark> read_true_landmarks(const fs::path& path) {
  constexpr double kMaxId = 9e15;  // below which whole numbers are exact
  std::vector<log::Landmark> landmarks;
  std::set<log::LandmarkId> ids;
  for (const auto& row : read_number_lines(path, 4, 64)) {
    const double id = row.back();
    if (!(id >= 0.0 && id <= kMaxId) || id != std::floor(id) ||
        !ids.insert(static_cast<log::LandmarkId>(id)).second) {
      throw Error(ErrorCode::kBadInput, fmt::format("{} is no id, or one that stands twice", id),
                  {.file = shown(path)});
    }
    landmarks.push_back({static_cast<log::LandmarkId>(id), {row[0], row[1], row[2]}});
  }
  return landmarks;
}

}  // namespace

std::unique_ptr<Recording> open_stereo_tracks(const fs::path& table, const LandmarkTableOptions& options) {
  PointTable points =
      parse_point_table(read_file(table), shown(table), PointColumns::kCamera, options.period_ns);
  TruePoses poses;
  if (const auto path = file_beside(options.true_poses, table, "obs3d.csv", "ins_campose.csv")) {
    poses = read_camera_poses(*path, points.frames());
  }
  return std::make_unique<TableRecording>(std::move(points), Ids::kTracks, "stereo", std::move(poses),
                                          std::nullopt);
}

std::unique_ptr<Recording> open_range_bearing(const fs::path& table, const LandmarkTableOptions& options) {
  PointTable points =
      parse_point_table(read_file(table), shown(table), PointColumns::kSpherical, options.period_ns);
  TruePoses poses;
  std::optional<std::vector<log::Landmark>> landmarks;
  if (const auto path = file_beside(options.true_poses, table, "obs.csv", "ground_truth_robot_path.txt")) {
    poses = read_robot_path(*path);
  }
  if (const auto path = file_beside(options.true_landmarks, table, "obs.csv", "ground_truth.txt")) {
    landmarks = read_true_landmarks(*path);
  }
  return std::make_unique<TableRecording>(std::move(points), Ids::kIdentities, "range-bearing",
                                          std::move(poses), std::move(landmarks));
}

}  // namespace hallway::import
