// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "import/kitti_odometry.hpp"
#include "import/new_folder.hpp"
#include "import/timed_poses.hpp"
#include "log/row_writer.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

std::string print_rows(std::string_view name, const PoseRows& rows) {
  log::RowWriter out(' ');
  if (!name.empty()) out.word(name);
  out.numbers(rows).end_row();
  return out.take();
}

fs::path sequence_folder(const fs::path& root, const std::string& name) {
  return root / "sequences" / name;
}

fs::path poses_file(const fs::path& root, const std::string& name) {
  return root / "poses" / (name + ".txt");
}

}  // namespace

KittiOdometryWriter::KittiOdometryWriter(const fs::path& root, const std::string& name,
                                         const Pose& T_cam0_velodyne)
    : root_(root), name_(name), T_cam0_velodyne_(T_cam0_velodyne) {
  const fs::path poses = poses_file(root, name);
  std::error_code code;
  if (fs::exists(fs::symlink_status(poses, code)))
    throw Error(ErrorCode::kIo, "is there already", {.file = printable(poses.string(), 4096)});
  make_new_folder(sequence_folder(root, name));
  make_folder(sequence_folder(root, name) / "velodyne");
}

void KittiOdometryWriter::add(std::int64_t t_ns, const LidarCloud& cloud,
                              const std::optional<Pose>& T_world_velodyne) {
  const fs::path path = sequence_folder(root_, name_) / "velodyne" / fmt::format("{:06}.bin", frames_);
  const std::string file = printable(path.string(), 4096);
  const auto refuse_cloud = [&](const std::string& cause) {
    throw Error(ErrorCode::kBadInput, cause, {.file = file});
  };
  if (frames_ == kMaxKittiFrames)
    refuse_cloud(fmt::format("a sequence has at most {} clouds", kMaxKittiFrames));
  if (t_ns <= last_ns_) refuse_cloud(fmt::format("the time {} ns is not after {} ns", t_ns, last_ns_));
  if (t_ns >= kTimesEnd_ns) refuse_cloud(fmt::format("the time {} ns is not below 9e9 s", t_ns));
  if (frames_ > 0 && T_world_velodyne.has_value() != has_poses_)
    refuse_cloud("a sequence has the poses of all its clouds, or of none");
  if (T_world_velodyne && !is_sound(*T_world_velodyne))
    refuse_cloud("the pose is not finite, or no rotation");
  write_file_atomically(path, print_kitti_cloud(cloud, file));
  times_ += format_seconds(t_ns) + "\n";
  if (T_world_velodyne) {
    const Pose& Tr = T_cam0_velodyne_;
    poses_ += print_rows({}, rows_of(Tr * *T_world_velodyne * Tr.inverse()));
  }
  has_poses_ = T_world_velodyne.has_value();
  last_ns_ = t_ns;
  ++frames_;
}

void KittiOdometryWriter::close() {
  const fs::path folder = sequence_folder(root_, name_);
  if (frames_ == 0)
    throw Error(ErrorCode::kBadInput, "there are no clouds to write",
                {.file = printable(folder.string(), 4096)});
  std::string calibration;
  for (const char* camera : {"P0:", "P1:", "P2:", "P3:"}) calibration += print_rows(camera, rows_of({}));
  calibration += print_rows("Tr:", rows_of(T_cam0_velodyne_));
  write_file_atomically(folder / "calib.txt", calibration);
  write_file_atomically(folder / "times.txt", times_);
  if (!has_poses_) return;
  make_folder(root_ / "poses");
  write_file_atomically(poses_file(root_, name_), poses_);
}

}  // namespace hallway::import
