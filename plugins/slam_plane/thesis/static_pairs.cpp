// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/static_pairs.hpp"

#include <algorithm>
#include <functional>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kSigmas2 = 9.0;  // squared standard deviations by which one observation may differ
constexpr int kMisses = 2;        // observations in a row that do not agree end a run
constexpr Iteration kLag = 8;     // newest iterations of a run that ended that may have been moving already
constexpr Iteration kTestEvery = 4;  // iterations
constexpr Iteration kLongest = 400;  // iterations that are looked at when a run is sought

/// Whether an observation agrees with what was found before.
bool agrees(const Vec2& offset, const OffsetMoments& moments) {
  const double bound = kSigmas2 * moments.deviation * moments.deviation + kNoDeviation_m * kNoDeviation_m;
  return (offset - moments.mean).squaredNorm() <= bound;
}

bool made_from(const Comparison& comparison, int combination) {
  return comparison.key[0] == key_of(combination, 0) && comparison.key[1] == key_of(combination, 1);
}

/// Forgets what was saved of a run.
void forget_run(int combination, PairHistory& pair) {
  std::erase_if(pair.saved, [&](const Comparison& saved) {
    return made_from(saved, combination) && saved.interval.first == pair.run(combination).since;
  });
}

/// When both planes began to do what they do now (Rule 18).
Iteration phase_begin(const PlaneTrack& a, const PlaneTrack& b) {
  return std::max(a.phases().back().interval.first, b.phases().back().interval.first);
}

}  // namespace

bool PairHistory::still(int which, int end) const {
  for (int c = 0; c < 4; ++c) {
    if ((which == 0 ? c / 2 : c % 2) == end && runs[static_cast<std::size_t>(c)].still()) return true;
  }
  return false;
}

void StaticPairs::save(const PlaneTrack& a, const PlaneTrack& b, int combination, PairHistory& pair) {
  const EndRun& run = pair.run(combination);
  const Comparison made = comparer_.compare_in(a, b, {run.since, pair.updated}, combination);
  if (!made.valid) return;
  keep_better(a, b, made, pair);
}

/// What was saved of a run is made anew without what came after an iteration.
void StaticPairs::shorten(const PlaneTrack& a, const PlaneTrack& b, int combination, Iteration last,
                          PairHistory& pair) {
  const Iteration since = pair.run(combination).since;
  for (auto saved = pair.saved.begin(); saved != pair.saved.end(); ++saved) {
    if (!made_from(*saved, combination) || saved->interval.first != since || saved->interval.last <= last)
      continue;
    NewestShared newest(a, b, last);
    StillnessTest test(newest, since, comparer_.kept(a, b));
    const bool still = last >= since && test.judge(combination, options_.max_deviation_m) == Stillness::still;
    if (still) {
      *saved = comparer_.compare_in(a, b, {since, last}, combination);
    } else {
      pair.saved.erase(saved);
    }
    return;
  }
}

void StaticPairs::end_run(const PlaneTrack& a, const PlaneTrack& b, int combination, PairHistory& pair) {
  EndRun& run = pair.run(combination);
  const bool exact = run.moments.deviation <= kNoDeviation_m;
  shorten(a, b, combination, pair.updated - kMisses - (exact ? 0 : kLag), pair);
  run = {};
}

/// Where a plane turned, another end of it may be the one that moves: a run goes on, but what it is compared over begins anew (Rule 18).
void StaticPairs::split_where_turned(const PlaneTrack& a, const PlaneTrack& b, Iteration start,
                                     PairHistory& pair) {
  for (int c = 0; c < 4; ++c) {
    EndRun& run = pair.run(c);
    if (run.since < 0 || run.since >= start) continue;
    shorten(a, b, c, start - 1, pair);
    run.since = start;
  }
}

void StaticPairs::follow(NewestShared& newest, bool due, PairHistory& pair) {
  const PlaneTrack& a = newest.a();
  const PlaneTrack& b = newest.b();
  std::optional<StillnessTest> test;
  Iteration tested_since = -1;
  for (int c = 0; c < 4; ++c) {
    EndRun& run = pair.run(c);
    if (run.since < 0) continue;
    run.misses = agrees(newest.latest(c), run.moments) ? 0 : run.misses + 1;
    if (run.misses >= kMisses) end_run(a, b, c, pair);
    if (!due || run.since < 0 || run.misses > 0) continue;
    if (tested_since != run.since) test.emplace(newest, run.since, comparer_.kept(a, b));
    tested_since = run.since;
    const Stillness found = test->judge(c, options_.max_deviation_m);
    if (found == Stillness::still) {
      run.moments = test->moments(c);
    } else if (found == Stillness::moves) {
      forget_run(c, pair);
      run = {};
    }
  }
}

/// Where there is no noise three observations tell.
void StaticPairs::search_exact(NewestShared& newest, Iteration start, PairHistory& pair) {
  const PlaneTrack& a = newest.a();
  const PlaneTrack& b = newest.b();
  const Interval least{std::max(start, pair.updated - kExactReadings + 1), pair.updated};
  if (least.size() < kExactReadings) return;
  for (int c = 0; c < 4; ++c) {
    EndRun& run = pair.run(c);
    if (run.since >= 0) continue;
    const OffsetMoments here{newest.latest(c), 0.0};
    Iteration since = pair.updated;
    for (Iteration k = pair.updated - 1; k >= std::max(start, pair.updated - kLongest); --k) {
      const TimedObservation* before_a = a.find(k);
      const TimedObservation* before_b = b.find(k);
      if (before_a == nullptr || before_b == nullptr || !agrees(end_offset(*before_a, *before_b, c), here))
        break;
      since = k;
    }
    if (since > least.first) continue;
    StillnessTest test(newest, since, comparer_.kept(a, b));
    if (test.judge(c, kNoDeviation_m) != Stillness::still) continue;
    run.since = since;
    run.moments = test.moments(c);
  }
}

/// The longest one of some intervals until now in which two ends stand still, for those that are not known to.
void StaticPairs::search(NewestShared& newest, Iteration start, PairHistory& pair) {
  std::array<bool, 4> open{};
  for (std::size_t c = 0; c < 4; ++c) open[c] = pair.runs[c].since < 0;
  for (Iteration length = kReadings; length <= kLongest; length += length / 2) {
    const Iteration first = std::max(start, pair.updated - length + 1);
    if (std::ranges::none_of(open, [](bool o) { return o; })) return;
    StillnessTest test(newest, first, comparer_.kept(newest.a(), newest.b()));
    for (int c = 0; c < 4; ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (!open[i]) continue;
      const Stillness found = test.judge(c, options_.max_deviation_m);
      if (found == Stillness::moves) open[i] = false;
      if (found != Stillness::still) continue;
      pair.runs[i].since = first;
      pair.runs[i].moments = test.moments(c);
    }
    if (first == start) return;
  }
}

/// Where no end of a plane ever stood still, the other one may tell its line. (The place of the wall at the end of a hallway is known though neither of its ends is, 4.3.6.)
void StaticPairs::find_lines(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair) {
  for (int which = 0; which < 2; ++which) {
    const bool known = std::ranges::any_of(
        pair.saved, [&](const Comparison& saved) { return saved.key[which] != KeyPoint::none; });
    if (known) continue;
    const PlaneTrack& from = which == 0 ? b : a;
    const PlaneTrack& to = which == 0 ? a : b;
    for (const int end : {kEndA, kEndB}) {
      const Comparison line = compare_line(from, to, end, pair.updated, options_);
      if (line.valid) keep_better(a, b, which == 0 ? inverse(line) : line, pair);
    }
  }
}

PairHistory& StaticPairs::begin(TrackId a, TrackId b) {
  partners_[a].push_back(b);
  partners_[b].push_back(a);
  return pairs_[{a, b}];
}

const PairHistory& StaticPairs::update(const PlaneTrack& a, const PlaneTrack& b) {
  if (b.id() < a.id()) return update(b, a);
  static const PairHistory kNothing;
  const Iteration last = a.empty() || b.empty() ? -1 : std::min(a.newest().iteration, b.newest().iteration);
  const auto together = [&] { return last >= 0 && a.find(last) != nullptr && b.find(last) != nullptr; };
  const auto known = pairs_.find({a.id(), b.id()});
  if (known == pairs_.end() && !together()) return kNothing;
  PairHistory& pair = known != pairs_.end() ? known->second : begin(a.id(), b.id());
  if (a.empty() || b.empty()) return pair;
  drop_disproved(a, b, pair);
  if (last <= pair.updated || !together()) return pair;
  const bool due = last / kTestEvery != pair.updated / kTestEvery;
  const Iteration start = phase_begin(a, b);
  pair.updated = last;
  pair.disproved = 0;
  if (start > last) {
    pair.runs = {};
    return pair;
  }
  split_where_turned(a, b, start, pair);
  NewestShared newest(a, b, last);
  follow(newest, due, pair);
  search_exact(newest, start, pair);
  if (due) search(newest, start, pair);
  judge_runs(a, b, pair);
  for (int c = 0; c < 4; ++c) {
    const EndRun& run = pair.run(c);
    if (run.still() && (due || run.moments.deviation <= kNoDeviation_m)) save(a, b, c, pair);
    if (run.undefined) {
      forget_run(c, pair);
    }
  }
  if (due) find_lines(a, b, pair);
  std::ranges::stable_sort(pair.saved, std::greater{}, &Comparison::shared);
  return pair;
}

void StaticPairs::truncate(Iteration k) {
  comparer_.truncate(k);
  std::erase_if(corner_since_, [&](const auto& entry) { return entry.second > k; });
  ++disproved_;
  std::erase_if(firm_, [&](const auto& entry) { return entry.second > k; });
  for (auto& [key, pair] : pairs_) {
    if (pair.updated <= k) continue;
    std::erase_if(pair.saved, [&](const Comparison& saved) { return saved.interval.last > k; });
    pair.updated = -1;
    pair.runs = {};
  }
}

void StaticPairs::forget(TrackId id) {
  for (const KeyPoint key : {KeyPoint::left, KeyPoint::right}) {
    corner_since_.erase({id, key});
    firm_.erase({id, key});
  }
  const auto partners = partners_.find(id);
  if (partners == partners_.end()) return;
  for (const TrackId other : partners->second) {
    comparer_.forget(id, other);
    pairs_.erase({std::min(id, other), std::max(id, other)});
    std::erase(partners_[other], id);
  }
  partners_.erase(id);
}

}  // namespace hallway::slam_plane::thesis
