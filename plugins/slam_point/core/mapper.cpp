// SPDX-License-Identifier: MIT
#include "slam_point/core/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "slam_point/core/active_submap.hpp"
#include "slam_point/core/alignment.hpp"
#include "slam_point/core/frame_matcher.hpp"
#include "slam_point/core/map_refiner.hpp"
#include "slam_point/core/map_step.hpp"
#include "slam_point/core/motion_filter.hpp"
#include "slam_point/core/pose_information.hpp"
#include "slam_point/core/segment_store.hpp"
#include "slam_point/core/submap_graph.hpp"
#include "slam_point/core/track_book.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr int kMaxDeadReckonedFrames = 25;
constexpr double kSureShare = 0.5;   // of the comparable points, below which a better pose is searched
constexpr int kSurePoints = 6;       // or all there are, likewise
constexpr double kLeastShare = 0.4;  // below which there is no pose
constexpr double kWorthwhileGain =
    1.0;  // fall of the cost, in variances of an observation, for which a step over the whole map is repeated soon
constexpr double kWorkPerClose =
    6e5;  // multiplications for steps over the whole map that a close earns; those that factorise a window of 20
constexpr double kMostClosesSaved = 100.0;
constexpr double kMostSteps = 4.0;     // over the whole map, that can be saved up
constexpr double kWorkPerFrame = 6e5;  // on a step over the whole map: some tenths of a millisecond
constexpr int kMaxSettlePeriod = 1 << 20;

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
        motion_filter_(options),
        settle_period_(options.global_period),
        ranges_count_(options.noise_per_m > 0.0 || options.noise_per_m2 > 0.0) {}

  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);
  Map map() const { return map(graph_.poses); }
  Map refined_map() const;
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
  void search_turn();
  bool is_placed() const;
  std::size_t comparable_points() const;
  void lose_pose();
  bool start_over();
  void learn_motion();
  void add_landmarks();
  bool looks_for_motion() const { return options_.find_moving != 0 && !followed_; }
  void set_moving_apart();
  double overlap_with_active() const;
  void change_submap();
  void close_submap();
  void begin_window_step();
  void plan_map_step();
  void begin_map_step();
  void apply_steps();
  void judge_map_step(const StepCost& cost);
  void advance_steps();
  void merge_landmarks(Index closed);
  Index best_old_submap();
  bool reopen(Index submap);
  void open_new_submap();
  void integrate();
  bool is_mapped(const LandmarkRecord& landmark) const;
  std::optional<Mat6> pose_covariance() const;
  const Answer& answer();
  Map map(const std::vector<Pose>& poses) const;
  void add_moving(const std::vector<Pose>& poses, Map& map) const;

  Options options_;
  FrameMatcher matcher_;
  SubmapGraph graph_;
  ActiveSubmap active_;
  MotionFilter motion_filter_;
  SegmentStore segments_;
  std::vector<SegmentStore::Sighting> sightings_;
  TrackBook tracks_;
  MapStep window_step_;  // over the last submaps
  MapStep map_step_;     // over all
  bool window_step_ready_ = false;
  bool map_step_ready_ = false;
  bool window_step_due_ = false;  // to be begun at the next frame
  bool map_step_due_ = false;     // to be begun when none over the window is under way

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
  bool followed_ = false;  // this frame came with the sensor's tracks, and they count
  bool started_ = false;
  bool planar_ = true;
  bool has_pose_ = false;
  bool first_of_submap_ = false;
  int frames_without_pose_ = 0;
  std::uint64_t placed_frames_ = 0;
  std::uint64_t activation_ = 0;
  std::vector<Index> window_;  // the last submaps closed, newest last
  std::vector<Index> free_;    // what the step over the window places
  std::vector<Pose> search_bases_;
  std::vector<std::uint32_t> shared_;  // submap -> landmarks in view of its first frame
  std::vector<Index> shared_submaps_;
  bool on_old_ground_ = false;      // what was mapped before the window has been seen since the last close
  bool was_on_old_ground_ = false;  // the same of the close before
  bool loop_closed_ = false;        // since the last step over the whole map was begun
  double earned_work_ = 0.0;        // multiplications that steps over the whole map may take
  int closes_since_settled_ = 0;
  int closes_since_loop_ = 0;     // since old ground was met after new
  double settled_submaps_ = 0.0;  // how many the last step over the whole map places
  int settle_period_;             // closes between steps over the whole map, as they have proved worth it
  LandmarkId first_id_ = 0;       // id of landmark 0
  bool ranges_count_;             // noise grows with the range
  Answer answer_;
  StageClock clock_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  clock_.begin();
  apply_steps();
  clock_.end(Stage::solving);
  place(points, tracks);
  advance_steps();
  clock_.end(Stage::solving);
  return answer();
}

void Mapper::State::place(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  take_points(points, tracks);
  if (!started_) {
    has_pose_ = can_start();
    if (has_pose_) start_map();
    return;
  }
  predict();
  match_active_submap();
  match_map();
  clock_.end(Stage::matching);
  if (!fit_pose()) search_turn();
  has_pose_ = is_placed();
  clock_.end(Stage::fitting);
  if (!has_pose_) {
    lose_pose();
    has_pose_ = start_over();
    return;
  }
  matcher_.drop_strays(graph_, T_map_sensor_, local_since(), frame_);
  learn_motion();
  if (looks_for_motion()) motion_filter_.follow(graph_, T_map_sensor_, frame_);
  add_landmarks();
  set_moving_apart();
  const bool is_over = overlap_with_active() < options_.overlap ||
                       active_.frames() >= static_cast<std::size_t>(options_.max_submap_frames);
  clock_.end(Stage::averaging);
  if (is_over) {
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
  }
}

bool Mapper::State::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_)
    own.add(observation.point, observation.point, observation.weight);
  const FitRules rules = matcher_.rules(planar_);
  Pose unused;
  return own.pairs() >= (planar_ ? 2 : 3) && own.solve(planar_, rules.min_spread_m2, unused);
}

void Mapper::State::start_map() {
  started_ = true;
  frames_without_pose_ = 0;
  T_map_sensor_ = Pose{};
  add_landmarks();
  set_moving_apart();
  open_new_submap();
  integrate();
}

void Mapper::State::predict() {
  predicted_ = last_T_submap_sensor_;
  const int frames = std::min(frames_without_pose_, kMaxDeadReckonedFrames) + 1;
  for (int f = 0; f < frames; ++f) predicted_ = predicted_ * Pose{rotation_exp(motion_.turn), motion_.travel};
}

void Mapper::State::match_active_submap() {
  fit_ = matcher_.match_active(graph_, active_, predicted_, planar_, frame_);
  if (fit_.solved || !followed_) return;
  Pose located;
  if (matcher_.locate_by_tracks(graph_, planar_, frame_, located))
    fit_.T_submap_sensor = graph_.poses[graph_.active()].inverse() * located;
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
  if (matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_)) {
    agreeing_ = matcher_.count_agreeing(graph_, frame_, T_map_sensor_);
  }
  if (!fit_.solved) fit_.T_submap_sensor = graph_.poses[graph_.active()].inverse() * T_map_sensor_;
  searched_ = false;
  // A few points can agree by chance, so of few nearly all must.
  const auto comparable = static_cast<int>(comparable_points());
  return agreeing_ >= std::min(comparable, kSurePoints) && agreeing_ >= kSureShare * comparable;
}

void Mapper::State::search_turn() {
  if (options_.max_turn_rad <= 0.0 || followed_) return;  // tracks need no prediction
  ++answer_.counters.searches;
  const Pose& T_map_submap = graph_.poses[graph_.active()];
  search_bases_.assign({T_map_submap * predicted_, T_map_submap * last_T_submap_sensor_});
  const double reach = std::min(options_.max_turn_rad * (1.0 + frames_without_pose_), std::numbers::pi);
  Pose found;
  if (matcher_.search_turn(graph_, search_bases_, reach, planar_, frame_, found) <= agreeing_) return;
  predicted_ = T_map_submap.inverse() * found;
  match_active_submap();
  match_map();
  fit_pose();
  searched_ = true;
}

bool Mapper::State::is_placed() const {
  return agreeing_ >= (planar_ ? 2 : 3) &&
         static_cast<double>(agreeing_) >= kLeastShare * static_cast<double>(comparable_points());
}

std::size_t Mapper::State::comparable_points() const {
  // A view that opens shows much that is new, one that closes little of what was seen: the smaller of both must agree.
  return std::min(frame_.size(), last_seen_);
}

void Mapper::State::lose_pose() {
  for (Observation& observation : frame_) observation.landmark = kNone;
  ++frames_without_pose_;
}

bool Mapper::State::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep.
  if (placed_frames_ > 1) return false;
  if (!can_start()) return false;
  first_id_ += graph_.landmarks.size();
  placed_frames_ = 0;
  graph_.clear();
  active_.clear();
  motion_filter_.clear();
  segments_.clear();
  window_step_ = MapStep();
  window_step_ready_ = false;
  tracks_.clear();
  for (Observation& observation : frame_) observation.expected = kNone;
  map_step_ = MapStep();
  map_step_ready_ = false;
  map_step_due_ = false;
  start_map();
  return true;
}

void Mapper::State::learn_motion() {
  const Pose moved = last_T_submap_sensor_.inverse() * fit_.T_submap_sensor;
  const double frames = static_cast<double>(frames_without_pose_ + 1);
  const Vec3 turn = rotation_log(moved.q) / frames;
  const Vec3 travel = moved.t / frames;
  // After a sudden motion the old average says nothing.
  const double share = has_motion_ && !searched_ ? options_.smoothing : 1.0;
  motion_.turn += share * (turn - motion_.turn);
  motion_.travel += share * (travel - motion_.travel);
  has_motion_ = true;
  frames_without_pose_ = 0;
  last_T_submap_sensor_ = fit_.T_submap_sensor;
}

void Mapper::State::add_landmarks() {
  const Mat3 rotation = T_map_sensor_.q.toRotationMatrix();
  const double separation2 = options_.separation() * options_.separation();
  for (Observation& observation : frame_) {
    if (observation.is_followed() && !tracks_.allows_new(observation)) continue;
    if (observation.landmark != kNone || observation.withheld || observation.moving != kNone) continue;
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

void Mapper::State::set_moving_apart() {
  if (!looks_for_motion()) return;
  if (!motion_filter_.judge(graph_, active_, T_map_sensor_, planar_, frame_)) return;
  ++answer_.counters.found_moving;
  // What moved has pulled at the frame.
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
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
  // Where closes follow each other faster than a step is computed, the next one takes in what this one leaves out.
  window_step_due_ = !window_step_.under_way();
  plan_map_step();
  merge_landmarks(closed);
  ++answer_.counters.closes;
}

/// Of the submaps closed last and the one that is active.
void Mapper::State::begin_window_step() {
  free_ = window_;
  if (std::find(free_.begin(), free_.end(), graph_.active()) == free_.end()) free_.push_back(graph_.active());
  window_step_.begin(graph_, graph_.poses, free_, graph_.active(), planar_);
  window_step_ready_ = false;
  window_step_due_ = false;
}

/// Between frames: what is ready moves submaps, and with them what is active.
void Mapper::State::apply_steps() {
  if (window_step_.under_way() && window_step_ready_) {
    const StepCost cost = window_step_.apply(graph_, graph_.poses);
    if (cost.after < cost.before) graph_.take_moved(window_step_.touched());
  } else if (map_step_.under_way() && map_step_ready_) {
    const StepCost cost = map_step_.apply(graph_, graph_.poses);
    if (cost.after < cost.before) graph_.take_moved(map_step_.touched());
    judge_map_step(cost);
  }
  // Not both at once: what the one over the window moves, the other would move a second time.
  if (window_step_due_) {
    begin_window_step();
  } else if (map_step_due_ && !window_step_.under_way()) {
    begin_map_step();
  }
}

/// Each frame gives one of the steps a bounded amount of work.
void Mapper::State::advance_steps() {
  const bool window = window_step_.under_way() && !window_step_ready_;
  const bool map = map_step_.under_way() && !map_step_ready_;
  if (window && (!map || answer_.counters.iterations % 2 == 0)) {
    window_step_ready_ = window_step_.advance(kWorkPerFrame);
  } else if (map) {
    map_step_ready_ = map_step_.advance(kWorkPerFrame);
  }
}

void Mapper::State::judge_map_step(const StepCost& cost) {
  ++answer_.counters.global_steps;
  earned_work_ -= map_step_.work();
  const bool worth_it = cost.before - cost.after > kWorthwhileGain * segments_.noise2_m2();
  // While a loop is being closed each close tells more, so one step of little use does not mean that the next is.
  const bool looping = closes_since_loop_ < 2 * options_.window;
  settle_period_ =
      worth_it || looping ? options_.global_period : std::min(2 * settle_period_, kMaxSettlePeriod);
}

/// Decides at a close whether a step over the whole map is to follow.
void Mapper::State::plan_map_step() {
  ++closes_since_settled_;
  // The share of a close stays the same in a map of any size. The work of a step grows with at most the cube.
  const double growth = static_cast<double>(graph_.submaps.size()) / std::max(1.0, settled_submaps_);
  const double work = map_step_.work() * growth * growth * growth;
  earned_work_ =
      std::min(earned_work_ + kWorkPerClose, std::max(kMostSteps * work, kMostClosesSaved * kWorkPerClose));
  // Old ground after new: what the loop tells is not in the map yet.
  ++closes_since_loop_;
  if (on_old_ground_ && !was_on_old_ground_) {
    settle_period_ = options_.global_period;
    closes_since_loop_ = 0;
  }
  was_on_old_ground_ = on_old_ground_;
  loop_closed_ = loop_closed_ || on_old_ground_;
  on_old_ground_ = false;
  map_step_due_ = options_.global_period != 0 && loop_closed_ && !map_step_.under_way() &&
                  closes_since_settled_ >= settle_period_ && earned_work_ >= work;
}

void Mapper::State::begin_map_step() {
  map_step_.begin(graph_, graph_.poses, graph_.active(), planar_);
  map_step_ready_ = false;
  map_step_due_ = false;
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
      if (d2 < nearest2 && motion_filter_.are_two(landmark, other)) return;
      if (d2 < nearest2 || (d2 == nearest2 && other < twin)) {
        nearest2 = d2;
        twin = other;
      }
    });
    if (twin == kNone) continue;
    const Index into = std::min(landmark, twin);
    const Index from = std::max(landmark, twin);
    graph_.merge(into, from);
    motion_filter_.merged(from, into);
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
  last_seen_ = 0;
  active_.begin_frame(fit_.T_submap_sensor);
  sightings_.clear();
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    sightings_.push_back({observation.landmark, observation.point, observation.weight});
    const LandmarkRecord& landmark = graph_.landmarks[observation.landmark];
    if (landmark.last_activation + static_cast<std::uint64_t>(options_.window) < activation_)
      on_old_ground_ = true;
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
  segments_.add_frame(graph_.active(), fit_.T_submap_sensor, planar_, matcher_.rules(planar_).min_spread_m2,
                      sightings_);
}

bool Mapper::State::is_mapped(const LandmarkRecord& landmark) const {
  return landmark.count >= static_cast<std::uint32_t>(options_.min_observations);
}

std::optional<Mat6> Mapper::State::pose_covariance() const {
  const double noise2 = segments_.noise2_m2();
  if (!has_pose_ || noise2 == 0.0) return std::nullopt;
  const Mat3 rotation = T_map_sensor_.q.toRotationMatrix();
  PoseInformation information;
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    // This frame's own observation is in the landmark already.
    const double others = graph_.landmarks[observation.landmark].weight - observation.weight;
    if (others > 0.0) information.add(rotation * observation.point, pair_weight(others, observation.weight));
  }
  std::optional<Mat6> covariance = information.covariance(planar_);
  if (covariance) *covariance *= noise2;
  return covariance;
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = has_pose_;
  answer_.covariance = pose_covariance();
  if (has_pose_) {
    answer_.T_map_sensor.t = T_map_sensor_.t + Vec3::Zero();  // no negative zeros
    answer_.T_map_sensor.q.coeffs() = T_map_sensor_.q.coeffs() + Eigen::Vector4d::Zero();
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_) {
    const Index landmark = observation.landmark != kNone ? observation.landmark : observation.moving;
    if (landmark != kNone) answer_.associations[observation.given] = first_id_ + landmark;
  }
  answer_.counters.landmarks = graph_.landmarks.size() - answer_.counters.merged;
  answer_.counters.submaps = graph_.submaps.size();
  return answer_;
}

void Mapper::State::add_moving(const std::vector<Pose>& poses, Map& map) const {
  for (const MotionTracks::Track& track : motion_filter_.tracks()) {
    Landmark landmark;
    landmark.id = first_id_ + track.landmark;
    landmark.position = poses[track.submap] * track.place;
    landmark.observations = track.sightings;
    landmark.status = LandmarkStatus::dynamic;
    map.landmarks.push_back(landmark);
  }
  std::sort(map.landmarks.begin(), map.landmarks.end(),
            [](const Landmark& a, const Landmark& b) { return a.id < b.id; });
}

/// @param poses  T_map_submap, by which landmarks that move are placed
Map Mapper::State::map(const std::vector<Pose>& poses) const {
  Map map;
  for (Index l = 0; l < graph_.landmarks.size(); ++l) {
    const LandmarkRecord& record = graph_.landmarks[l];
    if (record.merged_into != kNone || record.moving) continue;
    Landmark landmark;
    landmark.id = first_id_ + l;
    landmark.observations = record.count;
    if (is_mapped(record)) landmark.status = LandmarkStatus::mapped;
    landmark.position = graph_.mean_position(l);
    map.landmarks.push_back(landmark);
  }
  add_moving(poses, map);
  for (Index s = 0; s < graph_.submaps.size(); ++s) {
    Submap submap;
    submap.id = s;
    submap.T_map_submap = graph_.poses[s];
    for (const Member& member : graph_.submaps[s].members) {
      if (member.count > 0) submap.members.push_back(first_id_ + member.landmark);
    }
    map.submaps.push_back(std::move(submap));
  }
  return map;
}

Map Mapper::State::refined_map() const {
  std::vector<bool> mapped;
  for (const LandmarkRecord& record : graph_.landmarks) mapped.push_back(is_mapped(record));
  const RefinedMap refined = refine_map(graph_, segments_, mapped, planar_);
  Map map = this->map(refined.poses);
  for (Landmark& landmark : map.landmarks) {
    if (landmark.status == LandmarkStatus::dynamic) continue;
    const std::size_t index = landmark.id - first_id_;
    landmark.position = refined.positions[index];
    landmark.covariance = refined.covariances[index];
  }
  for (Submap& submap : map.submaps) submap.T_map_submap = refined.poses[submap.id];
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

void Mapper::time_stages(StageTimes* times) {
  state_->time_stages(times);
}

}  // namespace hallway::slam_point
