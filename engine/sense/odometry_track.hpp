// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace hallway::sense {

/// What sums up reading by reading, for readings that are asked for in any order: the state after reading k is step(k, … step(2, step(1, start)) …), and always
/// summed up in this order, so that it is the same to the last bit whatever was asked for before.
///
/// The next reading, or the same, costs one step (or none). Another one costs the steps from the nearest earlier of every 256th reading that was passed; the first
/// time, k steps. Keeps a state for every 256 readings. Thread-safe: one thread sums up at a time.
template <class State>
class OdometryTrack {
 public:
  /// Turns the state of reading k - 1 into that of reading k, k >= 1. A pure function; if it throws, the track is as before. Where it can only look at a
  /// recent time, readings have to be asked for in their order: then it is called once for each.
  using Step = std::function<void(State& state, std::uint64_t k)>;

  /// @param start  the state of reading 0
  /// @param step   of at(k)
  OdometryTrack(State start, Step step)
      : step_(std::move(step)), checkpoints_{start}, last_(std::move(start)) {}
  /// Where each call brings its own step.
  explicit OdometryTrack(State start) : OdometryTrack(std::move(start), {}) {}

  /// The state of reading `k`.
  State at(std::uint64_t k) const { return at(k, step_); }
  /// The same with a step of the caller's, which is the same function in every call.
  State at(std::uint64_t k, const Step& step) const {
    const std::scoped_lock lock(mutex_);
    std::uint64_t from = last_k_;
    State state = last_;
    const std::uint64_t checkpoint = std::min<std::uint64_t>(k / kSpacing, checkpoints_.size() - 1);
    if (from > k || from < checkpoint * kSpacing) {
      from = checkpoint * kSpacing;
      state = checkpoints_[static_cast<std::size_t>(checkpoint)];
    }
    while (from < k) {
      step(state, from + 1);
      ++from;
      if (from % kSpacing == 0 && from / kSpacing == checkpoints_.size()) checkpoints_.push_back(state);
    }
    last_k_ = k;
    last_ = state;
    return state;
  }

 private:
  static constexpr std::uint64_t kSpacing = 256;

  Step step_;
  mutable std::mutex mutex_{};
  mutable std::vector<State> checkpoints_;  ///< of readings 0, 256, 512, …
  mutable std::uint64_t last_k_ = 0;
  mutable State last_;
};

}  // namespace hallway::sense
