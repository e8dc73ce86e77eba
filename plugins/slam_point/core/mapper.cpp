// SPDX-License-Identifier: MIT
#include "slam_point/core/mapper.hpp"

#include <algorithm>
#include <vector>

#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/frame/frame_intake.hpp"
#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/frame/frame_placer.hpp"
#include "slam_point/core/frame/pose_report.hpp"
#include "slam_point/core/frame/track_book.hpp"
#include "slam_point/core/map_report.hpp"
#include "slam_point/core/moving/motion_filter.hpp"
#include "slam_point/core/places/map_parts.hpp"
#include "slam_point/core/places/part_watch.hpp"
#include "slam_point/core/places/place_recogniser.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/submaps/submap_sequence.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kLeastToStart = 3;             // points that start a map
constexpr std::size_t kMovedPerFrame = 100;  // landmarks of a part that moves into another one

const Options& checked(const Options& options) {
  options.validate();
  return options;
}

}  // namespace

/// The map and those that work on it. What it does itself is to let them work in turn: place() is one iteration.
class Mapper::State {
 public:
  explicit State(const Options& options)
      : options_(checked(options)),
        matcher_(options),
        graph_(std::max(
                   {options.match_bound(), options.map_bound(), options.separation(), matcher_.agreement()}),
               static_cast<IndexKind>(options.index), options.is_directional() ? matcher_.agreement() : 0.0),
        intake_(options),
        parts_(matcher_.agreement()),
        part_watch_(options.bridge_frames, options.noise_m),
        motion_filter_(options),
        places_(options, matcher_),
        submaps_(options, graph_, matcher_),
        placer_(options, graph_, submaps_, matcher_, places_) {}

  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);
  Map map() const;
  Map refined_map() const;
  const Options& options() const { return options_; }
  void time_stages(StageTimes* times) { clock_.add_to(times); }

 private:
  void take_points(std::span<const Vec3> points, std::span<const TrackId> tracks);
  bool place();
  void search();
  void add_landmarks();
  void set_moving_apart();
  void integrate();
  bool can_start() const;
  void start_map();
  bool recover();
  void enter(const Placement& found);
  bool start_over();
  bool start_part();
  void leave_part(Index part);
  bool join_met_part();
  void note_joined();
  void change_submap();
  void take_submap();
  void open_new_submap();
  void close_submap();
  bool looks_for_motion() const { return options_.find_moving != 0 && !intake_.is_followed(); }
  bool is_planar() const { return intake_.is_planar(); }
  Index told_part() const;
  const Answer& answer();
  void answer_pose();
  MapSource map_source() const;

  Options options_;
  FrameMatcher matcher_;
  SubmapGraph graph_;  // the map
  FrameIntake intake_;
  TrackBook tracks_;
  MapParts parts_;
  PartWatch part_watch_;
  MotionFilter motion_filter_;
  PlaceRecogniser places_;
  SubmapSequence submaps_;
  FramePlacer placer_;

  std::vector<Observation> frame_;
  bool started_ = false;
  bool has_pose_ = false;
  std::uint64_t placed_frames_ = 0;
  LandmarkId first_id_ = 0;        // id of landmark 0
  std::uint64_t first_epoch_ = 0;  // Answer::epoch of the map's first part
  Answer answer_;
  StageClock clock_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  clock_.begin();
  places_.advance(graph_);
  parts_.advance(graph_, kMovedPerFrame);
  note_joined();
  StepSchedule& schedule = submaps_.schedule();
  if (schedule.apply(graph_, is_planar(), submaps_.segments().noise2_m2())) ++answer_.counters.global_steps;
  clock_.end(Stage::solving);
  take_points(points, tracks);
  has_pose_ = place();
  schedule.advance(answer_.counters.iterations);
  clock_.end(Stage::solving);
  return answer();
}

/// Finds where the frame is, and takes it into the map. Whether it has a pose.
bool Mapper::State::place() {
  if (!started_) {
    if (!can_start()) return false;
    parts_.begin(graph_);
    start_map();
    return true;
  }
  placer_.match(frame_);
  clock_.end(Stage::matching);
  if (!placer_.fit(frame_)) search();
  const bool is_placed = placer_.is_placed(frame_);
  clock_.end(Stage::fitting);
  if (!is_placed) return recover();
  placer_.accept(frame_);
  clock_.end(Stage::averaging);
  if (looks_for_motion()) motion_filter_.follow(graph_, placer_.T_map_sensor(), frame_);
  clock_.end(Stage::moving);
  add_landmarks();
  clock_.end(Stage::averaging);
  set_moving_apart();
  clock_.end(Stage::moving);
  const bool is_over = submaps_.is_over(frame_);
  clock_.end(Stage::averaging);
  if (join_met_part()) {
    take_submap();
    clock_.end(Stage::closing);
  } else if (is_over) {
    change_submap();
    clock_.end(Stage::closing);
  }
  integrate();
  clock_.end(Stage::averaging);
  return true;
}

void Mapper::State::take_points(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  intake_.take(points, tracks, tracks_, graph_, frame_);
  placer_.begin(intake_.is_planar(), intake_.is_followed());
  answer_.associations.assign(points.size(), kNoLandmark);
  answer_.determined = 0;
  ++answer_.counters.iterations;
}

void Mapper::State::search() {
  if (intake_.is_followed()) return;  // tracks need no prediction
  ++answer_.counters.searches;
  // What is being joined lies in two frames.
  const bool by_place = !parts_.is_joining();
  if (placer_.search(by_place, frame_)) ++answer_.counters.relocalised;
}

void Mapper::State::add_landmarks() {
  const PointMotion to_map(placer_.T_map_sensor());
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
    observation.landmark = graph_.add_landmark(p, submaps_.activation());
    tracks_.give(observation.track, observation.landmark);
  }
}

void Mapper::State::set_moving_apart() {
  if (!looks_for_motion()) return;
  if (!motion_filter_.judge(graph_, submaps_.active(), placer_.T_map_sensor(), is_planar(), frame_)) return;
  ++answer_.counters.found_moving;
  // What moved has pulled at the frame.
  placer_.refit(frame_);
}

void Mapper::State::integrate() {
  ++placed_frames_;
  parts_.count_frame(graph_.part());
  placer_.note_seen(submaps_.integrate(frame_, placer_.T_submap_sensor(), is_planar()));
}

/// Whether the frame's points determine a pose by themselves.
bool Mapper::State::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_)
    own.add(observation.point, observation.point, observation.weight);
  Pose unused;
  return own.pairs() >= kLeastToStart &&
         own.solve(is_planar(), matcher_.rules(is_planar()).min_spread_m2, unused);
}

/// Begins the part that the graph is at, in the frame of the sensor.
void Mapper::State::start_map() {
  started_ = true;
  placer_.restart(Pose{});
  add_landmarks();
  set_moving_apart();
  open_new_submap();
  parts_.anchor(graph_, graph_.active());
  integrate();
}

/// Does what can be done with a frame that is not where the motion led. Whether it has a pose then.
bool Mapper::State::recover() {
  answer_.determined = placer_.lose(frame_);
  if (placer_.found_elsewhere().part != kNone) {
    enter(placer_.found_elsewhere());
    return true;
  }
  return start_over() || start_part();
}

/// Goes on from where the frame was found.
void Mapper::State::enter(const Placement& found) {
  const Index left = graph_.part();
  close_submap();
  graph_.set_part(found.part);
  if (left != found.part) leave_part(left);
  placer_.enter(found.T_map_points, frame_);
  add_landmarks();
  take_submap();
  integrate();
}

/// Begins the map again with this frame, where there is nothing to keep of it.
bool Mapper::State::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep. One of a few frames is
  // when the sensor does not come back to it.
  const bool waited = placer_.frames_without_pose() > options_.bridge_frames && parts_.count() == 1;
  if (placed_frames_ > 1 && !(waited && PartWatch::is_young(placed_frames_))) return false;
  if (!can_start()) return false;
  first_id_ += graph_.landmarks.size();
  first_epoch_ += parts_.begun();
  placed_frames_ = 0;
  graph_.clear();
  submaps_.clear();
  places_.clear();
  parts_.clear();
  parts_.begin(graph_);
  part_watch_.clear();
  motion_filter_.clear();
  tracks_.clear();
  for (Observation& observation : frame_) observation.expected = kNone;
  start_map();
  return true;
}

/// Begins another part of the map where the sensor is now: the frames before could not be bridged.
bool Mapper::State::start_part() {
  if (!part_watch_.is_time_to_begin(graph_, parts_, frame_.size(), placer_.frames_without_pose()))
    return false;
  if (!can_start()) return false;
  const Index left = graph_.part();
  part_watch_.note_begin(graph_, parts_);
  close_submap();
  parts_.begin(graph_);
  leave_part(left);
  start_map();
  return true;
}

void Mapper::State::leave_part(Index part) {
  submaps_.schedule().leave_part();
  if (PartWatch::is_young(parts_.frames(part)) && part != parts_.first()) parts_.drop(graph_, part);
}

/// Makes this part one with another that it is found to meet. True when there was one, so that no submap is active.
bool Mapper::State::join_met_part() {
  const std::optional<PartWatch::Meeting> met = part_watch_.look(
      graph_, parts_, places_, placer_.T_map_sensor(), answer_.counters.iterations, is_planar());
  if (!met) return false;
  close_submap();
  placer_.refit(frame_);
  placer_.move_frame(parts_.join(graph_, met->other, graph_.part(), met->T_other_here));
  for (Observation& observation : frame_) {
    if (observation.landmark == kNone) continue;
    if (graph_.landmarks[observation.landmark].part != graph_.part())
      observation.landmark = parts_.move(graph_, observation.landmark);
  }
  note_joined();
  placer_.refit(frame_);
  submaps_.schedule().parts_joined();
  ++answer_.counters.joined;
  return true;
}

/// Tells what became the same landmark in a join.
void Mapper::State::note_joined() {
  for (const MapParts::Merge& merge : parts_.merges()) motion_filter_.merged(merge.from, merge.into);
  answer_.counters.merged += parts_.merges().size();
  parts_.forget_merges();
}

void Mapper::State::change_submap() {
  close_submap();
  // Submaps have moved, and with them what the frame was fitted to.
  placer_.refit(frame_);
  take_submap();
}

void Mapper::State::take_submap() {
  const SubmapSequence::Taken taken = submaps_.take_up(frame_, is_planar(), placer_.T_map_sensor());
  if (taken.reopened) ++answer_.counters.reopened;
  placer_.enter_submap(taken.T_submap_sensor);
}

void Mapper::State::open_new_submap() {
  submaps_.open_new(placer_.T_map_sensor());
  placer_.enter_submap(Pose{});
}

void Mapper::State::close_submap() {
  const Index closed = graph_.active();
  answer_.counters.merged += submaps_.close(motion_filter_, is_planar(), intake_.is_followed(), frame_);
  places_.note(graph_, closed);
  ++answer_.counters.closes;
}

Index Mapper::State::told_part() const {
  return options_.report_parts != 0 ? graph_.part() : parts_.first();
}

const Answer& Mapper::State::answer() {
  answer_.in_part = has_pose_;
  if (has_pose_) answer_.determined = is_planar() ? 3 : 6;
  answer_.part = started_ ? parts_.number_of(graph_.part()) : 0;
  answer_.epoch = first_epoch_ + (started_ ? parts_.number_of(told_part()) : 0);
  answer_.has_pose = has_pose_ && graph_.part() == told_part();
  answer_.covariance.reset();
  if (answer_.has_pose) {
    answer_pose();
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

/// The pose and its covariance, in the frame that the part is told in.
void Mapper::State::answer_pose() {
  const Pose& anchor = graph_.poses[parts_.anchor_of(told_part())];
  answer_.covariance =
      pose_covariance(graph_, frame_, placer_.T_map_sensor(), submaps_.segments().noise2_m2(), is_planar());
  if (answer_.covariance) answer_.covariance = told_from(anchor, *answer_.covariance);
  const Pose T = told_from(anchor, placer_.T_map_sensor());
  answer_.T_map_sensor.t = T.t + Vec3::Zero();  // no negative zeros
  answer_.T_map_sensor.q.coeffs() = T.q.coeffs() + Eigen::Vector4d::Zero();
}

MapSource Mapper::State::map_source() const {
  return {graph_,      parts_,    motion_filter_.tracks(),
          told_part(), first_id_, static_cast<std::uint32_t>(options_.min_observations),
          is_planar()};
}

Map Mapper::State::map() const {
  return started_ ? report_map(map_source()) : Map{};
}

Map Mapper::State::refined_map() const {
  return started_ ? report_refined_map(map_source(), submaps_.segments()) : Map{};
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
