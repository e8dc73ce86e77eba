// SPDX-License-Identifier: MIT
#include "slam_point/core/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "slam_point/core/active_submap.hpp"
#include "slam_point/core/alignment.hpp"
#include "slam_point/core/constellation_index.hpp"
#include "slam_point/core/frame_matcher.hpp"
#include "slam_point/core/map_parts.hpp"
#include "slam_point/core/map_step.hpp"
#include "slam_point/core/relocaliser.hpp"
#include "slam_point/core/submap_graph.hpp"
#include "slam_point/core/submap_solver.hpp"
#include "slam_point/core/track_book.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr int kMaxGlobalSteps = 20;
constexpr double kSureShare = 0.5;   // of the comparable points, below which a better pose is searched
constexpr int kSurePoints = 6;       // or all there are, likewise
constexpr double kLeastShare = 0.4;  // below which there is no pose
constexpr int kLeastAgreeing = 3;    // points: likewise, where the sensor was expected
constexpr int kLeastInPlane = 2;     // likewise, of points in a plane
constexpr int kLeastAfterLoss = 4;   // after a frame without a pose
constexpr int kLeastAfterGap = 5;    // after more than a short gap
constexpr int kShortGap = 3;         // frames
constexpr int kTriedAfterGap = 300;  // places, as many as the turns that are tried
constexpr double kMostAfterGap = 1e-3;
constexpr double kWorthwhileGain =
    0.01;  // fall of the cost for which a step over the whole map is repeated soon
constexpr double kWorkPerClose = 6e5;  // multiplications: those that factorise a window of 20 submaps
constexpr double kWorkPerFrame = 6e5;  // on a step over the whole map: some tenths of a millisecond
constexpr int kMaxSettlePeriod = 1 << 20;
constexpr int kIndexedPerFrame = 8;          // landmarks whose constellations are noted
constexpr std::size_t kMovedPerFrame = 100;  // landmarks of a part that moves into another one
constexpr std::uint64_t kYoungFrames = 10;   // a part with fewer is given up when the sensor gets lost in it
constexpr std::uint64_t kMeetPeriod = 10;    // frames between looks for other parts, in one that is not young
constexpr std::size_t kLeastPartPoints = 5;  // that begin another part
constexpr int kIndexedAtOnce = 64;           // landmarks of the active submap, when a frame is looked for
constexpr double kMostTravelBounds = 5.0;    // match bounds of travel a frame that are taken for motion
constexpr double kMostTurn_rad = 1.0;        // likewise
constexpr int kFalsePartsAtOnce = 8;
constexpr int kMostDoublings = 6;
constexpr std::uint32_t kLeastInView = 3;  // observations of a landmark that is looked for in other parts
constexpr double kIndexNoises = 4.0;
constexpr double kMeetingNoises = 12.0;

/// A pose in the frame that `anchor` is in, as told: in the frame of `anchor`. While that is the same frame, nothing is rounded.
Pose told_from(const Pose& anchor, const Pose& pose) {
  const bool same = anchor.t.isZero(0.0) && anchor.q.vec().isZero(0.0);
  return same ? pose : anchor.inverse() * pose;
}

const Options& checked(const Options& options) {
  options.validate();
  return options;
}

}  // namespace

class Mapper::State {
 public:
  explicit State(const Options& options)
      : options_(checked(options)),
        matcher_(options),
        graph_(std::max(
                   {options.match_bound(), options.map_bound(), options.separation(), matcher_.agreement()}),
               static_cast<IndexKind>(options.index)),
        active_(std::max(options.match_bound(), matcher_.agreement()), static_cast<IndexKind>(options.index)),
        parts_(matcher_.agreement()),
        constellations_(kIndexNoises * options.noise_m, static_cast<std::uint32_t>(options.min_observations)),
        relocaliser_(options, matcher_.rules(true), matcher_.rules(false), options.map_bound()),
        meeting_(kMeetingNoises * options.noise_m),
        settle_period_(options.global_period),
        ranges_count_(options.noise_per_m > 0.0 || options.noise_per_m2 > 0.0) {}

  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);
  Map map(const std::vector<Pose>& poses) const;
  const SubmapGraph& graph() const { return graph_; }
  bool planar() const { return planar_; }
  const Options& options() const { return options_; }
  void time_stages(StageTimes* times) { clock_.add_to(times); }

 private:
  struct Motion {
    Vec3 turn = Vec3::Zero();
    Vec3 travel = Vec3::Zero();
  };

  void place(std::span<const Vec3> points, std::span<const TrackId> tracks);
  void take_points(std::span<const Vec3> points, std::span<const TrackId> tracks);
  void take_tracks(std::span<const TrackId> tracks);
  double weight_of(const Vec3& point) const;
  bool can_start() const;
  void start_map();
  void predict();
  void match_active_submap();
  std::uint64_t local_since() const;
  void match_map();
  bool fit_pose();
  void search();
  bool search_constellations();
  void search_turn();
  bool look_from(const Pose& T_map_sensor);
  bool is_placed();
  std::size_t comparable_points() const;
  int determined_by_few() const;
  void lose_pose();
  bool recover();
  void gather_frame();
  void enter(const Placement& found);
  void leave_part(Index part);
  bool start_over();
  bool start_part();
  int frames_to_bridge(bool false_start) const;
  bool meet_part();
  void join_part(Index other, const Pose& T_other_part);
  void gather_view();
  void learn_motion();
  void add_landmarks();
  double overlap_with_active() const;
  void change_submap();
  void take_submap();
  void close_submap();
  void apply_map_step();
  void begin_map_step();
  void merge_landmarks(Index closed);
  Index best_old_submap();
  bool reopen(Index submap);
  void open_new_submap();
  void integrate();
  Index told_part() const;
  const Answer& answer();

  Options options_;
  FrameMatcher matcher_;
  SubmapGraph graph_;
  ActiveSubmap active_;
  WindowSolver window_solver_;
  TrackBook tracks_;
  MapStep map_step_;
  MapParts parts_;
  ConstellationIndex constellations_;
  Relocaliser relocaliser_;
  PartMeeting meeting_;
  Placement found_;         // of this frame, by what it sees alone, where tracking cannot go on to
  std::vector<Vec3> view_;  // what is looked for in other parts, sensor frame
  int false_parts_ = 0;     // parts begun that no second frame was placed in, since one was
  bool map_step_ready_ = false;

  std::vector<Observation> frame_;
  FrameMatcher::Fit fit_;
  Pose predicted_;             // T_submap_sensor
  Pose last_T_submap_sensor_;  // of the last frame with a pose
  Pose T_map_sensor_;
  Motion motion_;  // of one frame, in the frame of the earlier sensor pose
  bool has_motion_ = false;
  int agreeing_ = 0;           // points of this frame that lie on their landmark up to noise
  std::size_t last_seen_ = 0;  // landmarks seen by the last frame with a pose
  bool searched_ = false;
  bool fits_ = false;      // the matches determine a pose, whether they agree with it or not
  bool followed_ = false;  // this frame came with the sensor's tracks, and they count
  bool started_ = false;
  bool planar_ = true;
  bool has_pose_ = false;
  bool first_of_submap_ = false;
  int frames_without_pose_ = 0;
  std::uint64_t placed_frames_ = 0;
  std::uint64_t activation_ = 0;
  std::vector<Index> window_;  // the last submaps closed, newest last
  std::vector<Pose> search_bases_;
  std::vector<std::uint32_t> shared_;  // submap -> landmarks in view of its first frame
  std::vector<Index> shared_submaps_;
  bool loop_closed_ = false;  // since the last step over the whole map was begun
  int closes_since_settled_ = 0;
  double settled_submaps_ = 0.0;  // how many the last step over the whole map places
  int settle_period_;             // closes between steps over the whole map, as they have proved worth it
  LandmarkId first_id_ = 0;       // id of landmark 0
  bool ranges_count_;             // noise grows with the range
  Answer answer_;
  StageClock clock_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  clock_.begin();
  constellations_.advance(graph_, kIndexedPerFrame);
  answer_.counters.merged += parts_.advance(graph_, kMovedPerFrame);
  place(points, tracks);
  if (map_step_.under_way()) map_step_ready_ = map_step_.advance(kWorkPerFrame);
  clock_.end(Stage::solving);
  return answer();
}

void Mapper::State::place(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  take_points(points, tracks);
  if (!started_) {
    has_pose_ = can_start();
    if (has_pose_) {
      parts_.begin(graph_);
      start_map();
    }
    return;
  }
  predict();
  match_active_submap();
  match_map();
  clock_.end(Stage::matching);
  if (!fit_pose()) search();
  has_pose_ = is_placed();
  clock_.end(Stage::fitting);
  if (!has_pose_) {
    has_pose_ = recover();
    return;
  }
  matcher_.drop_strays(graph_, T_map_sensor_, local_since(), frame_);
  learn_motion();
  add_landmarks();
  const bool is_over = overlap_with_active() < options_.overlap ||
                       active_.frames() >= static_cast<std::size_t>(options_.max_submap_frames);
  clock_.end(Stage::averaging);
  if (meet_part()) {
    take_submap();
    clock_.end(Stage::closing);
  } else if (is_over) {
    change_submap();
    clock_.end(Stage::closing);
  }
  integrate();
  clock_.end(Stage::averaging);
}

void Mapper::State::take_points(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  frame_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Written so that NaN fails.
    if (!(points[i].cwiseAbs().maxCoeff() <= kMaxCoordinate_m) || !points[i].allFinite()) continue;
    if (points[i].z() != 0.0) planar_ = false;
    frame_.push_back({points[i], i});
    if (ranges_count_) frame_.back().weight = weight_of(points[i]);
  }
  take_tracks(tracks);
  answer_.associations.assign(points.size(), kNoLandmark);
  answer_.determined = 0;
  ++answer_.counters.iterations;
}

double Mapper::State::weight_of(const Vec3& point) const {
  const double share = options_.noise_m / options_.noise_at(point.norm());
  return share * share;
}

void Mapper::State::take_tracks(std::span<const TrackId> tracks) {
  followed_ = options_.association == Association::sensor && !tracks.empty();
  if (!followed_) return;
  for (Observation& observation : frame_) {
    observation.track = tracks[observation.given];
    observation.expected = tracks_.landmark_of(observation.track, graph_);
    const bool elsewhere =
        observation.expected != kNone && graph_.landmarks[observation.expected].part != graph_.part();
    if (elsewhere) observation.expected = kNone;
  }
}

bool Mapper::State::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_)
    own.add(observation.point, observation.point, observation.weight);
  const FitRules rules = matcher_.rules(planar_);
  Pose unused;
  return own.pairs() >= kLeastAgreeing && own.solve(planar_, rules.min_spread_m2, unused);
}

void Mapper::State::start_map() {
  started_ = true;
  frames_without_pose_ = 0;
  T_map_sensor_ = Pose{};
  add_landmarks();
  open_new_submap();
  parts_.anchor(graph_, graph_.active());
  integrate();
}

void Mapper::State::predict() {
  predicted_ = last_T_submap_sensor_;
  const int frames = std::min(frames_without_pose_, options_.bridge_frames) + 1;
  for (int f = 0; f < frames; ++f) predicted_ = predicted_ * Pose{rotation_exp(motion_.turn), motion_.travel};
}

void Mapper::State::match_active_submap() {
  fit_ = matcher_.match_active(graph_, active_, predicted_, planar_, frame_);
}

/// The activation from which on landmarks lie where the recent submaps put them.
std::uint64_t Mapper::State::local_since() const {
  const std::uint64_t window = static_cast<std::uint64_t>(options_.window);
  return activation_ > window ? activation_ - window : 0;
}

void Mapper::State::match_map() {
  // Where the active submap gave no fit, the prediction alone says where to look.
  const double local_bound = fit_.solved ? matcher_.agreement() : options_.match_bound();
  T_map_sensor_ = graph_.poses[graph_.active()] * fit_.T_submap_sensor;
  matcher_.match_map(graph_, T_map_sensor_, local_since(), local_bound, frame_);
}

bool Mapper::State::fit_pose() {
  agreeing_ = 0;
  fits_ = matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  if (fits_) {
    agreeing_ = matcher_.count_agreeing(graph_, frame_, T_map_sensor_);
  }
  if (!fit_.solved) fit_.T_submap_sensor = graph_.poses[graph_.active()].inverse() * T_map_sensor_;
  searched_ = false;
  found_ = Placement();
  // A few points can agree by chance, so of few nearly all must.
  const auto comparable = static_cast<int>(comparable_points());
  return agreeing_ >= std::min(comparable, kSurePoints) && agreeing_ >= kSureShare * comparable;
}

void Mapper::State::search() {
  if (followed_) return;  // tracks need no prediction
  ++answer_.counters.searches;
  if (!search_constellations()) search_turn();
}

/// Looks for the frame by what it sees alone, in all of the map.
bool Mapper::State::search_constellations() {
  // What is being joined lies in two frames.
  if (parts_.is_joining()) return false;
  constellations_.add_now(graph_, graph_.active(), kIndexedAtOnce);
  gather_frame();
  Placement found;
  if (!relocaliser_.locate(graph_, constellations_, view_, kNone, planar_, found)) return false;
  ++answer_.counters.relocalised;
  if (found.part == graph_.part() && look_from(found.T_map_points)) return true;
  agreeing_ = 0;
  found_ = found;
  return true;
}

/// Matches and fits the frame from a new guess. Whether it is placed then.
bool Mapper::State::look_from(const Pose& T_map_sensor) {
  predicted_ = graph_.poses[graph_.active()].inverse() * T_map_sensor;
  match_active_submap();
  match_map();
  fit_pose();
  searched_ = true;
  return is_placed();
}

void Mapper::State::search_turn() {
  if (options_.max_turn_rad <= 0.0) return;
  const Pose& T_map_submap = graph_.poses[graph_.active()];
  search_bases_.assign({T_map_submap * predicted_, T_map_submap * last_T_submap_sensor_});
  const double reach = std::min(options_.max_turn_rad * (1.0 + frames_without_pose_), std::numbers::pi);
  Pose found;
  if (matcher_.search_turn(graph_, search_bases_, reach, planar_, frame_, found) <= agreeing_) return;
  look_from(found);
}

bool Mapper::State::is_placed() {
  // The less is known of where the sensor may be, the more places there are where a few points agree by chance.
  // Where it is expected, two determine the pose in a plane; but a frame of no more than these has nothing to check them by.
  int least = planar_ && frame_.size() >= kLeastAgreeing ? kLeastInPlane : kLeastAgreeing;
  if (searched_) least = kLeastAgreeing;
  if (frames_without_pose_ > 0) least = kLeastAfterLoss;
  if (frames_without_pose_ > kShortGap) least = kLeastAfterGap;
  if (frames_without_pose_ > kShortGap && agreeing_ >= least) {
    gather_frame();
    if (relocaliser_.chance_at(graph_, view_, T_map_sensor_, planar_, kTriedAfterGap) > kMostAfterGap)
      return false;
  }
  return agreeing_ >= least &&
         static_cast<double>(agreeing_) >= kLeastShare * static_cast<double>(comparable_points());
}

std::size_t Mapper::State::comparable_points() const {
  // A view that opens shows much that is new, one that closes little of what was seen: the smaller of both must agree.
  return std::min(frame_.size(), last_seen_);
}

/// Degrees of freedom that points near where they were expected determine, when these are too few or on a line.
int Mapper::State::determined_by_few() const {
  // What fits and yet does not agree tells nothing, nor does what was expected long ago.
  if (fits_ || frames_without_pose_ >= options_.bridge_frames) return 0;
  const auto matched = std::count_if(frame_.begin(), frame_.end(), [](const Observation& observation) {
    return observation.landmark != kNone;
  });
  if (matched == 0) return 0;
  if (planar_) return 2;
  return matched == 1 ? 3 : 5;
}

void Mapper::State::lose_pose() {
  answer_.determined = determined_by_few();
  for (Observation& observation : frame_) observation.landmark = kNone;
  ++frames_without_pose_;
}

bool Mapper::State::recover() {
  lose_pose();
  if (found_.part != kNone) {
    enter(found_);
    return true;
  }
  return start_over() || start_part();
}

void Mapper::State::gather_frame() {
  view_.clear();
  for (const Observation& observation : frame_) view_.push_back(observation.point);
}

/// Goes on from where the frame was found.
void Mapper::State::enter(const Placement& found) {
  const Index left = graph_.part();
  close_submap();
  graph_.set_part(found.part);
  if (left != found.part) leave_part(left);
  T_map_sensor_ = found.T_map_points;
  frames_without_pose_ = 0;
  matcher_.mark(graph_, frame_);
  // Nothing says how the place found drifted against where the sensor was: all of it is old.
  const std::uint64_t never = ~std::uint64_t{0};
  matcher_.match_map(graph_, T_map_sensor_, never, options_.map_bound(), frame_);
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  matcher_.drop_strays(graph_, T_map_sensor_, never, frame_);
  add_landmarks();
  take_submap();
  integrate();
}

void Mapper::State::leave_part(Index part) {
  window_.clear();
  map_step_ = MapStep();
  map_step_ready_ = false;
  if (parts_.frames(part) < kYoungFrames && part != parts_.first()) parts_.drop(graph_, part);
}

/// Begins another part of the map where the sensor is now: the frames before could not be bridged.
bool Mapper::State::start_part() {
  if (parts_.is_joining() || frame_.size() < kLeastPartPoints || !can_start()) return false;
  const Index left = graph_.part();
  const bool false_start = parts_.frames(left) == 1;
  if (frames_without_pose_ <= frames_to_bridge(false_start)) return false;
  false_parts_ = false_start ? false_parts_ + 1 : 0;
  close_submap();
  parts_.begin(graph_);
  leave_part(left);
  start_map();
  return true;
}

/// A part that no second frame was placed in is begun again at once; what goes on like this is tried ever more seldom.
int Mapper::State::frames_to_bridge(bool false_start) const {
  if (!false_start) return options_.bridge_frames;
  if (false_parts_ < kFalsePartsAtOnce) return 0;
  return (1 + options_.bridge_frames) << std::min(false_parts_ - kFalsePartsAtOnce, kMostDoublings);
}

/// The landmarks about the sensor: more of them, and better known, than one frame sees.
void Mapper::State::gather_view() {
  const Pose T_sensor_map = T_map_sensor_.inverse();
  view_.clear();
  const std::uint64_t frames = parts_.frames(graph_.part());
  const auto least = static_cast<std::uint32_t>(std::min<std::uint64_t>(kLeastInView, frames));
  for (const Member& member : graph_.submaps[graph_.active()].members) {
    if (member.count == 0 || graph_.landmarks[member.landmark].count < least) continue;
    view_.push_back(T_sensor_map * graph_.landmarks[member.landmark].position);
  }
}

/// Looks for what is about the sensor in other parts of the map. True when this part and another one were joined, so that no
/// submap is active.
bool Mapper::State::meet_part() {
  if (parts_.count() < 2 || parts_.is_joining()) return false;
  const Index here = graph_.part();
  if (parts_.frames(here) >= kYoungFrames && answer_.counters.iterations % kMeetPeriod != 0) return false;
  gather_view();
  Placement found;
  if (!relocaliser_.locate(graph_, constellations_, view_, here, planar_, found)) return false;
  const Pose T_other_here = found.T_map_points * T_map_sensor_.inverse();
  for (Vec3& p : view_) p = T_map_sensor_ * p;
  if (!meeting_.confirm(here, found.part, T_other_here, view_)) return false;
  join_part(found.part, T_other_here);
  return true;
}

void Mapper::State::join_part(Index other, const Pose& T_other_part) {
  close_submap();
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  T_map_sensor_ = parts_.join(graph_, other, graph_.part(), T_other_part) * T_map_sensor_;
  const std::size_t merged = parts_.merged();
  for (Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    if (graph_.landmarks[observation.landmark].part != graph_.part())
      observation.landmark = parts_.move(graph_, observation.landmark);
  }
  answer_.counters.merged += parts_.merged() - merged;
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  map_step_ = MapStep();
  map_step_ready_ = false;
  loop_closed_ = true;
  ++answer_.counters.joined;
}

bool Mapper::State::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep. One of a few frames is
  // when the sensor does not come back to it.
  const bool waited = frames_without_pose_ > options_.bridge_frames && parts_.count() == 1;
  if (placed_frames_ > 1 && !(waited && placed_frames_ < kYoungFrames)) return false;
  if (!can_start()) return false;
  first_id_ += graph_.landmarks.size();
  placed_frames_ = 0;
  graph_.clear();
  active_.clear();
  constellations_.clear();
  parts_.clear();
  parts_.begin(graph_);
  tracks_.clear();
  for (Observation& observation : frame_) observation.expected = kNone;
  map_step_ = MapStep();
  start_map();
  return true;
}

void Mapper::State::learn_motion() {
  const Pose moved = last_T_submap_sensor_.inverse() * fit_.T_submap_sensor;
  const double frames = static_cast<double>(frames_without_pose_ + 1);
  const Vec3 turn = rotation_log(moved.q) / frames;
  const Vec3 travel = moved.t / frames;
  // What was carried away did not move so.
  const bool carried =
      travel.norm() > kMostTravelBounds * options_.match_bound() || turn.norm() > kMostTurn_rad;
  frames_without_pose_ = 0;
  last_T_submap_sensor_ = fit_.T_submap_sensor;
  if (searched_ && carried) return;
  // After a sudden motion the old average says nothing.
  const double share = has_motion_ && !searched_ ? options_.smoothing : 1.0;
  motion_.turn += share * (turn - motion_.turn);
  motion_.travel += share * (travel - motion_.travel);
  has_motion_ = true;
}

void Mapper::State::add_landmarks() {
  const Mat3 rotation = T_map_sensor_.q.toRotationMatrix();
  const double separation2 = options_.separation() * options_.separation();
  for (Observation& observation : frame_) {
    if (observation.is_followed() && !tracks_.allows_new(observation)) continue;
    if (observation.landmark != kNone || observation.withheld) continue;
    const Vec3 p = rotation * observation.point + T_map_sensor_.t;
    bool alone = true;
    graph_.visit_landmarks_near(p, [&](Index l) {
      if ((graph_.landmarks[l].position - p).squaredNorm() < separation2) alone = false;
    });
    if (!alone && !observation.is_followed()) continue;
    observation.landmark = graph_.add_landmark(p, activation_);
    tracks_.give(observation.track, observation.landmark);
  }
}

double Mapper::State::overlap_with_active() const {
  const SubmapRecord& submap = graph_.submaps[graph_.active()];
  std::size_t seen = 0;
  std::size_t shared = 0;
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    ++seen;
    const Index member = graph_.landmarks[observation.landmark].active_member;
    if (member != kNone && submap.members[member].in_first_frame) ++shared;
  }
  return static_cast<double>(shared) / static_cast<double>(seen + submap.first_frame_size - shared);
}

void Mapper::State::change_submap() {
  close_submap();
  // Submaps have moved, and with them what the frame was fitted to.
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  take_submap();
}

void Mapper::State::take_submap() {
  const Index old = best_old_submap();
  if (old == kNone || !reopen(old)) open_new_submap();
}

void Mapper::State::close_submap() {
  const Index closed = graph_.active();
  active_.realign(graph_, options_.sweeps, planar_, matcher_.rules(planar_).min_spread_m2);
  graph_.deactivate();
  std::erase(window_, closed);
  if (window_.size() == static_cast<std::size_t>(options_.window)) window_.erase(window_.begin());
  window_.push_back(closed);
  const StepCost cost = window_solver_.step(graph_, window_, planar_, graph_.poses);
  if (cost.after < cost.before) {
    for (const Index landmark : window_solver_.touched()) graph_.resum(landmark);
  }
  apply_map_step();
  begin_map_step();
  merge_landmarks(closed);
  constellations_.note(graph_, closed);
  ++answer_.counters.closes;
}

void Mapper::State::apply_map_step() {
  if (!map_step_.under_way() || !map_step_ready_) return;
  const StepCost cost = map_step_.apply(graph_, graph_.poses);
  for (Index landmark = 0; landmark < graph_.landmarks.size(); ++landmark) graph_.resum(landmark);
  ++answer_.counters.global_steps;
  const bool worth_it = cost.before - cost.after > kWorthwhileGain * cost.before;
  settle_period_ = worth_it ? options_.global_period : std::min(2 * settle_period_, kMaxSettlePeriod);
}

void Mapper::State::begin_map_step() {
  ++closes_since_settled_;
  // So far apart that its work for one close stays the same in a map of any size. Its work grows with at most the cube.
  const double growth = static_cast<double>(graph_.submaps.size()) / std::max(1.0, settled_submaps_);
  const double work = map_step_.work() * growth * growth * growth;
  const double rest = std::max(static_cast<double>(settle_period_), work / kWorkPerClose);
  if (options_.global_period == 0 || !loop_closed_ || map_step_.under_way() ||
      static_cast<double>(closes_since_settled_) < rest) {
    return;
  }
  map_step_.begin(graph_, graph_.poses, window_.back(), planar_);
  map_step_ready_ = false;
  settled_submaps_ = static_cast<double>(graph_.submaps.size());
  loop_closed_ = false;
  closes_since_settled_ = 0;
}

void Mapper::State::merge_landmarks(Index closed) {
  if (followed_) return;  // who follows two points says that they are two
  const double separation2 = options_.separation() * options_.separation();
  matcher_.mark(graph_, frame_);
  for (const Member& member : graph_.submaps[closed].members) {
    const Index landmark = member.landmark;
    if (member.count == 0) continue;
    Index twin = kNone;
    double nearest2 = separation2;
    graph_.visit_landmarks_near(graph_.landmarks[landmark].position, [&](Index other) {
      const double d2 =
          (graph_.landmarks[other].position - graph_.landmarks[landmark].position).squaredNorm();
      // Seen together, they are two. The order of visits is no reason to choose: ties go to the older one.
      const bool together = matcher_.is_marked(other) && matcher_.is_marked(landmark);
      if (other == landmark || together || graph_.landmarks[other].count == 0) return;
      if (d2 < nearest2 || (d2 == nearest2 && other < twin)) {
        nearest2 = d2;
        twin = other;
      }
    });
    if (twin == kNone) continue;
    const Index into = std::min(landmark, twin);
    const Index from = std::max(landmark, twin);
    graph_.merge(into, from);
    for (Observation& observation : frame_) {
      if (observation.landmark == from) observation.landmark = into;
    }
    matcher_.mark(graph_, frame_);
    ++answer_.counters.merged;
  }
}

Index Mapper::State::best_old_submap() {
  shared_.resize(graph_.submaps.size(), 0);
  shared_submaps_.clear();
  std::uint32_t seen = 0;
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    ++seen;
    for (const Membership& at : graph_.landmarks[observation.landmark].memberships) {
      if (!graph_.submaps[at.submap].members[at.member].in_first_frame) continue;
      if (shared_[at.submap]++ == 0) shared_submaps_.push_back(at.submap);
    }
  }
  Index best = kNone;
  double best_overlap = options_.overlap;
  for (const Index submap : shared_submaps_) {
    const std::uint32_t shared = shared_[submap];
    shared_[submap] = 0;
    const double overlap = static_cast<double>(shared) /
                           static_cast<double>(seen + graph_.submaps[submap].first_frame_size - shared);
    if (overlap > best_overlap || (overlap == best_overlap && submap < best)) {
      best = submap;
      best_overlap = overlap;
    }
  }
  return best;
}

bool Mapper::State::reopen(Index submap) {
  Pose T = graph_.poses[submap].inverse() * T_map_sensor_;
  if (!matcher_.fit_submap(graph_, submap, frame_, planar_, T)) return false;
  ++activation_;
  ++answer_.counters.reopened;
  active_.open(graph_, submap);
  fit_.T_submap_sensor = T;
  last_T_submap_sensor_ = T;
  return true;
}

void Mapper::State::open_new_submap() {
  ++activation_;
  active_.open(graph_, graph_.add_submap(T_map_sensor_));
  first_of_submap_ = true;
  fit_.T_submap_sensor = Pose{};
  last_T_submap_sensor_ = Pose{};
}

void Mapper::State::integrate() {
  ++placed_frames_;
  parts_.count_frame(graph_.part());
  last_seen_ = 0;
  active_.begin_frame(fit_.T_submap_sensor);
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    const LandmarkRecord& landmark = graph_.landmarks[observation.landmark];
    if (landmark.last_activation + static_cast<std::uint64_t>(options_.window) < activation_)
      loop_closed_ = true;
    const Index member = landmark.active_member;
    ++last_seen_;
    if (member == kNone) {
      active_.join(graph_, observation.landmark, observation.point, first_of_submap_, activation_,
                   observation.weight);
    } else {
      active_.observe(graph_, member, observation.point, activation_, observation.weight);
    }
  }
  first_of_submap_ = false;
}

Index Mapper::State::told_part() const {
  return options_.report_parts != 0 ? graph_.part() : parts_.first();
}

const Answer& Mapper::State::answer() {
  answer_.in_part = has_pose_;
  if (has_pose_) answer_.determined = planar_ ? 3 : 6;
  answer_.part = started_ ? parts_.number_of(graph_.part()) : 0;
  answer_.has_pose = has_pose_ && graph_.part() == told_part();
  if (answer_.has_pose) {
    const Pose T = told_from(graph_.poses[parts_.anchor_of(told_part())], T_map_sensor_);
    answer_.T_map_sensor.t = T.t + Vec3::Zero();  // no negative zeros
    answer_.T_map_sensor.q.coeffs() = T.q.coeffs() + Eigen::Vector4d::Zero();
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_) {
    if (observation.landmark != kNone)
      answer_.associations[observation.given] = first_id_ + observation.landmark;
  }
  answer_.counters.landmarks = graph_.landmarks.size() - answer_.counters.merged - graph_.dropped_landmarks();
  answer_.counters.parts = parts_.count();
  answer_.counters.submaps = graph_.submaps.size();
  return answer_;
}

Map Mapper::State::map(const std::vector<Pose>& poses) const {
  Map map;
  if (!started_) return map;
  const Index part = told_part();
  const Pose& anchor = poses[parts_.anchor_of(part)];
  for (Index l = 0; l < graph_.landmarks.size(); ++l) {
    const LandmarkRecord& record = graph_.landmarks[l];
    if (record.merged_into != kNone || record.part == kNone || record.memberships.empty()) continue;
    if (graph_.submaps[record.memberships.front().submap].part != part) continue;
    Landmark landmark;
    landmark.id = first_id_ + l;
    landmark.observations = record.count;
    if (record.count >= static_cast<std::uint32_t>(options_.min_observations))
      landmark.status = LandmarkStatus::mapped;
    Vec3 sum = Vec3::Zero();
    for (const Membership& at : record.memberships) {
      const Member& member = graph_.submaps[at.submap].members[at.member];
      sum += member.weight() * (poses[at.submap] * member.mean);
    }
    landmark.position = told_from(anchor, {{}, sum / record.weight}).t;
    map.landmarks.push_back(landmark);
  }
  for (Index s = 0; s < graph_.submaps.size(); ++s) {
    if (graph_.submaps[s].part != part) continue;
    Submap submap;
    submap.id = s;
    submap.T_map_submap = told_from(anchor, poses[s]);
    for (const Member& member : graph_.submaps[s].members) {
      if (member.count > 0) submap.members.push_back(first_id_ + member.landmark);
    }
    map.submaps.push_back(std::move(submap));
  }
  return map;
}

Mapper::Mapper(const Options& options) : state_(std::make_unique<State>(options)) {}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const Answer& Mapper::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  return state_->process(points, tracks);
}

Map Mapper::map() const {
  return state_->map(state_->graph().poses);
}

Map Mapper::refined_map() const {
  std::vector<Pose> poses = state_->graph().poses;
  settle(state_->graph(), state_->planar(), kMaxGlobalSteps, poses);
  return state_->map(poses);
}

void Mapper::reset() {
  state_ = std::make_unique<State>(Options(state_->options()));
}

const Options& Mapper::options() const {
  return state_->options();
}

void Mapper::time_stages(StageTimes* times) {
  state_->time_stages(times);
}

}  // namespace hallway::slam_point
