// SPDX-License-Identifier: MIT
//
// Tables of followed points and of landmarks by range and bearing, and the truth that stands beside them. Whatever the bytes are, they are refused
// with an Error that names their file, or every frame is sound. The first byte chooses what the rest is; the other files are good ones.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "import/landmark_tables.hpp"

namespace {

using namespace hallway;

enum What : std::uint8_t { kTracks, kCameraPoses, kRangeBearing, kRobotPath, kLandmarks, kCount };

void demand(bool condition) {
  if (!condition) std::abort();
}

/// Bytes that have a path, in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : fd_(memfd_create("bytes", MFD_CLOEXEC)) {
    demand(fd_ >= 0 && write(fd_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    path_ = "/proc/self/fd/" + std::to_string(fd_);
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  int fd_;
  std::string path_;
};

std::unique_ptr<import::Recording> open(What what, const std::string& bytes) {
  static const MemoryFile tracks("frame,id,x_right_m,y_down_m,z_fwd_m\n0,0,1,0,5\n3,1,1,0,6\n");
  static const MemoryFile bearings("frame,id,range_m,yaw_rad,pitch_rad\n0,0,1,0,0.5\n2,1,1,0,0.25\n");
  switch (what) {
    case kTracks:
      return import::open_stereo_tracks(bytes, {});
    case kCameraPoses:
      return import::open_stereo_tracks(tracks.path(), {.true_poses = bytes});
    case kRangeBearing:
      return import::open_range_bearing(bytes, {});
    case kRobotPath:
      return import::open_range_bearing(bearings.path(), {.true_poses = bytes});
    default:
      return import::open_range_bearing(bearings.path(), {.true_landmarks = bytes});
  }
}

void check_frames(import::Recording& recording) {
  demand(recording.frames() > 0 && recording.period_ns() > 0);
  std::int64_t t_ns = 0;
  import::Frame frame;
  for (std::uint32_t i = 0; i < recording.frames(); ++i) {
    recording.read(i, frame);
    demand(frame.t_ns >= t_ns);
    t_ns = frame.t_ns;
    const auto& ids = recording.has_tracks() ? frame.tracks : frame.identities;
    demand(ids.size() == frame.points.size() && std::set(ids.begin(), ids.end()).size() == ids.size());
    for (const auto& point : frame.points) {
      for (const double x : point) demand(std::isfinite(x));
    }
    if (frame.T_world_body) demand(std::abs(frame.T_world_body->q.norm() - 1.0) < 1e-6);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const MemoryFile file(std::string_view(reinterpret_cast<const char*>(data + 1), size - 1));
  try {
    check_frames(*open(static_cast<What>(data[0] % kCount), file.path()));
  } catch (const Error& error) {
    demand(error.code() == ErrorCode::kBadInput && error.where().file == file.path());
  }
  return 0;
}
