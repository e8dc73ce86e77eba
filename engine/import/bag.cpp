// SPDX-License-Identifier: MIT
#include "import/bag.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "import/bag_protocol.hpp"
#include "import/true_track.hpp"
#include "log/byte_io.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kUsualPeriod_ns = 100'000'000;

/// A bag may be large and its reader is waited for frame by frame: what it may use up is bounded by memory alone.
ChildLimits limits() {
  return {.wall_time = std::chrono::hours(24),
          .memory_bytes = std::uint64_t{4} << 30,
          .cpu_seconds = 24 * 3600,
          .output_bytes = std::uint64_t{1} << 50};
}

/// @param bag  that is to be read
fs::path find_reader(const std::string& bag) {
  try {
    return find_helper("hallway-bag");
  } catch (const Error& error) {
    throw Error(
        ErrorCode::kIo,
        "this Hallway was built without ROS 1 and reads no bags; install librosbag-storage-dev, "
        "libsensor-msgs-dev, libnav-msgs-dev and libgeometry-msgs-dev, then configure and build it again (" +
            error.message() + ")",
        Where{bag});
  }
}

/// One pass of the helper program through a bag.
class Pass {
 public:
  explicit Pass(const BagRequest& request) : child_(find_reader(request.file), {}, limits()) {
    child_.send(encode_request(request));
    child_.close_input();
    head_ = decode_head(next(BagMessageKind::kHead));
  }

  const BagHead& head() const { return head_; }
  void read(Frame& frame) { decode_frame(next(BagMessageKind::kFrame), frame); }

 private:
  const std::string& next(BagMessageKind wanted) {
    receive(kBagMessageStart);
    const BagMessageHeader header = decode_message_start(body_);
    receive(static_cast<std::size_t>(header.bytes));
    if (header.kind == BagMessageKind::kFailure) throw decode_failure(body_);
    if (header.kind != wanted) throw Error(ErrorCode::kBadInput, "the bag reader ended too early");
    return body_;
  }
  void receive(std::size_t bytes) {
    body_.resize(bytes);
    for (std::size_t done = 0; done < bytes;) {
      const std::size_t got = child_.receive(body_.data() + done, bytes - done);
      if (got == 0) {
        throw Error(ErrorCode::kBadInput,
                    "cannot be read: the bag reader " + describe(child_.wait(), limits()));
      }
      done += got;
    }
  }

  Child child_;
  BagHead head_;
  std::string body_;
};

/// In the order of time; of poses at the same time the first.
TrueTrack track_of(const std::vector<BagPose>& poses, std::int64_t within_ns) {
  std::vector<TimedPose> track;
  for (const BagPose& pose : poses) {
    const auto& [w, x, y, z] = pose.orientation;
    const auto& t = pose.position_m;
    const Quat q(w, x, y, z);
    const bool usable = pose.t_ns >= 0 && std::isfinite(t[0]) && std::isfinite(t[1]) && std::isfinite(t[2]) &&
                        is_unit_quaternion(pose.orientation, kUnitFileTolerance);
    if (usable) track.push_back({pose.t_ns, {q.normalized(), Vec3(t[0], t[1], t[2])}});
  }
  std::stable_sort(track.begin(), track.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.t_ns < b.t_ns; });
  track.erase(std::unique(track.begin(), track.end(),
                          [](const TimedPose& a, const TimedPose& b) { return a.t_ns == b.t_ns; }),
              track.end());
  return {std::move(track), within_ns};
}

class Bag : public Recording {
 public:
  Bag(const fs::path& path, const BagOptions& options)
      : name_(printable(path.string(), 4096)),
        request_{path.string(), options.topic, options.truth_topic, options.stride} {
    in_file([&] {
      pass_.emplace(request_);
      if (pass_->head().frames == 0) throw Error(ErrorCode::kBadInput, "holds no messages of the topic");
      if (pass_->head().frames > log::kMaxIteration)
        throw Error(ErrorCode::kBadInput, "holds too many messages");
    });
    head_ = pass_->head();
    truth_ = track_of(std::exchange(head_.truth, {}), options.truth_within_ns);
  }

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(head_.frames); }
  void read(std::uint32_t index, Frame& frame) override {
    in_file([&] {
      if (index < next_) restart();
      for (; next_ <= index; ++next_) pass_->read(frame);
    });
    frame.T_world_body = truth_.at(frame.t_ns);
  }
  std::int64_t period_ns() const override {
    return mean_period_ns(head_.first_ns, head_.last_ns, head_.frames, kUsualPeriod_ns);
  }
  std::string sensor() const override { return head_.topic; }
  bool has_truth() const override { return !truth_.empty(); }

 private:
  void restart() {
    pass_.emplace(request_);
    next_ = 0;
  }
  /// Errors of `work` get the file's name.
  template <typename Work>
  void in_file(Work&& work) {
    try {
      work();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kIo) throw;
      throw Error(error.code(), error.message(), {.file = name_, .element = error.where().element});
    }
  }

  std::string name_;
  BagRequest request_;
  std::optional<Pass> pass_;
  std::uint32_t next_ = 0;  ///< the frame that the pass gives next
  BagHead head_;
  TrueTrack truth_;
};

}  // namespace

std::unique_ptr<Recording> open_bag(const fs::path& path, const BagOptions& options) {
  const log::FileInput regular(path);  // the helper opens by name, and would wait for a pipe
  return std::make_unique<Bag>(path, options);
}

}  // namespace hallway::import
