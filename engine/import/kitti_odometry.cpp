// SPDX-License-Identifier: MIT
#include "import/kitti_odometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "import/depth_camera.hpp"
#include "import/point_records.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPointBytes = 4 * sizeof(float);
constexpr const char* kClouds = "velodyne";

[[noreturn]] void refuse_path(const fs::path& path, const std::string& cause,
                              ErrorCode code = ErrorCode::kBadInput) {
  throw Error(code, cause, {.file = printable(path.string(), 4096)});
}

std::string cloud_name(std::uint32_t index) {
  return fmt::format("{:06}.bin", index);
}

/// The one sequence that a folder has under `sequences`; the folder itself where there are none.
fs::path sequence_in(const fs::path& folder) {
  const fs::path above = folder / "sequences";
  std::error_code code;
  if (!fs::is_directory(above, code)) return folder;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(above, code), end; !code && entry != end; entry.increment(code)) {
    std::error_code ignored;
    if (entry->is_directory(ignored)) found.push_back(entry->path());
  }
  if (code) refuse_path(above, "cannot read the folder: " + code.message(), ErrorCode::kIo);
  if (found.size() != 1)
    refuse_path(above, fmt::format("has {} sequences; name the folder of one", found.size()));
  return found.front();
}

/// Checks that an entry is a file of whole points, and marks its number.
void note_cloud(const fs::directory_entry& entry, std::vector<bool>& there) {
  const std::string stem = entry.path().stem().string();
  const auto number = parse_uint(stem);
  if (stem.size() != 6 || !number)
    refuse_path(entry.path(), "has no name of six digits, as the clouds of a sequence have");
  std::error_code code;
  if (!entry.is_regular_file(code)) refuse_path(entry.path(), "is not a regular file", ErrorCode::kIo);
  const std::uint64_t size = entry.file_size(code);
  if (code) refuse_path(entry.path(), "cannot read its size: " + code.message(), ErrorCode::kIo);
  if (size % kPointBytes != 0) {
    throw Error(
        ErrorCode::kBadInput,
        fmt::format("{} bytes are no whole points of {} bytes: the file is cut off, or is something else",
                    size, kPointBytes),
        {.file = printable(entry.path().string(), 4096),
         .element = fmt::format("byte {}", size / kPointBytes * kPointBytes)});
  }
  if (*number >= there.size()) there.resize(static_cast<std::size_t>(*number) + 1);
  there[static_cast<std::size_t>(*number)] = true;
}

/// Checks that the clouds of a folder are numbered without a gap; gives how many there are.
std::size_t count_clouds(const fs::path& folder) {
  std::vector<bool> there;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (entry->path().extension() == ".bin") note_cloud(*entry, there);
  }
  if (code) refuse_path(folder, "cannot read the folder: " + code.message(), ErrorCode::kIo);
  if (there.empty()) refuse_path(folder, "has no clouds (000000.bin and so on)");
  const auto gap = std::find(there.begin(), there.end(), false);
  if (gap != there.end()) {
    refuse_path(folder / cloud_name(static_cast<std::uint32_t>(gap - there.begin())),
                fmt::format("is missing: clouds go on to {}",
                            cloud_name(static_cast<std::uint32_t>(there.size() - 1))));
  }
  return there.size();
}

/// Beside the folder `sequences`.
fs::path poses_of(const fs::path& sequence) {
  const fs::path whole = fs::absolute(sequence).lexically_normal();
  const fs::path folder = whole.has_filename() ? whole : whole.parent_path();
  return folder.parent_path().parent_path() / "poses" / (folder.filename().string() + ".txt");
}

void expect_count(const fs::path& file, std::size_t count, const char* what, std::size_t clouds) {
  if (count != clouds) refuse_path(file, fmt::format("has {} {} for {} clouds", count, what, clouds));
}

bool is_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(fs::symlink_status(path, code));
}

}  // namespace

Pose kitti_cam0_velodyne() {
  return optical_from_body();
}

std::optional<Pose> KittiSequence::T_world_velodyne(std::uint32_t index) const {
  if (!has_truth()) return std::nullopt;
  const Pose& Tr = calibration.T_cam0_velodyne;
  return Tr.inverse() * T_world_cam0[index] * Tr;
}

fs::path KittiSequence::cloud_file(std::uint32_t index) const {
  return folder / kClouds / cloud_name(index);
}

LidarCloud KittiSequence::cloud(std::uint32_t index) const {
  const fs::path file = cloud_file(index);
  return parse_kitti_cloud(read_file(file, kMaxCloudBytes), printable(file.string(), 4096));
}

KittiSequence open_kitti_odometry(const fs::path& folder) {
  KittiSequence sequence;
  sequence.folder = sequence_in(folder);
  const auto read = [](const fs::path& file, auto parse) {
    return parse(read_file(file, kMaxCloudBytes), printable(file.string(), 4096));
  };
  const fs::path times = sequence.folder / "times.txt", poses = poses_of(sequence.folder);
  sequence.calibration = read(sequence.folder / "calib.txt", parse_kitti_calibration);
  sequence.t_ns = read(times, parse_kitti_times);
  const std::size_t clouds = count_clouds(sequence.folder / kClouds);
  expect_count(times, sequence.t_ns.size(), "times", clouds);
  if (is_there(poses)) {
    sequence.T_world_cam0 = read(poses, parse_kitti_poses);
    expect_count(poses, sequence.T_world_cam0.size(), "poses", clouds);
  }
  return sequence;
}

LidarCloud parse_kitti_cloud(std::string_view bytes, const std::string& file) {
  const auto error_at = [&](std::size_t byte, const std::string& cause) {
    return Error(ErrorCode::kBadInput, cause, {.file = file, .element = fmt::format("byte {}", byte)});
  };
  if (const std::size_t part = bytes.size() % kPointBytes; part != 0) {
    throw error_at(
        bytes.size() - part,
        fmt::format("{} bytes follow, and a point has {}: the file is cut off, or is something else", part,
                    kPointBytes));
  }
  Frame frame;
  PointCollector points(frame, 1);
  LidarCloud cloud;
  for (std::size_t byte = 0; byte < bytes.size(); byte += kPointBytes) {
    const auto [x, y, z, reflectance] = load<std::array<float, 4>>(bytes.data() + byte);
    const std::size_t before = frame.points.size();
    try {
      points.add(x, y, z);
    } catch (const Error& error) {
      throw error_at(byte, error.message());
    }
    if (frame.points.size() == before) continue;
    if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > static_cast<float>(kMaxImport_m)) {
      throw error_at(
          byte, fmt::format("a coordinate lies beyond {:g} m: these are no points of four float32 numbers",
                            kMaxImport_m));
    }
    cloud.intensity.push_back(std::isfinite(reflectance) ? reflectance
                                                         : std::numeric_limits<float>::quiet_NaN());
  }
  cloud.points = std::move(frame.points);
  cloud.not_finite = frame.not_finite;
  return cloud;
}

std::string print_kitti_cloud(const LidarCloud& cloud, const std::string& file) {
  check_cloud(cloud, file);
  std::string bytes;
  bytes.reserve(cloud.points.size() * kPointBytes);
  ByteAppender out(bytes);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double x : cloud.points[i]) out.put(static_cast<float>(x));
    out.put(cloud.intensity.empty() ? 0.0f : cloud.intensity[i]);
  }
  return bytes;
}

}  // namespace hallway::import
