// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/mapper.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/thesis/grouping.hpp"
#include "slam_point/core/thesis/matcher.hpp"
#include "slam_point/core/thesis/tracks.hpp"

namespace hallway::slam_point::thesis {
namespace {

constexpr double kLargestCoordinate_m = 1e6;
constexpr double kLargestRotationSigma_rad = 0.1;
constexpr double kFitInlierNoises = 4.0;
constexpr double kBasisNoises = 5.0;  // what the third basis point must stand off the line through the others
constexpr double kLeastAgreeingShare = 0.4;  // of the points that can be compared with the map

const slam_point::Options& checked_common(const slam_point::Options& common, const Options& options) {
  common.validate();
  options.validate();
  return common;
}

}  // namespace

class Mapper::State {
 public:
  State(const slam_point::Options& common, const Options& options)
      : common_(checked_common(common, options)),
        options_(options),
        tracks_(Grouping::kept_iterations(options), std::max(common.map_bound(), common.separation()),
                static_cast<IndexKind>(common.index)),
        matcher_(common, options),
        grouping_(options, kBasisNoises * common.noise_m) {}

  const Answer& process(std::span<const Vec3> points);
  Map map() const;
  const slam_point::Options& common() const { return common_; }
  const Options& options() const { return options_; }

 private:
  void place(std::span<const Vec3> points);
  void take_points(std::span<const Vec3> points);
  bool can_start() const;
  void start();
  bool start_over();
  bool fit();
  bool is_placed() const;
  void learn_motion(const Pose& before);
  void chart();
  void merge_new();
  Index twin_of(Index track) const;
  const Answer& answer();

  slam_point::Options common_;
  Options options_;
  Tracks tracks_;
  Matcher matcher_;
  Grouping grouping_;
  std::vector<Observation> frame_;
  std::vector<Pair> pairs_;
  std::deque<Index> to_compare_;  // new landmarks that merging will look at
  Pose T_map_sensor_;
  Pose moved_;  // T_last_now of the last iteration
  Iteration iteration_ = 0;
  std::size_t comparable_ = 0;       // points of this frame that a mapped landmark was found for
  std::size_t last_comparable_ = 0;  // of the last frame with a pose
  bool started_ = false;
  bool planar_ = true;
  bool has_pose_ = false;
  LandmarkId first_id_ = 0;  // id of landmark 0
  Answer answer_;
};

const Answer& Mapper::State::process(std::span<const Vec3> points) {
  place(points);
  return answer();
}

void Mapper::State::place(std::span<const Vec3> points) {
  take_points(points);
  if (!started_) {
    has_pose_ = can_start();
    if (has_pose_) start();
    return;
  }
  const Pose before = T_map_sensor_;
  matcher_.match_recent(tracks_, iteration_ + 1, moved_, frame_);
  fit();
  matcher_.match_map(tracks_, T_map_sensor_, frame_);
  has_pose_ = fit() && is_placed();
  if (!has_pose_) {
    T_map_sensor_ = before;
    for (Observation& observation : frame_) observation.landmark = kNone;
    has_pose_ = start_over();
    return;
  }
  ++iteration_;
  chart();
  grouping_.compute(tracks_, planar_);
  grouping_.create(tracks_, planar_);
  merge_new();
  fit();  // the map has moved
  learn_motion(before);
}

void Mapper::State::take_points(std::span<const Vec3> points) {
  frame_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Written so that NaN fails.
    if (!(points[i].cwiseAbs().maxCoeff() <= kLargestCoordinate_m) || !points[i].allFinite()) continue;
    if (points[i].z() != 0.0) planar_ = false;
    Observation observation;
    observation.point = points[i];
    observation.given = i;
    frame_.push_back(observation);
  }
  answer_.associations.assign(points.size(), kNoLandmark);
  ++answer_.counters.iterations;
}

bool Mapper::State::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_) own.add(observation.point, observation.point, 1.0);
  const double spread = common_.noise_m / kLargestRotationSigma_rad;
  Pose unused;
  return own.pairs() >= (planar_ ? 2 : 3) && own.solve(planar_, spread * spread, unused);
}

void Mapper::State::start() {
  started_ = true;
  iteration_ = 0;
  T_map_sensor_ = Pose{};
  moved_ = Pose{};
  chart();
  last_comparable_ = frame_.size();
}

bool Mapper::State::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep.
  if (iteration_ > 0 || !can_start()) return false;
  first_id_ += tracks_.size();
  ++answer_.epoch;
  tracks_ = Tracks(Grouping::kept_iterations(options_), std::max(common_.map_bound(), common_.separation()),
                   static_cast<IndexKind>(common_.index));
  grouping_ = Grouping(options_, kBasisNoises * common_.noise_m);
  matcher_ = Matcher(common_, options_);
  to_compare_.clear();
  start();
  return true;
}

bool Mapper::State::fit() {
  pairs_.clear();
  for (const Observation& observation : frame_) {
    if (observation.landmark == kNone || !tracks_[observation.landmark].is_mapped()) continue;
    pairs_.push_back({tracks_[observation.landmark].position, observation.point, 1.0});
  }
  comparable_ = pairs_.size();
  const double spread = common_.noise_m / kLargestRotationSigma_rad;
  return robust_fit(pairs_, {planar_, spread * spread, kFitInlierNoises * common_.noise_m}, T_map_sensor_);
}

bool Mapper::State::is_placed() const {
  const double bound2 = common_.map_bound() * common_.map_bound();
  std::size_t agreeing = 0;
  for (const Pair& pair : pairs_) {
    if ((T_map_sensor_ * pair.point - pair.reference).squaredNorm() <= bound2) ++agreeing;
  }
  const std::size_t comparable = std::min(frame_.size(), last_comparable_);
  return agreeing >= (planar_ ? 2 : 3) &&
         static_cast<double>(agreeing) >= kLeastAgreeingShare * static_cast<double>(comparable);
}

void Mapper::State::learn_motion(const Pose& before) {
  moved_ = before.inverse() * T_map_sensor_;
  last_comparable_ = comparable_;
}

void Mapper::State::chart() {
  tracks_.begin_iteration(iteration_);
  for (Observation& observation : frame_) {
    if (observation.landmark == kNone) {
      Vec3 position = T_map_sensor_ * observation.point;
      if (planar_) position.z() = 0.0;
      observation.landmark = tracks_.add(position);
      grouping_.add(observation.landmark);
      if (options_.merge_after > 0 && iteration_ > 0) to_compare_.push_back(observation.landmark);
    }
    tracks_.see(observation.landmark, observation.point);
  }
}

void Mapper::State::merge_new() {
  const auto age = static_cast<Iteration>(options_.merge_after);
  while (!to_compare_.empty() && tracks_[to_compare_.front()].first + age <= iteration_) {
    const Index from = to_compare_.front();
    to_compare_.pop_front();
    if (tracks_[from].merged_into != kNone || !tracks_[from].is_mapped()) continue;
    const Index into = twin_of(from);
    if (into == kNone || !grouping_.can_merge(tracks_, from)) continue;
    grouping_.merge(tracks_, into, from, planar_);
    ++answer_.counters.merged;
    for (Observation& observation : frame_) {
      if (observation.landmark == from) observation.landmark = into;
    }
  }
}

Index Mapper::State::twin_of(Index track) const {
  const Vec3& place = tracks_[track].position;
  double nearest2 = common_.separation() * common_.separation();
  Index twin = kNone;
  tracks_.visit_near(place, [&](Index other) {
    const double d2 = (tracks_[other].position - place).squaredNorm();
    if (other >= track || !tracks_[other].is_mapped() || d2 > nearest2) return;
    if (d2 == nearest2 && other > twin) return;
    // Seen together, they are two.
    const auto given = tracks_[track].history.between(0, iteration_);
    const bool together = std::any_of(given.begin(), given.end(), [&](const Sighting& sighting) {
      return tracks_[other].history.find(sighting.iteration) != nullptr;
    });
    if (together) return;
    nearest2 = d2;
    twin = other;
  });
  return twin;
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = has_pose_;
  if (has_pose_) {
    answer_.T_map_sensor.t = T_map_sensor_.t + Vec3::Zero();  // no negative zeros
    answer_.T_map_sensor.q.coeffs() = T_map_sensor_.q.coeffs() + Eigen::Vector4d::Zero();
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_) {
    if (observation.landmark != kNone)
      answer_.associations[observation.given] = first_id_ + observation.landmark;
  }
  answer_.counters.landmarks = tracks_.size() - answer_.counters.merged;
  answer_.counters.submaps = grouping_.standing();
  answer_.counters.closes = grouping_.made();
  return answer_;
}

Map Mapper::State::map() const {
  Map map;
  for (Index t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    if (track.merged_into != kNone) continue;
    Landmark landmark;
    landmark.id = first_id_ + t;
    landmark.position = track.position;
    landmark.observations = track.observations;
    const bool enough = track.observations >= static_cast<std::uint32_t>(common_.min_observations);
    if (enough && track.level >= std::min(options_.levels, 2)) landmark.status = LandmarkStatus::mapped;
    map.landmarks.push_back(landmark);
  }
  grouping_.visit([&](Index g, const Group& group) {
    Submap submap;
    submap.id = g;
    submap.T_map_submap = group.T_map_group();
    for (const Index track : group.points()) submap.members.push_back(first_id_ + track);
    map.submaps.push_back(std::move(submap));
  });
  return map;
}

Mapper::Mapper(const slam_point::Options& common, const Options& options)
    : state_(std::make_unique<State>(common, options)) {}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const Answer& Mapper::process(std::span<const Vec3> points) {
  return state_->process(points);
}

Map Mapper::map() const {
  return state_->map();
}

void Mapper::reset() {
  state_ = std::make_unique<State>(slam_point::Options(state_->common()), Options(state_->options()));
}

}  // namespace hallway::slam_point::thesis
