// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/thesis_mapper.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>
#include <vector>

#include "slam_plane/thesis/bridge.hpp"
#include "slam_plane/thesis/map_report.hpp"
#include "slam_plane/thesis/roll_back.hpp"
#include "slam_plane/thesis/state.hpp"
#include "slam_plane/thesis/steps.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr int kPlaceByPoseAfter =
    30;  // iterations after which a submap without a link is placed by the robot's pose
constexpr std::size_t kTurns = 4;       // iterations in which each submap in view is computed once
constexpr int kIterationsPerFrame = 4;  // while there are some to be done again
constexpr std::size_t kMostWaiting =
    2;  // limits of roll backs; where so many iterations wait there is no further one

}  // namespace

/// The state and the steps of an iteration.
class ThesisMapper::Engine {
 public:
  explicit Engine(const Options& options)
      : options_(options), state_(options), history_(std::max(options.roll_back_limit, 1)) {}

  const Options& options() const { return options_; }
  const State& state() const { return state_; }
  const Answer& answer() const { return answer_; }
  const ThesisCounters& counters() const { return counters_; }

  /// Takes the newest frame. A frame after one that asks for a roll back goes back, and in those that follow some iterations are done again, until they have caught up with the newest one.
  void process(std::span<const WallObservation> given) {
    const bool goes_back = roll_back_.has_value();
    if (goes_back && waiting_.empty()) bridge_.emplace(options_, state_);
    Bridge::Report reported;
    if (goes_back || !waiting_.empty()) reported = bridge_->follow(given);
    const Iteration before = waiting_.empty() ? state_.now : waiting_.back().iteration;
    waiting_.push_back({before + 1, {given.begin(), given.end()}, {}, {}});
    if (goes_back) roll_back();
    for (int i = 0; !goes_back && i < kIterationsPerFrame && !waiting_.empty() && !roll_back_; ++i) {
      take_next();
      if (waiting_.empty()) reported = report_now(given.size());
    }
    report(reported);
  }

  bool ask_roll_back(const Hint& hint) {
    if (roll_back_ || !waiting_.empty() || !history_.reaches(hint.iteration - 1)) return false;
    roll_back_ = hint;
    return true;
  }

  /// Does again all that waits for it.
  void catch_up() {
    while (roll_back_ || !waiting_.empty()) {
      if (roll_back_) {
        roll_back();
      } else {
        take_next();
      }
    }
  }

 private:
  /// One iteration (thesis 4.5).
  void iterate(std::span<const WallObservation> given) {
    ++state_.now;
    prune_stale(options_, state_);
    if (const std::vector<SubmapIndex> now_at = close_up(state_); !now_at.empty()) history_.renumber(now_at);
    match_with_map(options_, state_);
    add_planes(given, options_, state_);
    manage_submaps(options_, state_);
    compute_submaps();
    build_map();
    locate();
    history_.close(state_);
    const Iteration reached = state_.now - options_.roll_back_limit;
    state_.hints.forget_before(reached);
    state_.tracks.forget_names_before(reached);
  }

  /// Submaps of which at least two planes are in view (thesis 4.5 ComputeXPoints).
  void compute_submaps() {
    changed_.clear();
    state_.unanchored.clear();
    for (const SubmapIndex index : submaps_in_view()) {
      if (!due(index)) continue;
      Submap& submap = state_.submaps[index];
      if (!submap.compute(state_.pairs, state_.tracks, options_, state_.now)) continue;
      const bool late = submap.created() + kPlaceByPoseAfter <= state_.now;
      if (!submap.placed && submap.anchors.empty() && (submap.by_motion || late))
        state_.unanchored.push_back(index);
      changed_.push_back(index);
      state_.locator.note(submap, state_.now);
      judge(index);
    }
  }

  /// The current submap and its neighbours are computed in each iteration, others in view in turn.
  bool due(SubmapIndex index) const {
    const SubmapIndex current = state_.carried.current;
    if (current == kNoSubmap || index == current || state_.submaps[index].created() == state_.now)
      return true;
    const std::vector<SubmapIndex>& links = state_.submaps[current].links;
    return (index + static_cast<std::size_t>(state_.now)) % kTurns == 0 ||
           std::ranges::find(links, index) != links.end();
  }

  std::vector<SubmapIndex> submaps_in_view() const {
    std::vector<SubmapIndex> result;
    for (const auto& [submap, count] : state_.chart) {
      if (count >= 2) result.push_back(submap);
    }
    const SubmapIndex last = state_.submaps.size();
    for (SubmapIndex index = last; index > 0 && state_.submaps[index - 1].created() == state_.now; --index)
      result.push_back(index - 1);
    make_set(result);
    return result;
  }

  /// Asks for a roll back if a member was compared over too little (Rules 31, 32, 34).
  void judge(SubmapIndex index) {
    const std::optional<TrackId> track = state_.submaps[index].too_short(options_, state_.now);
    if (!track || roll_back_) return;
    const Iteration joined = state_.submaps[index].find(*track)->joined;
    if (options_.roll_back_limit == 0 || state_.hints.exhausted(state_.tracks.name(*track)) ||
        !history_.reaches(joined - 1)) {
      state_.submaps[index].confirm(*track);
      return;
    }
    roll_back_ = Hint{joined, state_.tracks.name(*track), index};
  }

  void build_map() {
    if (!state_.submaps.empty()) anchor_first(state_);
    state_.map.build(changed_, state_.submaps, state_.tracks);
  }

  /// The pose, from what is seen now and the map alone (Rules 5, 16, 19), or from the motion model (Rules 23-27).
  void locate() {
    MotionModel& motion = state_.carried.motion;
    location_.reset();
    if (state_.start == state_.now) {
      location_ = Alignment{Pose2{}, true, Vec2::Zero(), true};
    } else if (motion.has_pose()) {
      location_ = state_.locator.locate(state_.seen, state_.tracks, state_.map, state_.pairs, state_.now,
                                        motion.predicted());
    }
    const bool open = location_ && !location_->determined;
    location_ = motion.completed(location_);
    if (open) {
      expand_planes(location_->T_to_from);
      ++degenerate_;
    }
    state_.carried.located = location_.has_value();
    if (motion.active()) state_.carried.after_motion = true;
    if (location_) counters_.submaps_after_motion += anchor_by_pose(*location_, state_);
  }

  /// While nothing but its line tells where a plane is, all that is learned of it is how far it reaches (Rule 23).
  void expand_planes(const Pose2& T_map_robot) {
    for (const TrackId id : state_.seen)
      state_.map.expand(id, T_map_robot * state_.tracks[id].newest().segment, state_.now);
  }

  void take_next() {
    const Record next = std::move(waiting_.front());
    waiting_.pop_front();
    history_.add(next.iteration, next.given);
    iterate(next.given);
    const bool again = next.iteration <= newest_done_;
    if (again) ++counters_.replayed;
    const std::size_t most = kMostWaiting * static_cast<std::size_t>(options_.roll_back_limit);
    if (again || waiting_.size() > most) roll_back_.reset();  // what asked for it asks again
  }

  /// Goes back to before what was hinted at, so that everything since then waits to be done again (Rules 33, 34).
  void roll_back() {
    const Hint hint = *roll_back_;
    roll_back_.reset();
    newest_done_ = state_.now;
    std::vector<Record> again = go_back(hint, options_, history_, state_);
    waiting_.insert(waiting_.begin(), std::make_move_iterator(again.begin()),
                    std::make_move_iterator(again.end()));
    ++counters_.roll_backs;
  }

  /// What the last iteration tells.
  Bridge::Report report_now(std::size_t given) const {
    Bridge::Report reported{location_, std::vector<LandmarkId>(given, kNoLandmark), !state_.seen.empty()};
    for (const Match& match : state_.matches)
      reported.associations[match.observation] = wall_of(match.track, state_);
    return reported;
  }

  void report(const Bridge::Report& reported) {
    const std::optional<Alignment>& location = reported.location;
    answer_.has_pose = location.has_value();
    answer_.lost = location ? Lost::no : reported.seen ? Lost::nothing_known : Lost::nothing_seen;
    answer_.unobservable = Vec2::Zero();
    if (location) {
      answer_.T_map_robot = location->T_to_from;
      answer_.unobservable = location->determined ? Vec2(Vec2::Zero()) : location->open;
      answer_.covariance = covariance_of(*location);
    }
    answer_.associations = reported.associations;
    Counters& counters = answer_.counters;
    ++counters.iterations;
    if (!location) ++counters.lost;
    counters.landmarks = state_.map.valid_planes();
    counters.submaps = state_.submaps.size() - state_.dropped_submaps;
    counters.degenerate = degenerate_;
    counters_.comparisons = state_.pairs.comparer().counters().comparisons;
    counters_.cache_hits = state_.pairs.comparer().counters().hits;
  }

  Options options_;
  State state_;
  History history_;
  std::vector<SubmapIndex> changed_;
  std::optional<Alignment> location_;
  std::optional<Hint> roll_back_;  // that the last iteration asked for
  std::deque<Record> waiting_;     // iterations to be done, or done again
  std::optional<Bridge> bridge_;   // while there are any
  Iteration newest_done_ = -1;     // up to it an iteration that waits is done again
  std::uint64_t degenerate_ = 0;
  ThesisCounters counters_;
  Answer answer_;
};

ThesisMapper::ThesisMapper(const Options& options) {
  options.validate();
  engine_ = std::make_unique<Engine>(options);
}
ThesisMapper::~ThesisMapper() = default;

const Answer& ThesisMapper::process(std::span<const WallObservation> given, const View&) {
  engine_->process(given);
  return engine_->answer();
}

Map ThesisMapper::map() const {
  return report_map(engine_->state());
}

Map ThesisMapper::refined_map() {
  engine_->catch_up();
  return map();
}

bool ThesisMapper::roll_back(const Hint& hint) {
  return engine_->ask_roll_back(hint);
}

void ThesisMapper::reset() {
  engine_ = std::make_unique<Engine>(Options(engine_->options()));
}

ThesisCounters ThesisMapper::counters() const {
  return engine_->counters();
}

}  // namespace hallway::slam_plane::thesis
