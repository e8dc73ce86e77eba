// SPDX-License-Identifier: MIT
#include "slam_plane/core/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "slam_plane/core/corner_judge.hpp"
#include "slam_plane/core/duplicate_finder.hpp"
#include "slam_plane/core/end_evidence.hpp"
#include "slam_plane/core/frame_locator.hpp"
#include "slam_plane/core/gap_search.hpp"
#include "slam_plane/core/map_solver.hpp"
#include "slam_plane/core/submap_choice.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {
namespace {

constexpr std::uint64_t kOldFrames = 100;  // out of view, after which ground is old

const Options& checked(const Options& options) {
  options.validate();
  return options;
}

}  // namespace

class Mapper::State {
 public:
  explicit State(const Options& options)
      : options_(checked(options)),
        judge_(options),
        locator_(options),
        ends_(options),
        gap_search_(options),
        duplicates_(options),
        map_(options) {}

  const Answer& process(std::span<const WallObservation> observations, const View& view);
  Map map() const { return report_map(solver_.refreshed(map_), options_.min_observations); }
  Map refined_map() const {
    return report_map(optimised(solver_.refreshed(map_)), options_.min_observations);
  }
  std::vector<JoinedPart> joined_parts() const { return gaps_.joined_parts(); }
  const Options& options() const { return options_; }

 private:
  void start_map();
  void place(const View& view);
  void recall_corners(const View& view);
  void follow_outliers();
  void watch_gaps();
  void add_walls();
  void choose_submap();
  void change_submap(bool lines_only);
  bool take_up(Index submap);
  void integrate();
  void revoke_corners(Index wall);
  void note_seen();
  void search_gap();
  void bridge(const GapShift& shift);
  void merge_duplicate(Index wall);
  void merge_duplicates(Index submap);
  void look_for_duplicates();
  void merge(Index kept, Index gone);
  void lose(Lost reason);
  const Answer& answer();

  Options options_;
  CornerJudge judge_;
  FrameLocator locator_;
  EndEvidence ends_;
  GapSearch gap_search_;
  DuplicateFinder duplicates_;
  WallMap map_;
  MapSolver solver_;
  OpenGaps gaps_;

  Frame frame_;
  bool started_ = false;
  bool has_pose_ = false;
  Lost lost_ = Lost::nothing_seen;
  bool first_of_submap_ = false;
  Index next_duplicate_ = 0;  // wall that is looked at for duplicates
  int frames_lost_ = 0;       // in a row
  Answer answer_;
};

const Answer& Mapper::State::process(std::span<const WallObservation> observations, const View& view) {
  if (solver_.advance(map_)) ++answer_.counters.global_steps;
  frame_.iteration = ++answer_.counters.iterations;
  frame_.observations = unassociated(observations);
  judge_.judge(view, frame_.observations);
  answer_.associations.assign(observations.size(), kNoLandmark);
  if (started_) {
    place(view);
  } else if (!frame_.observations.empty()) {
    start_map();
  }
  return answer();
}

void Mapper::State::start_map() {
  started_ = true;
  has_pose_ = true;
  lost_ = Lost::no;
  add_walls();
  frame_.in_map = locator_.own_information(frame_);
  map_.activate(map_.add_submap(Pose2{}, !frame_.in_map.determined(), gaps_.epoch()));
  first_of_submap_ = true;
  integrate();
  note_seen();
}

/// One iteration.
void Mapper::State::place(const View& view) {
  const Pose2 before = frame_.T_submap_robot;
  locator_.locate(map_, gaps_.epochs_known(), frame_);
  if (frame_.observations.empty()) return lose(Lost::nothing_seen);
  if (locator_.known() == 0 && ++frames_lost_ <= OpenGaps::kBridgeFrames) return lose(Lost::nothing_known);
  frames_lost_ = 0;
  has_pose_ = true;
  lost_ = Lost::no;
  recall_corners(view);
  follow_outliers();
  if (frame_.observations.empty()) return lose(Lost::nothing_known);
  locator_.locate_in_submap(map_, frame_);
  locator_.note_motion(before, frame_, gaps_.untied());
  watch_gaps();
  add_walls();
  choose_submap();
  integrate();
  note_seen();
  search_gap();
  look_for_duplicates();
}

/// Ends that were taken for cuts may be where the map has corners.
void Mapper::State::recall_corners(const View& view) {
  if (!frame_.in_map.determined() || (!gaps_.empty() && gaps_.last().is_wide())) return;
  const CornerJudge::Located at{frame_.T_map_robot, frame_.in_map.matrix.inverse()};
  if (judge_.recall(view, map_, at, frame_.observations))
    frame_.in_map = locator_.fit_map(map_, frame_, FrameLocator::kAllEpochs, frame_.T_map_robot);
}

/// Observations that do not lie where their walls do are no evidence: their walls may move, or they are of none.
void Mapper::State::follow_outliers() {
  locator_.find_outliers(map_, frame_);
  for (const AssociatedObservation& observation : frame_.observations) {
    if (!observation.outlier) continue;
    map_.note_trail(observation.wall, frame_.iteration, frame_.T_map_robot, observation);
    if (map_.note_outlier(observation.wall)) {
      solver_.abandon();
      ++answer_.counters.dynamic;
    }
    WallRecord& wall = map_.walls[observation.wall];
    wall.last_seen = frame_.iteration;
    if (!wall.is_dynamic) continue;
    ++wall.count;
    answer_.associations[observation.given] = observation.wall;
  }
  std::erase_if(frame_.observations,
                [](const AssociatedObservation& observation) { return observation.outlier; });
}

void Mapper::State::watch_gaps() {
  if (!frame_.in_map.determined()) ++answer_.counters.degenerate;
  if (gaps_.watch(frame_, locator_.motion(), locator_.fastest())) ++answer_.counters.gaps;
  const int closed = gaps_.close(
      frame_, [&](std::uint32_t epoch, Pose2& T) { return locator_.fit_map(map_, frame_, epoch, T); });
  answer_.counters.gaps_closed += static_cast<std::uint64_t>(closed);
}

void Mapper::State::add_walls() {
  for (AssociatedObservation& observation : frame_.observations) {
    if (observation.wall == kNone) observation.wall = map_.add_wall(gaps_.epoch(), frame_.iteration);
  }
}

void Mapper::State::choose_submap() {
  const SubmapChoice choice =
      slam_plane::choose_submap(map_, frame_, locator_.own_information(frame_), options_);
  if (choice.change) change_submap(choice.lines_only);
}

void Mapper::State::change_submap(bool lines_only) {
  ++answer_.counters.closes;
  solver_.note_closed();
  merge_duplicates(map_.active());
  const Index old = lines_only ? kNone : old_submap(map_, frame_, options_);
  if (old == kNone || !take_up(old)) {
    map_.activate(map_.add_submap(frame_.T_map_robot, lines_only, gaps_.epoch()));
    frame_.T_submap_robot = Pose2{};
    first_of_submap_ = true;
  }
}

/// Goes on with an old submap, if that determines the pose.
bool Mapper::State::take_up(Index submap) {
  map_.activate(submap);
  locator_.locate_in_submap(map_, frame_);
  if (!frame_.in_submap.determined()) return false;
  map_.submaps[submap].frames = 0;
  ++answer_.counters.reopened;
  return true;
}

void Mapper::State::integrate() {
  const Index active = map_.active();
  for (const AssociatedObservation& observation : frame_.observations) {
    WallRecord& wall = map_.walls[observation.wall];
    if (wall.active_member == kNone) map_.join(active, observation.wall, first_of_submap_);
    bool corner[2];
    ends_.judge(gaps_, frame_, observation, map_, corner);
    map_.observe(wall.active_member, frame_.T_submap_robot, observation, corner);
  }
  ++map_.submaps[active].frames;
  first_of_submap_ = false;
  for (const AssociatedObservation& observation : frame_.observations) {
    revoke_corners(observation.wall);
    map_.update(observation.wall);
  }
  solver_.plan(map_);
}

void Mapper::State::revoke_corners(Index wall) {
  for (int k = 0; k < 2; ++k) {
    if (!EndEvidence::is_disproved(map_.walls[wall], k)) continue;
    map_.revoke_corner(wall, k);
    solver_.abandon();
    ++answer_.counters.corners_revoked;
  }
}

void Mapper::State::note_seen() {
  for (const AssociatedObservation& observation : frame_.observations) {
    WallRecord& wall = map_.walls[observation.wall];
    if (wall.last_seen + kOldFrames < frame_.iteration) solver_.note_old_ground();
    wall.last_seen = frame_.iteration;
    wall.outliers = 0;
    map_.note_trail(observation.wall, frame_.iteration, frame_.T_map_robot, observation);
  }
  locator_.note_seen(map_, frame_);
  gap_search_.note_seen(gaps_, frame_);
}

void Mapper::State::search_gap() {
  const std::optional<GapShift> shift = gap_search_.find(map_, gaps_, frame_);
  if (shift) bridge(*shift);
}

/// Moves what came after a gap to where it belongs.
void Mapper::State::bridge(const GapShift& shift) {
  gaps_.erase(shift.gap);
  solver_.abandon();
  map_.shift(shift.gap.epoch, shift.step);
  frame_.T_map_robot.t += shift.step;
  solver_.note_loop(map_);
  for (const Duplicates& pair : shift.duplicates) merge(pair.kept, pair.gone);
  ++answer_.counters.gaps_closed;
}

void Mapper::State::merge_duplicate(Index wall) {
  const Index duplicate = duplicates_.duplicate_of(map_, wall, gaps_.epochs_known(), frame_.iteration);
  if (duplicate != kNone) merge(std::min(wall, duplicate), std::max(wall, duplicate));
}

void Mapper::State::merge_duplicates(Index submap) {
  for (std::size_t m = 0; m < map_.submaps[submap].members.size(); ++m) {
    const Index wall = map_.submaps[submap].members[m].wall;
    if (wall != kNone) merge_duplicate(wall);
  }
}

/// Each frame looks at one wall: some turn out to have duplicates only once the map has converged.
void Mapper::State::look_for_duplicates() {
  if (map_.walls.empty()) return;
  if (next_duplicate_ >= map_.walls.size()) next_duplicate_ = 0;
  merge_duplicate(next_duplicate_++);
}

void Mapper::State::merge(Index kept, Index gone) {
  kept = map_.resolve(kept);
  gone = map_.resolve(gone);
  if (kept == gone) return;
  solver_.abandon();
  map_.merge(kept, gone);
  ++answer_.counters.merged;
  for (AssociatedObservation& observation : frame_.observations) {
    if (observation.wall == gone) observation.wall = kept;
  }
  locator_.replace(gone, kept);
}

void Mapper::State::lose(Lost reason) {
  has_pose_ = false;
  lost_ = reason;
  for (AssociatedObservation& observation : frame_.observations) observation.wall = kNone;
  // The prediction goes on from here.
  frame_.T_submap_robot = map_.submaps[map_.active()].T_map_submap.inverse() * frame_.T_map_robot;
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = has_pose_;
  answer_.lost = lost_;
  answer_.part = gaps_.part();
  answer_.unobservable = answer_.untied = Vec2::Zero();
  answer_.covariance.setZero();
  if (has_pose_) {
    answer_.T_map_robot = frame_.T_map_robot;
    Mat3 information = frame_.in_map.matrix;
    const double range = gaps_.empty() ? 0.0 : gaps_.last().range_m;
    // What the walls leave open is known by the prediction alone.
    information.topLeftCorner<2, 2>() += Mat2::Identity() / (1.0 + range * range);
    information(2, 2) += 1.0;
    answer_.covariance = information.inverse();
    if (frame_.in_map.open > 0) answer_.unobservable = frame_.in_map.direction;
    if (!gaps_.empty()) answer_.untied = gaps_.last().direction;
  } else {
    ++answer_.counters.lost;
  }
  for (const AssociatedObservation& observation : frame_.observations) {
    if (observation.wall != kNone) answer_.associations[observation.given] = observation.wall;
  }
  answer_.counters.landmarks = map_.walls.size() - answer_.counters.merged;
  answer_.counters.submaps = map_.submaps.size();
  return answer_;
}

Mapper::Mapper(const Options& options) : state_(std::make_unique<State>(options)) {}
Mapper::~Mapper() = default;

const Answer& Mapper::process(std::span<const WallObservation> observations, const View& view) {
  return state_->process(observations, view);
}

Map Mapper::map() const {
  return state_->map();
}

Map Mapper::refined_map() const {
  return state_->refined_map();
}

std::vector<JoinedPart> Mapper::joined_parts() const {
  return state_->joined_parts();
}

void Mapper::reset() {
  state_ = std::make_unique<State>(Options(state_->options()));
}

}  // namespace hallway::slam_plane
