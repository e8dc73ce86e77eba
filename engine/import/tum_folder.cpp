// SPDX-License-Identifier: MIT
#include "import/tum_folder.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "import/frame_list.hpp"
#include "import/true_track.hpp"
#include "import/words.hpp"
#include "log/tum.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxImageBytes = 256u << 20;
constexpr std::uint64_t kMaxImagePixels = 64u << 20;
constexpr std::uint32_t kDefaultWidth_px = 640, kDefaultHeight_px = 480;

fs::path find_list(const fs::path& folder, const TumOptions& options) {
  if (!options.list.empty()) return options.list;
  std::error_code code;
  for (const char* name : {"depth.txt", "associations.txt"}) {
    if (fs::exists(folder / name, code)) return folder / name;
  }
  throw Error(ErrorCode::kBadInput, "has neither depth.txt nor associations.txt",
              {.file = printable(folder.string())});
}

/// The camera's poses as those of the body.
TrueTrack read_truth(const fs::path& folder, std::int64_t within_ns) {
  const fs::path file = folder / "groundtruth.txt";
  std::error_code code;
  if (!fs::exists(file, code)) return {};
  std::vector<TimedPose> poses;
  for (const log::StampedPose& pose : log::read_tum(file)) {
    const auto t_ns = seconds_to_ns(pose.t_s);
    if (!t_ns) {
      throw Error(ErrorCode::kBadInput,
                  fmt::format("the time {} is not from 0 to 9e9 seconds", format_double(pose.t_s)),
                  {.file = printable(file.string())});
    }
    Pose T_world_optical = to_pose(pose.position_m, pose.orientation);
    T_world_optical.q.normalize();
    if (!poses.empty() && poses.back().t_ns == *t_ns) continue;
    poses.push_back({*t_ns, T_world_optical * optical_from_body()});
  }
  return {std::move(poses), within_ns};
}

class TumFolder : public Recording {
 public:
  TumFolder(std::vector<FrameFile> frames, TrueTrack truth, const TumOptions& options)
      : frames_(std::move(frames)), truth_(std::move(truth)), options_(options) {}

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(frames_.size()); }
  void read(std::uint32_t index, Frame& frame) override {
    const FrameFile& file = frames_[index];
    frame.t_ns = file.t_ns;
    frame.T_world_body = truth_.at(file.t_ns);
    PointCollector points(frame, 1);
    const std::string content = read_file(file.path, kMaxImageBytes);
    try {
      const Gray16 image = decode_gray16(content, kMaxImagePixels);
      add_depth_points(image, camera_for(image), options_.stride, points);
    } catch (const Error& error) {
      throw Error(error.code(), error.message(), {.file = printable(file.path.string(), 4096)});
    }
  }
  std::int64_t period_ns() const override {
    constexpr std::int64_t kUsual_ns = 33'333'333;
    return mean_period_ns(frames_.front().t_ns, frames_.back().t_ns, frames_.size(), kUsual_ns);
  }
  std::string sensor() const override { return "depth"; }
  bool has_truth() const override { return !truth_.empty(); }

 private:
  Camera camera_for(const Gray16& image) const {
    if (options_.camera) return *options_.camera;
    if (image.width_px == kDefaultWidth_px && image.height_px == kDefaultHeight_px) return {};
    throw Error(
        ErrorCode::kUsage,
        fmt::format("has {} x {} pixels; the default camera is for {} x {}: --camera fx,fy,cx,cy is needed",
                    image.width_px, image.height_px, kDefaultWidth_px, kDefaultHeight_px));
  }

  std::vector<FrameFile> frames_;
  TrueTrack truth_;
  TumOptions options_;
};

}  // namespace

std::unique_ptr<Recording> open_tum(const fs::path& folder, const TumOptions& options) {
  std::vector<FrameFile> frames = read_frame_list(find_list(folder, options), folder);
  return std::make_unique<TumFolder>(std::move(frames), read_truth(folder, options.truth_within_ns), options);
}

}  // namespace hallway::import
