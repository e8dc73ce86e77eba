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
#include "slam_point/core/landmark_merging.hpp"
#include "slam_point/core/map_parts.hpp"
#include "slam_point/core/map_report.hpp"
#include "slam_point/core/motion_filter.hpp"
#include "slam_point/core/motion_prediction.hpp"
#include "slam_point/core/pose_information.hpp"
#include "slam_point/core/relocaliser.hpp"
#include "slam_point/core/segment_store.hpp"
#include "slam_point/core/step_schedule.hpp"
#include "slam_point/core/submap_graph.hpp"
#include "slam_point/core/submap_overlap.hpp"
#include "slam_point/core/track_book.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
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
constexpr int kIndexedPerFrame = 8;          // landmarks whose constellations are noted
constexpr std::size_t kMovedPerFrame = 100;  // landmarks of a part that moves into another one
constexpr std::uint64_t kYoungFrames = 10;   // a part with fewer is given up when the sensor gets lost in it
constexpr std::uint64_t kMeetPeriod = 10;    // frames between looks for other parts, in one that is not young
constexpr std::size_t kLeastPartPoints = 5;  // that begin another part
constexpr int kIndexedAtOnce = 64;           // landmarks of the active submap, when a frame is looked for
constexpr int kFalsePartsAtOnce = 8;
constexpr int kMostDoublings = 6;
constexpr std::uint32_t kLeastInView = 3;  // observations of a landmark that is looked for in other parts
constexpr double kIndexNoises = 4.0;
constexpr double kMeetingNoises = 12.0;

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
               static_cast<IndexKind>(options.index), options.is_directional() ? matcher_.agreement() : 0.0),
        active_(std::max(options.match_bound(), matcher_.agreement()), static_cast<IndexKind>(options.index)),
        motion_filter_(options),
        segments_(options.is_directional()),
        parts_(matcher_.agreement()),
        constellations_(kIndexNoises * options.noise_m, static_cast<std::uint32_t>(options.min_observations)),
        relocaliser_(options, matcher_.rules(true), matcher_.rules(false), options.map_bound()),
        meeting_(kMeetingNoises * options.noise_m),
        schedule_(options),
        prediction_(options.smoothing, options.match_bound()),
        ranges_count_(options.noise_per_m > 0.0 || options.noise_per_m2 > 0.0 || options.is_directional()) {}

  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);
  Map map() const;
  Map refined_map() const;
  const Options& options() const { return options_; }
  void time_stages(StageTimes* times) { clock_.add_to(times); }

 private:
  void place(std::span<const Vec3> points, std::span<const TrackId> tracks);
  void take_points(std::span<const Vec3> points, std::span<const TrackId> tracks);
  void take_tracks(std::span<const TrackId> tracks);
  void weigh(Observation& observation) const;
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
  bool is_expected() const;
  bool contradicts() const;
  std::ptrdiff_t matched_points() const;
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
  void note_joined();
  void gather_view();
  void learn_motion();
  void add_landmarks();
  bool looks_for_motion() const { return options_.find_moving != 0 && !followed_; }
  void set_moving_apart();
  void change_submap();
  void take_submap();
  void close_submap();
  bool reopen(Index submap);
  void open_new_submap();
  void integrate();
  Index told_part() const;
  std::optional<Mat6> pose_covariance() const;
  const Answer& answer();
  MapSource map_source() const;

  Options options_;
  FrameMatcher matcher_;
  SubmapGraph graph_;
  ActiveSubmap active_;
  MotionFilter motion_filter_;
  SegmentStore segments_;
  std::vector<SegmentStore::Sighting> sightings_;
  TrackBook tracks_;
  MapParts parts_;
  ConstellationIndex constellations_;
  Relocaliser relocaliser_;
  PartMeeting meeting_;
  SubmapOverlap overlap_;
  StepSchedule schedule_;
  MotionPrediction prediction_;
  Placement found_;             // of this frame, by what it sees alone, where tracking cannot go on to
  std::vector<Vec3> view_;      // what is looked for in other parts, sensor frame
  std::vector<double> noises_;  // of a frame in view_: standard deviation of a coordinate [m]
  int false_parts_ = 0;         // parts begun that no second frame was placed in, since one was

  std::vector<Observation> frame_;
  FrameMatcher::Fit fit_;
  Pose predicted_;             // T_submap_sensor
  Pose last_T_submap_sensor_;  // of the last frame with a pose
  Pose T_map_sensor_;
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
  bool contradicted_ = false;  // the prediction, by one of them
  std::uint64_t placed_frames_ = 0;
  std::uint64_t activation_ = 0;
  std::vector<Pose> search_bases_;
  LandmarkId first_id_ = 0;  // id of landmark 0
  bool ranges_count_;        // noise differs by range or direction
  Answer answer_;
  StageClock clock_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  clock_.begin();
  constellations_.advance(graph_, kIndexedPerFrame);
  parts_.advance(graph_, kMovedPerFrame);
  note_joined();
  if (schedule_.apply(graph_, planar_, segments_.noise2_m2())) ++answer_.counters.global_steps;
  clock_.end(Stage::solving);
  place(points, tracks);
  schedule_.advance(answer_.counters.iterations);
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
  clock_.end(Stage::averaging);
  if (looks_for_motion()) motion_filter_.follow(graph_, T_map_sensor_, frame_);
  clock_.end(Stage::moving);
  add_landmarks();
  clock_.end(Stage::averaging);
  set_moving_apart();
  clock_.end(Stage::moving);
  const bool is_over = SubmapOverlap::with_active(graph_, frame_) < options_.overlap ||
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
    if (ranges_count_) weigh(frame_.back());
  }
  take_tracks(tracks);
  answer_.associations.assign(points.size(), kNoLandmark);
  answer_.determined = 0;
  ++answer_.counters.iterations;
}

void Mapper::State::weigh(Observation& observation) const {
  const double range = observation.point.norm();
  const double along = options_.noise_m / options_.noise_at(range);
  const double across = options_.noise_m / options_.noise_across_at(range);
  observation.weight = along * along;
  observation.across = across * across;
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
  set_moving_apart();
  open_new_submap();
  parts_.anchor(graph_, graph_.active());
  integrate();
}

void Mapper::State::predict() {
  const int frames = std::min(frames_without_pose_, options_.bridge_frames) + 1;
  predicted_ = prediction_.after(last_T_submap_sensor_, frames);
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
  const bool strayed = !is_expected();
  if (strayed) least = kLeastAfterLoss;
  if (strayed && frames_without_pose_ > kShortGap) least = kLeastAfterGap;
  if (strayed && agreeing_ >= least) {
    gather_frame();
    if (relocaliser_.chance_at(graph_, view_, noises_, T_map_sensor_, planar_, kTriedAfterGap) >
        kMostAfterGap)
      return false;
  }
  return agreeing_ >= least &&
         static_cast<double>(agreeing_) >= kLeastShare * static_cast<double>(comparable_points());
}

/// Whether the sensor is where the prediction has it as surely as after a frame with a pose.
bool Mapper::State::is_expected() const {
  return frames_without_pose_ == 0 || (!contradicted_ && !searched_ && frames_without_pose_ <= kShortGap);
}

/// Whether this frame, which has no pose, tells that the prediction is wrong. One that shows what was expected
/// and does not determine a pose, as points of much noise do not, speaks for the prediction.
bool Mapper::State::contradicts() const {
  const auto matched = static_cast<int>(matched_points());
  return fits_ || matched < kSurePoints || matched < kSureShare * static_cast<double>(comparable_points());
}

std::ptrdiff_t Mapper::State::matched_points() const {
  return std::count_if(frame_.begin(), frame_.end(),
                       [](const Observation& observation) { return observation.landmark != kNone; });
}

std::size_t Mapper::State::comparable_points() const {
  // A view that opens shows much that is new, one that closes little of what was seen: the smaller of both must agree.
  return std::min(frame_.size(), last_seen_);
}

/// Degrees of freedom that points near where they were expected determine, when these are too few or on a line.
int Mapper::State::determined_by_few() const {
  // What fits and yet does not agree tells nothing, nor does what was expected long ago.
  if (fits_ || frames_without_pose_ >= options_.bridge_frames) return 0;
  const std::ptrdiff_t matched = matched_points();
  if (matched == 0) return 0;
  if (planar_) return 2;
  return matched == 1 ? 3 : 5;
}

void Mapper::State::lose_pose() {
  answer_.determined = determined_by_few();
  contradicted_ = contradicts() || (frames_without_pose_ > 0 && contradicted_);
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
  noises_.clear();
  for (const Observation& observation : frame_) {
    view_.push_back(observation.point);
    noises_.push_back(options_.noise_m / std::sqrt(observation.weight));
  }
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
  schedule_.leave_part();
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

/// Tells what became the same landmark in a join.
void Mapper::State::note_joined() {
  for (const MapParts::Merge& merge : parts_.merges()) motion_filter_.merged(merge.from, merge.into);
  answer_.counters.merged += parts_.merges().size();
  parts_.forget_merges();
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
  for (Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    if (graph_.landmarks[observation.landmark].part != graph_.part())
      observation.landmark = parts_.move(graph_, observation.landmark);
  }
  note_joined();
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  schedule_.parts_joined();
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
  motion_filter_.clear();
  segments_.clear();
  schedule_ = StepSchedule(options_);
  meeting_ = PartMeeting(kMeetingNoises * options_.noise_m);
  tracks_.clear();
  for (Observation& observation : frame_) observation.expected = kNone;
  start_map();
  return true;
}

void Mapper::State::learn_motion() {
  const Pose moved = last_T_submap_sensor_.inverse() * fit_.T_submap_sensor;
  prediction_.learn(moved, frames_without_pose_ + 1, searched_);
  frames_without_pose_ = 0;
  last_T_submap_sensor_ = fit_.T_submap_sensor;
}

void Mapper::State::add_landmarks() {
  const PointMotion to_map(T_map_sensor_);
  const double separation2 = options_.separation() * options_.separation();
  for (Observation& observation : frame_) {
    if (observation.is_followed() && !tracks_.allows_new(observation)) continue;
    if (observation.landmark != kNone || observation.withheld || observation.moving != kNone) continue;
    const Vec3 p = to_map * observation.point;
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

void Mapper::State::change_submap() {
  close_submap();
  // Submaps have moved, and with them what the frame was fitted to.
  matcher_.fit_map(graph_, frame_, planar_, T_map_sensor_);
  take_submap();
}

void Mapper::State::take_submap() {
  const Index old = overlap_.best(graph_, frame_, options_.overlap);
  if (old == kNone || !reopen(old)) open_new_submap();
}

void Mapper::State::close_submap() {
  const Index closed = graph_.active();
  active_.realign(graph_, options_.sweeps, planar_, matcher_.rules(planar_).min_spread_m2);
  graph_.deactivate();
  schedule_.submap_closed(graph_, closed);
  // Who follows two points says that they are two.
  if (!followed_) {
    answer_.counters.merged +=
        merge_landmarks(graph_, closed, options_.separation(), matcher_, motion_filter_, frame_);
  }
  constellations_.note(graph_, closed);
  ++answer_.counters.closes;
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
  sightings_.clear();
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    sightings_.push_back({observation.landmark, observation.point, observation.weight, observation.across});
    const LandmarkRecord& landmark = graph_.landmarks[observation.landmark];
    if (landmark.last_activation + static_cast<std::uint64_t>(options_.window) < activation_)
      schedule_.saw_old_ground();
    const Index member = landmark.active_member;
    ++last_seen_;
    if (member == kNone) {
      active_.join(graph_, observation.landmark, observation.point, first_of_submap_, activation_,
                   observation.weights());
    } else {
      active_.observe(graph_, member, observation.point, activation_, observation.weights());
    }
  }
  first_of_submap_ = false;
  segments_.add_frame(graph_.active(), fit_.T_submap_sensor, planar_, matcher_.rules(planar_).min_spread_m2,
                      sightings_);
}

std::optional<Mat6> Mapper::State::pose_covariance() const {
  const double noise2 = segments_.noise2_m2();
  if (!has_pose_ || noise2 == 0.0) return std::nullopt;
  const PointMotion to_map(T_map_sensor_);
  PoseInformation information;
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    // This frame's own observation is in the landmark already.
    if (options_.is_directional()) {
      const Vec3 lever = to_map.turned(observation.point);
      const Mat3 own = ray_information(lever, observation.weights());
      information.add(lever, pair_information(graph_.informations[observation.landmark].whole - own, own));
      continue;
    }
    const double others = graph_.landmarks[observation.landmark].weight - observation.weight;
    if (others > 0.0)
      information.add(to_map.turned(observation.point), pair_weight(others, observation.weight));
  }
  std::optional<Mat6> covariance = information.covariance(planar_);
  if (covariance) *covariance *= noise2;
  return covariance;
}

Index Mapper::State::told_part() const {
  return options_.report_parts != 0 ? graph_.part() : parts_.first();
}

const Answer& Mapper::State::answer() {
  answer_.in_part = has_pose_;
  if (has_pose_) answer_.determined = planar_ ? 3 : 6;
  answer_.part = started_ ? parts_.number_of(graph_.part()) : 0;
  answer_.has_pose = has_pose_ && graph_.part() == told_part();
  answer_.covariance.reset();
  if (answer_.has_pose) {
    const Pose& anchor = graph_.poses[parts_.anchor_of(told_part())];
    answer_.covariance = pose_covariance();
    if (answer_.covariance) {
      Mat6 turn = Mat6::Zero();
      turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = anchor.q.toRotationMatrix().transpose();
      *answer_.covariance = turn * *answer_.covariance * turn.transpose();
    }
    const Pose T = told_from(anchor, T_map_sensor_);
    answer_.T_map_sensor.t = T.t + Vec3::Zero();  // no negative zeros
    answer_.T_map_sensor.q.coeffs() = T.q.coeffs() + Eigen::Vector4d::Zero();
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_) {
    const Index landmark = observation.landmark != kNone ? observation.landmark : observation.moving;
    if (landmark != kNone) answer_.associations[observation.given] = first_id_ + landmark;
  }
  answer_.counters.landmarks = graph_.landmarks.size() - answer_.counters.merged - graph_.dropped_landmarks();
  answer_.counters.parts = parts_.count();
  answer_.counters.submaps = graph_.submaps.size();
  return answer_;
}

MapSource Mapper::State::map_source() const {
  return {graph_,      parts_,    motion_filter_.tracks(),
          told_part(), first_id_, static_cast<std::uint32_t>(options_.min_observations),
          planar_};
}

Map Mapper::State::map() const {
  return started_ ? report_map(map_source()) : Map{};
}

Map Mapper::State::refined_map() const {
  return started_ ? report_refined_map(map_source(), segments_) : Map{};
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
