// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/roll_back.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hallway::slam_plane::thesis {

void History::add(Iteration iteration, std::span<const WallObservation> given) {
  Record record;
  record.iteration = iteration;
  record.given.assign(given.begin(), given.end());
  records_.push_back(record);
}

void History::close(const State& state) {
  Record& record = records_[records_.size() - 1];
  record.after = state.carried;
  record.recent = state.recent;
}

bool History::reaches(Iteration k) const {
  return !records_.empty() && records_.front().iteration <= k && k < records_.back().iteration;
}

std::vector<Record> History::take_after(Iteration k) {
  std::vector<Record> taken;
  while (!records_.empty() && records_.back().iteration > k) {
    taken.push_back(std::move(records_[records_.size() - 1]));
    records_.pop_back();
  }
  std::ranges::reverse(taken);
  return taken;
}

void History::renumber(const std::vector<SubmapIndex>& now_at) {
  for (std::size_t i = 0; i < records_.size(); ++i) {
    if (!records_[i].after) continue;
    SubmapIndex& current = records_[i].after->current;
    if (current != kNoSubmap) current = now_at[current];
  }
}

namespace {

/// Forgets the submaps begun later, and what is linked to them.
void forget_submaps(Iteration k, State& state) {
  while (!state.submaps.empty() && state.submaps.back().created() > k) state.submaps.pop_back();
  const SubmapIndex count = state.submaps.size();
  const auto gone = [&](SubmapIndex index) { return index >= count; };
  for (Submap& submap : state.submaps) {
    submap.truncate(k);
    std::erase_if(submap.links, gone);
    if (submap.anchored > k) submap.anchors.clear();
  }
  for (TrackId id = 0; id < state.tracks.size(); ++id) {
    std::erase_if(state.tracks.submaps(id),
                  [&](SubmapIndex index) { return gone(index) || !state.submaps[index].contains(id); });
    std::erase_if(state.tracks.charted(id), gone);
  }
}

}  // namespace

void roll_back_to(const Record& record, const Options& options, State& state) {
  const Iteration k = record.iteration;
  state.now = k;
  state.tracks.truncate(k);
  state.pairs.truncate(k);
  forget_submaps(k, state);
  state.carried = *record.after;
  state.recent = record.recent;
  const auto released = [&](TrackId id) { return state.tracks.is_free(id); };
  std::erase_if(state.recent, released);
  std::erase_if(state.carried.unassigned, [&](const Unassigned& entry) { return released(entry.track); });
  state.met_again.clear();
  state.unanchored.clear();
  state.locator.clear();
  state.map.clear(k);
  std::vector<SubmapIndex> all(state.submaps.size());
  std::iota(all.begin(), all.end(), SubmapIndex{0});
  for (Submap& submap : state.submaps) submap.compute(state.pairs, state.tracks, options, k);
  state.map.build(all, state.submaps, state.tracks);
}

std::vector<Record> go_back(const Hint& hint, const Options& options, History& history, State& state) {
  state.hints.add(hint);
  std::vector<Record> again = history.take_after(hint.iteration - 1);
  roll_back_to(history.at(hint.iteration - 1), options, state);
  return again;
}

}  // namespace hallway::slam_plane::thesis
