// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_plane/thesis/ring_buffer.hpp"
#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// One iteration as it was: its input, and what it left (thesis 4.4.3.17).
struct Record {
  Iteration iteration = 0;
  std::vector<WallObservation> given;
  std::optional<Carried> after;
  std::vector<TrackId> recent;
};

/// The last iterations, for going back to one of them (Rule 33).
class History {
 public:
  explicit History(int limit) : records_(static_cast<std::size_t>(limit) + 1) {}

  void add(Iteration iteration, std::span<const WallObservation> given);
  /// Notes what the newest iteration left.
  void close(const State& state);
  /// Whether the state after iteration k can be had again.
  bool reaches(Iteration k) const;
  /// The record of an iteration that is kept.
  const Record& at(Iteration k) const {
    return records_[static_cast<std::size_t>(k - records_.front().iteration)];
  }
  /// Takes the records after k out, in the order of time.
  std::vector<Record> take_after(Iteration k);
  void clear() { records_.clear(); }
  /// Submaps got other indices: `now_at[i]` for i.
  void renumber(const std::vector<SubmapIndex>& now_at);

 private:
  RingBuffer<Record> records_;
};

/// Puts the state back to what it was after an iteration: tracks, submaps and comparisons forget what came later (Rule 33). O(map).
void roll_back_to(const Record& record, const Options& options, State& state);

/// Goes back to before what a hint speaks of, which `history` has to reach, and takes the hint along (Rule 34). @returns the iterations since then, which are to be done again.
std::vector<Record> go_back(const Hint& hint, const Options& options, History& history, State& state);

}  // namespace hallway::slam_plane::thesis
