// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <utility>

namespace hallway::slam_point {

/// Parts of an iteration (thesis 6.6.2, figure 142).
enum class Stage : std::size_t {
  matching,   ///< prediction, and which landmark each point is
  fitting,    ///< the pose; the search for a turn where it fails
  averaging,  ///< new landmarks, and means of those seen
  moving,     ///< moving-landmark detection
  closing,    ///< a submap's end: its frames aligned again, landmarks merged, the next submap
  solving,    ///< a slice of a step over several submaps
  none        ///< is not counted
};

inline constexpr std::size_t kStages = 6;
inline constexpr const char* kStageNames[kStages] = {"matching", "fitting", "averaging",
                                                     "moving",   "closing", "solving"};

/// Time that stages took [us].
using StageTimes = std::array<double, kStages>;

/// Sums up the time of stages if a bench asks for it; costs a branch per stage if not.
class StageClock {
 public:
  /// Adds to `times` from now on; null: to nothing. It must live until it is replaced.
  void add_to(StageTimes* times) { times_ = times; }

  /// Counts the time until its end to a stage, but for that of scopes within it.
  class Scope {
   public:
    Scope(StageClock& clock, Stage stage) : clock_(clock), outer_(clock.enter(stage)) {}
    ~Scope() { clock_.enter(outer_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageClock& clock_;
    Stage outer_;
  };

 private:
  /// Returns the stage that ends.
  Stage enter(Stage stage) {
    const Stage before = std::exchange(stage_, stage);
    if (times_ == nullptr) return before;
    const auto now = std::chrono::steady_clock::now();
    if (before != Stage::none)
      (*times_)[static_cast<std::size_t>(before)] +=
          std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
    return before;
  }

  StageTimes* times_ = nullptr;
  Stage stage_ = Stage::none;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace hallway::slam_point
