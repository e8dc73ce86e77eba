// SPDX-License-Identifier: MIT
#include "slam_plane/core/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slam_plane/core/corner_judge.hpp"
#include "slam_plane/core/frame_fit.hpp"
#include "slam_plane/core/frame_matcher.hpp"
#include "slam_plane/core/map_step.hpp"
#include "slam_plane/core/shift_search.hpp"

namespace hallway::slam_plane {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr double kLeastLength_m = 1e-3;
constexpr std::uint64_t kRecentFrames = 15;  // for which a wall out of view is still looked for first
constexpr std::uint64_t kYoungFrames = 100;  // likewise, as one whose place among old ones is sought
constexpr double kStray2 = 36.0;        // squared distance of a piece that is not its wall's, in variances
constexpr double kStrayBound_m = 0.05;  // below which none strays
constexpr double kDriftBound_m = 0.1;   // of a gap that matching by place can bridge
constexpr double kGapSpeed = 1.5;       // times the fastest motion so far, that a robot may move unseen
constexpr double kGapStep_m = 0.01;     // and what is added each frame
constexpr std::size_t kMostYoung = 12;  // walls that are looked for
constexpr std::uint64_t kSearchPeriod = 10;   // frames between looks for the end of a gap
constexpr double kPartDistance_m = 0.9;       // between two walls that may be parts of one
constexpr std::uint32_t kPartSightings = 20;  // of each of them
constexpr std::uint64_t kPartFrames = 30;     // since they were seen: their ends had their chance
constexpr int kBridgeFrames = 10;             // without a known wall, before the map goes on elsewhere
constexpr double kAlongGap = 0.7;             // cosine between a wall and a gap whose corners tell of it
constexpr double kTwinSine = 0.02;            // of the largest angle between walls that are one
constexpr int kTies = 3;                      // frames that agree on that
constexpr std::uint32_t kLeastAgainst = 3;    // sightings beyond a corner that disprove it
constexpr double kGateSigmas = 4.0;
constexpr double kBeyond_m = 0.03;
constexpr double kWorkPerFrame = 4000.0;  // of the step over all submaps
constexpr double kRefineWork = 1e12;
constexpr int kRefineSteps = 15;
constexpr double kSettled = 1e-6;  // a move that is none [m, rad]

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
        matcher_(options),
        fit_(options),
        map_(options),
        search_(options) {}

  const Answer& process(std::span<const Piece> pieces, const View& view);
  Map map() const { return told(map_); }
  Map refined_map() const;
  const Options& options() const { return options_; }

 private:
  void take_pieces(std::span<const Piece> pieces);
  void place();
  void start_map();
  void predict();
  void match();
  void match_from(const Pose2& T_map_robot);
  PoseInformation fit_map(std::uint32_t before_epoch, Pose2& T);
  PoseInformation fit_submap();
  void drop_strays();
  void watch_gap();
  void close_gaps();
  void search_gap();
  bool tie_by_corner();
  void take_shift(const Gap& gap, const Vec2& step, const std::vector<Twins>& twins);
  void add_walls();
  void choose_submap();
  bool overlap_is_low() const;
  void change_submap(bool lines_only);
  Index old_submap() const;
  void integrate();
  void note_ends(const Sighting& sighting, bool (&corner)[2]);
  void merge_twins(Index submap);
  void merge_twin(Index wall);
  bool are_parts(const WallRecord& one, const WallRecord& other) const;
  void look_for_twins();
  void merge(Index kept, Index gone);
  void plan_step();
  void advance_step();
  void note_seen();
  std::uint32_t epochs_known() const;
  void lose(Lost reason);
  const Answer& answer();
  Map told(const WallMap& map) const;

  Options options_;
  CornerJudge judge_;
  FrameMatcher matcher_;
  FrameFit fit_;
  WallMap map_;
  MapStep step_;
  ShiftSearch search_;

  std::vector<Sighting> frame_;
  std::vector<Index> recent_;
  std::vector<Index> young_;
  std::vector<Twins> twins_;
  std::vector<Gap> gaps_;  // that are open, oldest first
  std::uint32_t epoch_ = 0;
  bool started_ = false;
  bool has_pose_ = false;
  bool was_tied_ = true;  // the last frame's place among the walls was determined
  Lost lost_ = Lost::nothing_seen;
  Pose2 T_map_robot_;
  Pose2 T_submap_robot_;
  Pose2 motion_;             // of one frame
  double fastest_ = 0.0;     // motion so far [m a frame]
  Index next_twin_ = 0;      // wall that is looked at for twins
  int frames_lost_ = 0;      // in a row
  double seen_shift_ = 0.0;  // that the last look for the end of a gap found
  bool has_seen_shift_ = false;
  PoseInformation in_map_;
  PoseInformation in_submap_;
  int closes_since_step_ = 0;
  bool on_old_ground_ = false;
  int ties_ = 0;  // frames in a row that tell the same displacement by corners
  double tie_ = 0.0;
  bool first_of_submap_ = false;
  WallId first_id_ = 0;
  Answer answer_;
};

const Answer& Mapper::State::process(std::span<const Piece> pieces, const View& view) {
  advance_step();
  take_pieces(pieces);
  judge_.judge(view, frame_);
  if (started_) {
    place();
  } else if (!frame_.empty()) {
    start_map();
  }
  return answer();
}

void Mapper::State::take_pieces(std::span<const Piece> pieces) {
  frame_.clear();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    // Written so that NaN fails.
    if (!(std::max(piece.a.cwiseAbs().maxCoeff(), piece.b.cwiseAbs().maxCoeff()) <= kMaxCoordinate_m))
      continue;
    if (!piece.a.allFinite() || !piece.b.allFinite() || !(cross(piece.a, piece.b) < 0.0)) continue;
    Sighting sighting;
    sighting.end[kEndA] = piece.a;
    sighting.end[kEndB] = piece.b;
    sighting.middle = 0.5 * (piece.a + piece.b);
    sighting.length = (piece.b - piece.a).norm();
    if (sighting.length < kLeastLength_m) continue;
    sighting.direction = (piece.b - piece.a) / sighting.length;
    sighting.z_low = piece.z_low;
    sighting.z_high = piece.z_high;
    sighting.given = i;
    frame_.push_back(sighting);
  }
  answer_.associations.assign(pieces.size(), kNoWall);
  ++answer_.counters.iterations;
}

void Mapper::State::start_map() {
  started_ = true;
  has_pose_ = true;
  lost_ = Lost::no;
  add_walls();
  const PoseInformation own = fit_.own_information(frame_);
  map_.activate(map_.add_submap(Pose2{}, !own.determined(), epoch_));
  first_of_submap_ = true;
  in_map_ = own;
  integrate();
  note_seen();
}

/// One iteration.
void Mapper::State::place() {
  predict();
  match();
  if (frame_.empty()) return lose(Lost::nothing_seen);
  if (fit_.pairs() == 0 && ++frames_lost_ <= kBridgeFrames) return lose(Lost::nothing_known);
  frames_lost_ = 0;
  has_pose_ = true;
  lost_ = Lost::no;
  drop_strays();
  in_submap_ = fit_submap();
  watch_gap();
  add_walls();
  choose_submap();
  integrate();
  note_seen();
  search_gap();
  look_for_twins();
}

void Mapper::State::predict() {
  // The submap may have been moved since the last frame.
  T_map_robot_ = map_.submaps[map_.active()].T_map_submap * T_submap_robot_ * motion_;
}

void Mapper::State::match() {
  const Pose2 predicted = T_map_robot_;
  match_from(predicted);
  // It may have stopped.
  if (fit_.pairs() == 0) match_from(predicted * motion_.inverse());
}

void Mapper::State::match_from(const Pose2& T_map_robot) {
  T_map_robot_ = T_map_robot;
  matcher_.correct_heading(map_, recent_, frame_, T_map_robot_);
  matcher_.match_recent(map_, recent_, T_map_robot_, frame_);
  in_map_ = fit_map(kNone, T_map_robot_);
  matcher_.match_map(map_, epochs_known(), T_map_robot_, frame_);
  in_map_ = fit_map(kNone, T_map_robot_);
}

/// The oldest epoch whose walls are known to lie where the map has them, seen from here.
std::uint32_t Mapper::State::epochs_known() const {
  for (auto gap = gaps_.rbegin(); gap != gaps_.rend(); ++gap) {
    if (gap->range_m > kDriftBound_m) return gap->epoch;
  }
  return 0;
}

/// Fits a pose to the map as it was known before an epoch.
PoseInformation Mapper::State::fit_map(std::uint32_t before_epoch, Pose2& T) {
  fit_.clear();
  for (const Sighting& sighting : frame_) {
    if (sighting.wall == kNone || map_.walls[sighting.wall].epoch >= before_epoch) continue;
    const WallRecord& wall = map_.walls[sighting.wall];
    fit_.add(sighting, wall.estimate, wall.corner_epoch[kEndA] < before_epoch,
             wall.corner_epoch[kEndB] < before_epoch);
  }
  return fit_.solve(T);
}

PoseInformation Mapper::State::fit_submap() {
  const SubmapRecord& submap = map_.submaps[map_.active()];
  fit_.clear();
  for (const Sighting& sighting : frame_) {
    if (sighting.wall == kNone) continue;
    const Index member = map_.walls[sighting.wall].active_member;
    if (member != kNone) fit_.add(sighting, submap.members[member].estimate);
  }
  const Pose2 before = T_submap_robot_;
  T_submap_robot_ = submap.T_map_submap.inverse() * T_map_robot_;
  const PoseInformation information = fit_.solve(T_submap_robot_);
  const Pose2 moved = before.inverse() * T_submap_robot_;
  const double share = options_.smoothing;
  // Along a gap nothing was measured, and the step out of it is none that the robot made.
  Vec2 step = moved.t;
  if (!was_tied_ && !gaps_.empty()) {
    const Vec2 along = T_map_robot_.unrotate(gaps_.back().direction);
    step += along * along.dot(motion_.t - moved.t);
  }
  motion_ = Pose2::at(motion_.t + share * (step - motion_.t),
                      motion_.heading() + share * angle_between(motion_.r, moved.r));
  fastest_ = std::max(fastest_, motion_.t.norm());
  return information;
}

/// A piece that does not lie on its wall once the pose is known is none of it, and no wall of its own.
void Mapper::State::drop_strays() {
  std::size_t pair = 0;
  std::erase_if(frame_, [&](const Sighting& sighting) {
    if (sighting.wall == kNone) return false;
    const WallRecord& wall = map_.walls[sighting.wall];
    const bool recent = wall.last_seen + kRecentFrames >= answer_.counters.iterations;
    const double offset = std::abs(wall.estimate.basis.across(T_map_robot_ * sighting.middle));
    const double distance2 = fit_.line_distance2(pair++, T_map_robot_);
    return recent && offset > kStrayBound_m && distance2 > kStray2;
  });
}

/// Opens a gap where nothing tells the place along a direction any more, and widens it while that lasts.
void Mapper::State::watch_gap() {
  const bool tied = in_map_.determined();
  if (!tied) {
    ++answer_.counters.degenerate;
    if (was_tied_) {
      ++epoch_;
      ++answer_.counters.gaps;
      // Where no wall is known, the way ahead is what is known least.
      const bool any = in_map_.heading;
      gaps_.push_back(
          {epoch_, any ? in_map_.direction : T_map_robot_.r, any ? 0.0 : kBridgeFrames * fastest_});
    }
    Gap& gap = gaps_.back();
    // How far it can have gone; standing about, a robot does not go far.
    const double travel = std::abs(T_map_robot_.rotate(motion_.t).dot(gap.direction));
    const double fastest = kGapSpeed * fastest_ * std::abs(T_map_robot_.r.dot(gap.direction));
    gap.range_m += std::max(travel, fastest) + kGapStep_m;
  }
  was_tied_ = tied;
  close_gaps();
}

/// A frame that older walls determine where it was expected knows no gap since them.
void Mapper::State::close_gaps() {
  while (!gaps_.empty() && was_tied_) {
    Pose2 T = T_map_robot_;
    if (!fit_map(gaps_.back().epoch, T).determined()) return;
    if ((T.t - T_map_robot_.t).norm() > kDriftBound_m) return;
    gaps_.pop_back();
    ++answer_.counters.gaps_closed;
  }
}

void Mapper::State::add_walls() {
  for (Sighting& sighting : frame_) {
    if (sighting.wall == kNone) sighting.wall = map_.add_wall(epoch_, answer_.counters.iterations);
  }
}

/// A frame goes into the active submap if that alone determines its pose, and else begins another one.
void Mapper::State::choose_submap() {
  const SubmapRecord& submap = map_.submaps[map_.active()];
  const bool full = submap.frames >= static_cast<std::uint32_t>(options_.max_submap_frames);
  const bool own = fit_.own_information(frame_).determined();
  if (submap.lines_only) {
    const bool linked = in_submap_.heading && in_submap_.open < 2;
    if (own || !linked || full) change_submap(!own);
  } else if (!in_submap_.determined() || full || overlap_is_low()) {
    change_submap(!own);
  }
}

bool Mapper::State::overlap_is_low() const {
  const SubmapRecord& submap = map_.submaps[map_.active()];
  std::uint32_t shared = 0;
  for (const Sighting& sighting : frame_) {
    const Index member = map_.walls[sighting.wall].active_member;
    if (member != kNone && submap.members[member].in_first_frame) ++shared;
  }
  const double all = static_cast<double>(frame_.size() + submap.first_frame_size - shared);
  return shared < options_.overlap * all;
}

void Mapper::State::change_submap(bool lines_only) {
  const Index closed = map_.active();
  ++answer_.counters.closes;
  ++closes_since_step_;
  merge_twins(closed);
  const Index old = lines_only ? kNone : old_submap();
  if (old != kNone) {
    map_.activate(old);
    T_submap_robot_ = map_.submaps[old].T_map_submap.inverse() * T_map_robot_;
    const Pose2 motion = motion_;
    const PoseInformation information = fit_submap();
    motion_ = motion;
    if (information.determined()) {
      map_.submaps[old].frames = 0;
      ++answer_.counters.reopened;
      plan_step();
      return;
    }
  }
  map_.activate(map_.add_submap(T_map_robot_, lines_only, epoch_));
  T_submap_robot_ = Pose2{};
  first_of_submap_ = true;
  plan_step();
}

/// The closed submap whose first frame saw most nearly what this one sees, if any saw nearly the same.
Index Mapper::State::old_submap() const {
  Index best = kNone;
  double best_overlap = options_.overlap;
  std::vector<std::pair<Index, std::uint32_t>> shared;
  for (const Sighting& sighting : frame_) {
    for (const Membership& at : map_.walls[sighting.wall].memberships) {
      const SubmapRecord& submap = map_.submaps[at.submap];
      if (submap.lines_only || at.submap == map_.active() || !submap.members[at.member].in_first_frame)
        continue;
      const auto found =
          std::find_if(shared.begin(), shared.end(), [&](const auto& s) { return s.first == at.submap; });
      if (found == shared.end()) {
        shared.emplace_back(at.submap, 1u);
      } else {
        ++found->second;
      }
    }
  }
  for (const auto& [submap, count] : shared) {
    const double overlap =
        count / static_cast<double>(frame_.size() + map_.submaps[submap].first_frame_size - count);
    if (overlap > best_overlap || (overlap == best_overlap && submap < best)) {
      best = submap;
      best_overlap = overlap;
    }
  }
  return best;
}

/// Says which ends of a piece are evidence, and takes note of what speaks against corners.
void Mapper::State::note_ends(const Sighting& sighting, bool (&corner)[2]) {
  WallRecord& wall = map_.walls[sighting.wall];
  const SubmapRecord& submap = map_.submaps[map_.active()];
  corner[kEndA] = corner[kEndB] = false;
  if (submap.lines_only) return;
  const Noise noise = options_.noise();
  const double own2 = noise.end * noise.end + noise.along * noise.along;
  const WallEstimate& local = submap.members[wall.active_member].estimate;
  for (int k = 0; k < 2; ++k) {
    corner[k] = sighting.corner[k];
    const double sign = k == kEndA ? -1.0 : 1.0;
    bool beyond = false;
    bool astray = false;
    const auto compare = [&](const WallEstimate& wall_estimate, const Pose2& T, double slack) {
      if (!wall_estimate.known[k]) return;
      const double off = wall_estimate.basis.along(T * sighting.end[k]) - wall_estimate.end[k];
      const double gate = kGateSigmas * std::sqrt(own2 + wall_estimate.variance[k]) + slack;
      if (sign * off > gate + kBeyond_m) beyond = true;
      if (std::abs(off) > gate) astray = true;
    };
    if (submap.members[wall.active_member].evidence.count() > 0) compare(local, T_submap_robot_, 0.0);
    if (gaps_.empty() || wall.epoch >= gaps_.back().epoch)
      compare(wall.estimate, T_map_robot_, options_.map_bound_m);
    if (beyond) ++wall.against[k];
    if (!gaps_.empty() && gaps_.back().range_m > kDriftBound_m && wall.corners[k] > 0 &&
        wall.corner_epoch[k] < gaps_.back().epoch)
      corner[k] = false;  // it is known where it was, and not yet where this is
    if (corner[k] && astray) {
      ++wall.astray[k];
      corner[k] = false;
    }
  }
}

void Mapper::State::integrate() {
  const Index active = map_.active();
  for (const Sighting& sighting : frame_) {
    WallRecord& wall = map_.walls[sighting.wall];
    if (wall.active_member == kNone) map_.join(active, sighting.wall, first_of_submap_);
    bool corner[2];
    note_ends(sighting, corner);
    map_.observe(wall.active_member, T_submap_robot_, sighting, corner);
  }
  ++map_.submaps[active].frames;
  first_of_submap_ = false;
  for (const Sighting& sighting : frame_) {
    const WallRecord& wall = map_.walls[sighting.wall];
    for (int k = 0; k < 2; ++k) {
      const bool disproved = wall.against[k] >= kLeastAgainst && 20 * wall.against[k] > wall.corners[k];
      if (disproved || wall.astray[k] > wall.corners[k] + 2 * kLeastAgainst) {
        map_.revoke_corner(sighting.wall, k);
        step_.abandon();
        ++answer_.counters.corners_revoked;
      }
    }
    map_.update(sighting.wall);
  }
}

void Mapper::State::note_seen() {
  const std::uint64_t now = answer_.counters.iterations;
  for (const Sighting& sighting : frame_) {
    WallRecord& wall = map_.walls[sighting.wall];
    if (wall.last_seen + kYoungFrames < now) on_old_ground_ = true;
    wall.last_seen = now;
    if (std::find(recent_.begin(), recent_.end(), sighting.wall) == recent_.end())
      recent_.push_back(sighting.wall);
    if (!gaps_.empty() && std::find(young_.begin(), young_.end(), sighting.wall) == young_.end())
      young_.push_back(sighting.wall);
  }
  std::erase_if(recent_, [&](Index w) { return map_.walls[w].last_seen + kRecentFrames < now; });
}

/// Where what was seen since the last gap lies among what was seen before it.
void Mapper::State::search_gap() {
  if (gaps_.empty()) {
    young_.clear();
    return;
  }
  if (tie_by_corner() || answer_.counters.iterations % kSearchPeriod != 0) return;
  const std::uint64_t now = answer_.counters.iterations;
  std::erase_if(young_, [&](Index w) {
    const WallRecord& wall = map_.walls[w];
    return wall.merged_into != kNone || wall.last_seen + kYoungFrames < now;
  });
  for (auto gap = gaps_.rbegin(); gap != gaps_.rend(); ++gap) {
    if (gap->range_m <= kDriftBound_m) continue;
    std::vector<Index> young;
    for (const Index w : young_) {
      if (map_.walls[w].epoch >= gap->epoch &&
          map_.walls[w].count >= static_cast<std::uint32_t>(options_.min_observations))
        young.push_back(w);
    }
    if (young.size() > kMostYoung) {
      std::stable_sort(young.begin(), young.end(),
                       [&](Index a, Index b) { return map_.walls[a].last_seen > map_.walls[b].last_seen; });
      young.resize(kMostYoung);
    }
    Vec2 step;
    if (young.empty() || !search_.find(map_, young, *gap, step, twins_)) continue;
    const double shift = step.dot(gap->direction);
    const bool again = has_seen_shift_ && std::abs(shift - seen_shift_) < kDriftBound_m;
    has_seen_shift_ = !again;
    seen_shift_ = shift;
    if (!again) return;
    const Gap found = *gap;
    gaps_.erase(std::next(gap).base());
    return take_shift(found, step, twins_);
  }
  has_seen_shift_ = false;
}

/// A wall that was in view all through the last gap shows a corner that is known from before it: that tells how far the robot went,
/// once a few frames agree.
bool Mapper::State::tie_by_corner() {
  const Gap gap = gaps_.back();
  double nearest = gap.range_m + kDriftBound_m;
  for (const Sighting& sighting : frame_) {
    const WallRecord& wall = map_.walls[sighting.wall];
    const double along = wall.estimate.basis.direction.dot(gap.direction);
    if (wall.epoch >= gap.epoch || std::abs(along) < kAlongGap) continue;
    for (int k = 0; k < 2; ++k) {
      if (!wall.estimate.known[k] || !sighting.corner[k] || wall.corner_epoch[k] >= gap.epoch) continue;
      const double shift =
          (wall.estimate.end[k] - wall.estimate.basis.along(T_map_robot_ * sighting.end[k])) / along;
      if (std::abs(shift) < std::abs(nearest)) nearest = shift;
    }
  }
  if (std::abs(nearest) >= gap.range_m + kDriftBound_m) {
    ties_ = 0;
    return false;
  }
  ties_ = ties_ > 0 && std::abs(nearest - tie_) < kDriftBound_m ? ties_ + 1 : 1;
  tie_ = nearest;
  if (ties_ < kTies) return false;
  ties_ = 0;
  gaps_.pop_back();
  take_shift(gap, nearest * gap.direction, {});
  return true;
}

void Mapper::State::take_shift(const Gap& gap, const Vec2& step, const std::vector<Twins>& twins) {
  step_.abandon();
  map_.shift(gap.epoch, step);
  T_map_robot_.t += step;
  for (const Twins& pair : twins) merge(pair.kept, pair.gone);
  ++answer_.counters.gaps_closed;
  on_old_ground_ = true;
  closes_since_step_ = 1 << 20;
  plan_step();
}

void Mapper::State::merge(Index kept, Index gone) {
  kept = map_.resolve(kept);
  gone = map_.resolve(gone);
  if (kept == gone) return;
  step_.abandon();
  map_.merge(kept, gone);
  ++answer_.counters.merged;
  for (Sighting& sighting : frame_) {
    if (sighting.wall == gone) sighting.wall = kept;
  }
  std::erase(recent_, gone);
  if (std::find(recent_.begin(), recent_.end(), kept) == recent_.end()) recent_.push_back(kept);
}

void Mapper::State::merge_twins(Index submap) {
  for (std::size_t m = 0; m < map_.submaps[submap].members.size(); ++m) {
    const Index w = map_.submaps[submap].members[m].wall;
    if (w != kNone) merge_twin(w);
  }
}

/// A wall that lies where another one does is the same, and so are two parts of one line between which something hides the rest.
void Mapper::State::merge_twin(Index w) {
  const auto least = static_cast<std::uint32_t>(options_.min_observations);
  if (map_.walls[w].merged_into != kNone || map_.walls[w].count < least) return;
  const WallEstimate& wall = map_.walls[w].estimate;
  const std::uint32_t known = epochs_known();
  Index twin = kNone;
  const auto look_at = [&](Index other) {
    if (other == w || map_.walls[other].count < least || other > twin) return;
    // Where two lie to each other beyond a gap is not known.
    if ((map_.walls[other].epoch < known) != (map_.walls[w].epoch < known)) return;
    bool contradict = false;
    if (are_twins(map_.walls[other].estimate, wall, Vec2::Zero(), 0.5 * options_.match_bound_m, kTwinSine,
                  contradict) ||
        are_parts(map_.walls[other], map_.walls[w]))
      twin = other;
  };
  for (const double share : {0.0, 0.5, 1.0}) {
    map_.visit_near(wall.basis.point(wall.reach[kEndA] + share * (wall.reach[kEndB] - wall.reach[kEndA])),
                    look_at);
  }
  if (twin != kNone) merge(std::min(w, twin), std::max(w, twin));
}

/// Two walls out of view, on one line with a short distance between or a short overlap, neither of which was seen to end there.
bool Mapper::State::are_parts(const WallRecord& one, const WallRecord& other) const {
  const std::uint64_t now = answer_.counters.iterations;
  if (std::min(one.count, other.count) < kPartSightings) return false;
  if (std::max(one.last_seen, other.last_seen) + kPartFrames > now) return false;
  const WallBasis& basis = one.estimate.basis;
  const Vec2& direction = other.estimate.basis.direction;
  if (basis.direction.dot(direction) <= 0.0 || std::abs(cross(basis.direction, direction)) > kTwinSine)
    return false;
  const Vec2 end[2] = {other.estimate.basis.point(other.estimate.reach[kEndA]),
                       other.estimate.basis.point(other.estimate.reach[kEndB])};
  const double shorter = std::min(one.estimate.reach[kEndB] - one.estimate.reach[kEndA],
                                  other.estimate.reach[kEndB] - other.estimate.reach[kEndA]);
  for (int k = 0; k < 2; ++k) {  // the end of `one` that faces the other
    const double sign = k == kEndA ? -1.0 : 1.0;
    const double apart = sign * (basis.along(end[1 - k]) - one.estimate.reach[k]);
    if (apart < -0.5 * shorter || apart > kPartDistance_m) continue;  // more overlap makes twins
    return !one.estimate.known[k] && !other.estimate.known[1 - k] &&
           std::abs(basis.across(end[1 - k])) < kStrayBound_m;
  }
  return false;
}

/// Each frame looks at one wall: some turn out to have twins only once the map has settled.
void Mapper::State::look_for_twins() {
  if (map_.walls.empty()) return;
  if (next_twin_ >= map_.walls.size()) next_twin_ = 0;
  merge_twin(next_twin_++);
}

/// The step over all submaps pays once a loop has closed; else now and then.
void Mapper::State::plan_step() {
  if (step_.under_way()) return;
  const int period = on_old_ground_ ? 5 : 10;
  if (closes_since_step_ < std::max<int>(period, static_cast<int>(map_.submaps.size() / 10))) return;
  closes_since_step_ = 0;
  on_old_ground_ = false;
  step_.begin(map_);
}

void Mapper::State::advance_step() {
  if (!step_.under_way() || !step_.advance(map_, kWorkPerFrame)) return;
  if (!step_.apply(map_)) return;
  map_.refresh_all();
  ++answer_.counters.global_steps;
}

void Mapper::State::lose(Lost reason) {
  has_pose_ = false;
  lost_ = reason;
  for (Sighting& sighting : frame_) sighting.wall = kNone;
  // The prediction goes on from here.
  T_submap_robot_ = map_.submaps[map_.active()].T_map_submap.inverse() * T_map_robot_;
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = has_pose_;
  answer_.lost = lost_;
  answer_.undetermined = answer_.untied = Vec2::Zero();
  answer_.covariance.setZero();
  if (has_pose_) {
    answer_.T_map_robot = T_map_robot_;
    Mat3 information = in_map_.matrix;
    const double range = gaps_.empty() ? 0.0 : gaps_.back().range_m;
    // What the walls leave open is known by the prediction alone.
    information.topLeftCorner<2, 2>() += Mat2::Identity() / (1.0 + range * range);
    information(2, 2) += 1.0;
    answer_.covariance = information.inverse();
    if (in_map_.open > 0) answer_.undetermined = in_map_.direction;
    if (!gaps_.empty()) answer_.untied = gaps_.back().direction;
  } else {
    ++answer_.counters.lost;
  }
  for (const Sighting& sighting : frame_) {
    if (sighting.wall != kNone) answer_.associations[sighting.given] = first_id_ + sighting.wall;
  }
  answer_.counters.walls = map_.walls.size() - answer_.counters.merged;
  answer_.counters.submaps = map_.submaps.size();
  return answer_;
}

Map Mapper::State::told(const WallMap& walls) const {
  Map map;
  for (Index w = 0; w < walls.walls.size(); ++w) {
    const WallRecord& record = walls.walls[w];
    if (record.merged_into != kNone || record.memberships.empty()) continue;
    Wall wall;
    wall.id = first_id_ + w;
    wall.a = record.estimate.basis.point(record.estimate.reach[kEndA]);
    wall.b = record.estimate.basis.point(record.estimate.reach[kEndB]);
    for (int k = 0; k < 2; ++k) wall.certain[k] = record.estimate.known[k];
    wall.z_low = record.z_low;
    wall.z_high = record.z_high;
    wall.observations = record.count;
    if (record.count >= static_cast<std::uint32_t>(options_.min_observations))
      wall.status = WallStatus::mapped;
    map.walls.push_back(wall);
  }
  for (Index s = 0; s < walls.submaps.size(); ++s) {
    Submap submap;
    submap.id = s;
    submap.T_map_submap = walls.submaps[s].T_map_submap;
    submap.lines_only = walls.submaps[s].lines_only;
    for (const Member& member : walls.submaps[s].members) {
      if (member.wall != kNone) submap.members.push_back(first_id_ + member.wall);
    }
    map.submaps.push_back(std::move(submap));
  }
  return map;
}

Map Mapper::State::refined_map() const {
  WallMap refined = map_;
  MapStep step;
  step.set_tolerance(1e-9);
  for (int i = 0; i < kRefineSteps && started_; ++i) {
    step.begin(refined);
    step.advance(refined, kRefineWork);
    if (!step.apply(refined)) break;
    refined.refresh_all();
    if (step.largest_move() < kSettled) break;
  }
  return told(refined);
}

Mapper::Mapper(const Options& options) : state_(std::make_unique<State>(options)) {}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const Answer& Mapper::process(std::span<const Piece> pieces, const View& view) {
  return state_->process(pieces, view);
}

Map Mapper::map() const {
  return state_->map();
}

Map Mapper::refined_map() const {
  return state_->refined_map();
}

void Mapper::reset() {
  state_ = std::make_unique<State>(Options(state_->options()));
}

const Options& Mapper::options() const {
  return state_->options();
}

}  // namespace hallway::slam_plane
