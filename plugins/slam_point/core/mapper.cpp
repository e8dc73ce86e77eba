// SPDX-License-Identifier: MIT
#include "slam_point/core/mapper.hpp"

#include <algorithm>

#include "slam_point/core/frame/frame_intake.hpp"
#include "slam_point/core/frame/frame_placer.hpp"
#include "slam_point/core/frame/pose_information.hpp"
#include "slam_point/core/map_report.hpp"
#include "slam_point/core/moving/motion_filter.hpp"
#include "slam_point/core/places/part_watch.hpp"

namespace hallway::slam_point {
namespace {

constexpr std::size_t kLeastToStart = 3;     // points that start a map
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
        graph_(
            std::max({options.match_bound(), options.map_bound(), options.separation(), options.agreement()}),
            static_cast<IndexKind>(options.index), options.is_directional() ? options.agreement() : 0.0),
        intake_(options, tracks_, graph_),
        tracking_(options),
        matcher_(options, graph_),
        parts_(graph_, options.agreement()),
        places_(options, graph_),
        part_watch_(options, graph_, parts_, places_),
        motion_filter_(options, graph_),
        submaps_(options, graph_, matcher_),
        placer_(options, submaps_, parts_, tracking_, matcher_, places_, clock_) {}

  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);
  Map map() const;
  Map refined_map() const;
  const Options& options() const { return options_; }
  void time_stages(StageTimes* times) { clock_.add_to(times); }

 private:
  void advance_map();
  void take_points(std::span<const Vec3> points, std::span<const TrackId> tracks);
  bool place();
  void find_placement();
  void follow_moving();
  void add_landmarks();
  void take_out_moving();
  void choose_submap();
  void integrate();
  void advance_steps();
  bool can_start() const;
  void start_map();
  bool recover();
  void enter(Relocalisation found);
  bool start_over();
  bool start_part();
  void leave_part(Index part);
  bool join_met_part();
  void note_joined();
  void take_submap();
  void close_submap();
  void refit() { matcher_.fit_map(frame_.observations, placement_.T_map_sensor); }
  bool looks_for_motion() const { return options_.find_moving != 0 && !frame_.followed; }
  Index reported_part() const { return options_.report_parts != 0 ? graph_.part() : parts_.first(); }
  const Answer& answer();
  void answer_pose();
  MapSource map_source() const;

  Options options_;
  SubmapGraph graph_;  // the map
  TrackBook tracks_;
  FrameIntake intake_;
  Tracking tracking_;
  FrameMatcher matcher_;
  MapParts parts_;
  PlaceRecogniser places_;
  PartWatch part_watch_;
  MotionFilter motion_filter_;
  SubmapSequence submaps_;
  StageClock clock_;
  FramePlacer placer_;

  Frame frame_;
  Placement placement_;  // of the frame
  bool started_ = false;
  bool has_pose_ = false;
  std::uint64_t placed_frames_ = 0;
  LandmarkId first_id_ = 0;        // id of landmark 0
  std::uint64_t first_epoch_ = 0;  // Answer::epoch of the map's first part
  Answer answer_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  advance_map();
  take_points(points, tracks);
  has_pose_ = place();
  advance_steps();
  return answer();
}

/// One iteration (thesis 6.2 to 6.5). Whether the frame has a pose.
bool Mapper::State::place() {
  const StageClock::Scope timing(clock_, Stage::averaging);
  if (!started_) {
    if (!can_start()) return false;
    parts_.begin();
    start_map();
    return true;
  }
  find_placement();                            // 6.2.5, 6.5.1: associations; 6.3.2: the pose
  if (!placement_.has_pose) return recover();  // elsewhere in the map, or in a new part of it
  follow_moving();                             // 6.5.3
  add_landmarks();                             // 6.2.5: points that are none yet
  take_out_moving();                           // 6.5.3
  choose_submap();                             // 6.4: which points are seen together; 6.5.2: merging
  integrate();                                 // 6.3.3: averages relative to the submap
  return true;
}

/// What is done between frames: landmarks are indexed and moved, and submaps are where a step that is ready puts them.
void Mapper::State::advance_map() {
  const StageClock::Scope timing(clock_, Stage::solving);
  places_.advance();
  parts_.advance(kMovedPerFrame);
  note_joined();
  if (submaps_.schedule().apply(graph_, submaps_.segments().noise2_m2())) ++answer_.counters.global_steps;
}

void Mapper::State::take_points(std::span<const Vec3> points, std::span<const TrackId> tracks) {
  const StageClock::Scope timing(clock_, Stage::matching);
  intake_.take(points, tracks, frame_);
  graph_.planar = frame_.planar;
  answer_.associations.assign(points.size(), kNoLandmark);
  answer_.determined = 0;
  ++answer_.counters.iterations;
}

void Mapper::State::find_placement() {
  placement_ = placer_.place(frame_);
  tracking_.learn(placement_);
  answer_.determined = placement_.determined;
  if (!placement_.is_sure && !frame_.followed) ++answer_.counters.searches;
  if (placement_.is_recognised) ++answer_.counters.relocalised;
}

void Mapper::State::follow_moving() {
  const StageClock::Scope timing(clock_, Stage::moving);
  if (looks_for_motion()) motion_filter_.follow(placement_.T_map_sensor, frame_.observations);
}

void Mapper::State::add_landmarks() {
  const PointMotion to_map(placement_.T_map_sensor);
  const double separation2 = options_.separation() * options_.separation();
  for (Observation& observation : frame_.observations) {
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

void Mapper::State::take_out_moving() {
  const StageClock::Scope timing(clock_, Stage::moving);
  if (!looks_for_motion()) return;
  if (!motion_filter_.judge(submaps_.active(), placement_.T_map_sensor, frame_.observations)) return;
  ++answer_.counters.found_moving;
  // What moved has pulled at the frame.
  refit();
}

/// Goes on with another submap where this part of the map has met another one, or this submap is over.
void Mapper::State::choose_submap() {
  if (!join_met_part()) {
    if (!submaps_.is_over(frame_.observations)) return;
    close_submap();
    // Submaps have moved, and with them what the frame was fitted to.
    refit();
  }
  take_submap();
}

void Mapper::State::integrate() {
  ++placed_frames_;
  parts_.count_frame(graph_.part());
  const std::size_t seen = submaps_.integrate(frame_.observations, placement_.T_submap_sensor);
  tracking_.enter(placement_.T_submap_sensor, seen);
}

void Mapper::State::advance_steps() {
  const StageClock::Scope timing(clock_, Stage::solving);
  submaps_.schedule().advance(answer_.counters.iterations);
}

/// Whether the frame's points determine a pose by themselves.
bool Mapper::State::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_.observations)
    own.add(observation.point, observation.point, observation.weight);
  Pose unused;
  return own.pairs() >= kLeastToStart && own.solve(matcher_.rules(), unused);
}

/// Begins the part that the graph is at, in the frame of the sensor.
void Mapper::State::start_map() {
  started_ = true;
  placement_ = Placement();
  add_landmarks();
  take_out_moving();
  submaps_.open_new(placement_.T_map_sensor);
  parts_.anchor(graph_.active());
  integrate();
}

/// Does what can be done with a frame that is not where the motion led. Whether it has a pose then.
bool Mapper::State::recover() {
  if (placement_.elsewhere.part == kNone) return start_over() || start_part();
  enter(placement_.elsewhere);
  return true;
}

/// Goes on from where the frame was found.
void Mapper::State::enter(Relocalisation found) {
  const Index left = graph_.part();
  close_submap();
  graph_.set_part(found.part);
  if (left != found.part) leave_part(left);
  placement_ = placer_.place_at(found.T_map_points, frame_);
  add_landmarks();
  take_submap();
  integrate();
}

/// Begins the map again with this frame, where there is nothing to keep of it.
bool Mapper::State::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep. One of a few frames is
  // when the sensor does not come back to it.
  const bool waited = tracking_.frames_without_pose() > options_.bridge_frames && parts_.count() == 1;
  if (placed_frames_ > 1 && !(waited && PartWatch::is_young(placed_frames_))) return false;
  if (!can_start()) return false;
  first_id_ += graph_.landmarks.size();
  first_epoch_ += parts_.begun();
  placed_frames_ = 0;
  graph_.clear();
  submaps_.clear();
  places_.clear();
  parts_.clear();
  parts_.begin();
  part_watch_.clear();
  motion_filter_.clear();
  tracks_.clear();
  for (Observation& observation : frame_.observations) observation.expected = kNone;
  start_map();
  return true;
}

/// Begins another part of the map where the sensor is now: the frames before could not be bridged.
bool Mapper::State::start_part() {
  if (!part_watch_.is_time_to_begin(frame_.observations.size(), tracking_.frames_without_pose()))
    return false;
  if (!can_start()) return false;
  const Index left = graph_.part();
  part_watch_.note_begin();
  close_submap();
  parts_.begin();
  leave_part(left);
  start_map();
  return true;
}

void Mapper::State::leave_part(Index part) {
  submaps_.schedule().leave_part();
  if (PartWatch::is_young(parts_.frames(part)) && part != parts_.first()) parts_.drop(part);
}

/// Makes this part one with another that it is found to meet. True when there was one, so that no submap is active.
bool Mapper::State::join_met_part() {
  const std::optional<PartWatch::Meeting> met =
      part_watch_.look(placement_.T_map_sensor, answer_.counters.iterations);
  if (!met) return false;
  close_submap();
  refit();
  Pose& T_map_sensor = placement_.T_map_sensor;
  T_map_sensor = parts_.join(met->other, graph_.part(), met->T_other_here) * T_map_sensor;
  for (Observation& observation : frame_.observations) {
    if (observation.landmark == kNone) continue;
    if (graph_.landmarks[observation.landmark].part != graph_.part())
      observation.landmark = parts_.move(observation.landmark);
  }
  note_joined();
  refit();
  submaps_.schedule().parts_joined();
  ++answer_.counters.joined;
  return true;
}

/// Passes on which landmarks a join merged.
void Mapper::State::note_joined() {
  for (const MapParts::Merge& merge : parts_.take_merges()) {
    motion_filter_.merged(merge.from, merge.into);
    ++answer_.counters.merged;
  }
}

void Mapper::State::take_submap() {
  const StageClock::Scope timing(clock_, Stage::closing);
  const SubmapSequence::Taken taken = submaps_.take_up(frame_.observations, placement_.T_map_sensor);
  if (taken.reopened) ++answer_.counters.reopened;
  placement_.T_submap_sensor = taken.T_submap_sensor;
}

void Mapper::State::close_submap() {
  const StageClock::Scope timing(clock_, Stage::closing);
  const Index closed = graph_.active();
  answer_.counters.merged += submaps_.close(motion_filter_, frame_);
  places_.note(closed);
  ++answer_.counters.closes;
}

const Answer& Mapper::State::answer() {
  answer_.in_part = has_pose_;
  if (has_pose_) answer_.determined = frame_.planar ? 3 : 6;
  answer_.part = started_ ? parts_.number_of(graph_.part()) : 0;
  answer_.epoch = first_epoch_ + (started_ ? parts_.number_of(reported_part()) : 0);
  answer_.has_pose = has_pose_ && graph_.part() == reported_part();
  answer_.covariance.reset();
  if (answer_.has_pose) {
    answer_pose();
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_.observations) {
    const Index landmark = observation.landmark != kNone ? observation.landmark : observation.moving;
    if (landmark != kNone) answer_.associations[observation.given] = first_id_ + landmark;
  }
  answer_.counters.landmarks = graph_.landmarks.size() - answer_.counters.merged - graph_.dropped_landmarks();
  answer_.counters.parts = parts_.count();
  answer_.counters.submaps = graph_.submaps.size();
  return answer_;
}

/// The pose and its covariance, in the frame that the part is reported in.
void Mapper::State::answer_pose() {
  const Pose& anchor = graph_.poses[parts_.anchor_of(reported_part())];
  const Pose& T_map_sensor = placement_.T_map_sensor;
  answer_.covariance =
      pose_covariance(graph_, frame_.observations, T_map_sensor, submaps_.segments().noise2_m2());
  if (answer_.covariance) answer_.covariance = seen_from(anchor, *answer_.covariance);
  answer_.T_map_sensor = without_negative_zeros(seen_from(anchor, T_map_sensor));
}

MapSource Mapper::State::map_source() const {
  return {graph_,          parts_,    motion_filter_.tracks(),
          reported_part(), first_id_, static_cast<std::uint32_t>(options_.min_observations)};
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
