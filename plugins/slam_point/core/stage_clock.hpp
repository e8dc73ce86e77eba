// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace hallway::slam_point {

/// Parts of an iteration (thesis 6.6.2, figure 142).
enum class Stage : std::size_t {
  matching,   ///< prediction, and which landmark each point is
  fitting,    ///< the pose; the search for a turn where it fails
  averaging,  ///< new landmarks, and means of those seen
  moving,     ///< what looks for landmarks that move, and follows them
  closing,  ///< a submap's end: its frames aligned again, the window solved, landmarks merged, the next submap
  solving   ///< a slice of a step over the whole map
};

inline constexpr std::size_t kStages = 6;
inline constexpr const char* kStageNames[kStages] = {"matching", "fitting", "averaging", "moving",
                                                     "closing", "solving"};

/// What one iteration's stages took [us].
using StageTimes = std::array<double, kStages>;

/// Adds up what stages take where somebody wants to know; costs a branch per stage where nobody does.
class StageClock {
 public:
  /// Adds to `times` from now on; null: to nothing. It must live until it is replaced.
  void add_to(StageTimes* times) { times_ = times; }

  /// An iteration begins.
  void begin() {
    if (times_ != nullptr) last_ = std::chrono::steady_clock::now();
  }

  /// What has passed since the last call belongs to `stage`.
  void end(Stage stage) {
    if (times_ == nullptr) return;
    const auto now = std::chrono::steady_clock::now();
    (*times_)[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
  }

 private:
  StageTimes* times_ = nullptr;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace hallway::slam_point
