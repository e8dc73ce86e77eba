// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/mapper.hpp"

#include <algorithm>
#include <numeric>

#include "slam_plane/spatial/edge_judge.hpp"
#include "slam_plane/spatial/frame_locator.hpp"
#include "slam_plane/spatial/plane_map.hpp"
#include "slam_plane/spatial/plane_matcher.hpp"
#include "slam_plane/spatial/submap_fit.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr std::uint64_t kOldGround = 100;  // frames after which a plane that comes back is old ground
constexpr int kCloseSteps = 2;             // over all submaps, when one closes
constexpr int kRefineSteps = 20;
constexpr std::size_t kWindow = 12;  // submaps that are placed anew when one closes on new ground

}  // namespace

class Mapper::State {
 public:
  explicit State(const Options& options)
      : options_(options),
        map_(options),
        judge_(options),
        matcher_(options),
        locator_(options),
        submap_fit_(options) {
    options_.validate();
  }

  const Options& options() const { return options_; }

  const Answer& process(std::span<const PlaneObservation> observations, const View& view) {
    begin(observations, view);
    if (map_.submaps.empty()) {
      start();
    } else {
      lost_ = locator_.locate(map_, frame_);
      if (lost_ == Lost::no) {
        if (locator_.found_again()) ++answer_.counters.found_again;
        follow_outliers();
        add_landmarks();
        if (choose_submap()) {
          integrate();
          merge_duplicates();
        }
        locator_.note_motion(map_, frame_);
      } else {
        locator_.drift(map_, frame_);
      }
    }
    return answer();
  }

  Map map() const { return report_map(map_, options_.min_observations); }

  Map refined_map() const {
    PlaneMap refined = map_;
    solve(refined, all_but_first(refined), kRefineSteps);
    return report_map(refined, options_.min_observations);
  }

 private:
  void begin(std::span<const PlaneObservation> observations, const View& view);
  void start();
  void follow_outliers();
  void add_landmarks();
  bool choose_submap();
  bool change_submap();
  void close();
  void integrate();
  void set_apart();
  void merge_duplicates();
  const Answer& answer();

  static std::vector<Index> all_but_first(const PlaneMap& map) {
    std::vector<Index> all(map.submaps.empty() ? 0 : map.submaps.size() - 1);
    std::iota(all.begin(), all.end(), Index{1});
    return all;
  }

  Options options_;
  PlaneMap map_;
  EdgeJudge judge_;
  PlaneMatcher matcher_;
  FrameLocator locator_;
  SubmapFit submap_fit_;

  Frame frame_;
  Lost lost_ = Lost::no;
  bool first_of_submap_ = false;
  bool old_ground_ = false;
  Answer answer_;
};

void Mapper::State::begin(std::span<const PlaneObservation> observations, const View& view) {
  ++frame_.iteration;
  frame_.observations.clear();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (observations[i].outline.size() >= 3)
      frame_.observations.push_back(observation_of(observations[i], i));
  }
  judge_.judge(view, frame_.observations);
  std::erase_if(frame_.observations,
                [this](const AssociatedObservation& s) { return is_sliver(s, options_.noise()); });
  answer_.associations.assign(observations.size(), kNoLandmark);
  lost_ = Lost::no;
}

/// The map begins with the first frame that determines its own pose.
void Mapper::State::start() {
  frame_.known = locator_.own_information(frame_);
  if (!frame_.known.determined()) {
    lost_ = frame_.known.open == 6 ? Lost::nothing_known : Lost::unobservable;
    return;
  }
  map_.activate(map_.add_submap(Pose{}));
  first_of_submap_ = true;
  add_landmarks();
  integrate();
  locator_.note_motion(map_, frame_);
}

/// What lies beside its plane is no evidence: the plane may move.
void Mapper::State::follow_outliers() {
  for (const AssociatedObservation& observation : frame_.observations) {
    if (observation.landmark == kNone) continue;
    if (map_.follow(frame_.T_map_robot, observation, observation.outlier, frame_.iteration))
      ++answer_.counters.dynamic;
    if (observation.outlier && map_.landmarks[observation.landmark].is_dynamic)
      answer_.associations[observation.given] = observation.landmark;
  }
  std::erase_if(frame_.observations,
                [](const AssociatedObservation& observation) { return observation.outlier; });
}

void Mapper::State::add_landmarks() {
  for (AssociatedObservation& observation : frame_.observations) {
    if (observation.landmark == kNone) observation.landmark = map_.add_landmark();
  }
}

/// Aligns the frame to a submap that it may be added to; false if there is none.
bool Mapper::State::choose_submap() {
  frame_.T_submap_robot = map_.submaps[map_.active()].T_map_submap.inverse() * frame_.T_map_robot;
  const SubmapRecord& active = map_.submaps[map_.active()];
  const bool stays = active.frames < options_.max_submap_frames &&
                     overlap_of(active.first_seen, frame_.landmarks()) >= options_.overlap;
  if (stays && submap_fit_.locate(map_, frame_.observations, frame_.T_submap_robot)) return true;
  return change_submap();
}

bool Mapper::State::change_submap() {
  close();
  const Index before = map_.active();
  if (const Index old = submap_fit_.find_old(map_, frame_.landmarks(), options_.overlap); old != kNone) {
    map_.activate(old);
    frame_.T_submap_robot = map_.submaps[old].T_map_submap.inverse() * frame_.T_map_robot;
    if (submap_fit_.locate(map_, frame_.observations, frame_.T_submap_robot)) {
      map_.submaps[old].frames = 0;
      ++answer_.counters.reopened;
      return true;
    }
  }
  if (locator_.own_information(frame_).determined()) {
    map_.activate(map_.add_submap(frame_.T_map_robot));
    frame_.T_submap_robot = Pose{};
    first_of_submap_ = true;
    return true;
  }
  map_.activate(before);
  frame_.T_submap_robot = map_.submaps[before].T_map_submap.inverse() * frame_.T_map_robot;
  return submap_fit_.locate(map_, frame_.observations, frame_.T_submap_robot);
}

/// Places submaps anew: those about the robot, or all of them where old ground was met.
void Mapper::State::close() {
  ++answer_.counters.closes;
  std::vector<Index> free = all_but_first(map_);
  if (!old_ground_ && free.size() > kWindow) free = submap_fit_.nearest(map_, frame_.landmarks(), kWindow);
  old_ground_ = false;
  const Pose T_active = map_.submaps[map_.active()].T_map_submap;
  answer_.counters.global_steps += static_cast<std::uint64_t>(solve(map_, free, kCloseSteps));
  const Pose moved = map_.submaps[map_.active()].T_map_submap * T_active.inverse();
  frame_.T_map_robot = moved * frame_.T_map_robot;
  locator_.carry(moved);
}

void Mapper::State::merge_duplicates() {
  for (AssociatedObservation& observation : frame_.observations) {
    if (observation.landmark == kNone) continue;
    for (const Index other : matcher_.duplicates_of(map_, observation.landmark)) {
      const Index own = observation.landmark;
      if (!map_.landmarks[other].alive() || !matcher_.are_duplicates(map_, own, other))
        continue;  // no longer
      const Index kept = std::min(own, other), gone = std::max(own, other);
      map_.merge(kept, gone);
      ++answer_.counters.merged;
      for (AssociatedObservation& s : frame_.observations) {
        if (s.landmark == gone) s.landmark = kept;
      }
    }
  }
}

void Mapper::State::integrate() {
  if (first_of_submap_) map_.submaps[map_.active()].first_seen = frame_.landmarks();
  first_of_submap_ = false;
  for (const AssociatedObservation& observation : frame_.observations) {
    if (observation.landmark == kNone) continue;
    map_.observe(frame_.T_submap_robot, observation, frame_.iteration);
    answer_.counters.edges_revoked +=
        static_cast<std::uint64_t>(map_.revoke_edges(observation.landmark, frame_.iteration));
    PlaneRecord& landmark = map_.landmarks[observation.landmark];
    if (landmark.observations > 1 && landmark.last_seen + kOldGround < frame_.iteration) old_ground_ = true;
    landmark.last_seen = frame_.iteration;
  }
  set_apart();
  ++map_.submaps[map_.active()].frames;
}

/// What one frame saw as two, on one plane, is two.
void Mapper::State::set_apart() {
  const std::vector<Index> seen = frame_.landmarks();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = i + 1; k < seen.size(); ++k) {
      if (matcher_.on_one_plane(map_.landmarks[seen[i]], map_.landmarks[seen[k]]))
        map_.set_apart(seen[i], seen[k]);
    }
  }
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = lost_ == Lost::no;
  answer_.lost = lost_;
  answer_.open = lost_ == Lost::no ? 0 : frame_.known.open;
  answer_.unobservable.setZero();
  answer_.covariance.setZero();
  if (answer_.has_pose) {
    answer_.T_map_robot = frame_.T_map_robot;
    answer_.covariance = frame_.known.matrix.inverse();
    answer_.covariance = 0.5 * (answer_.covariance + answer_.covariance.transpose()).eval();
  } else {
    ++answer_.counters.lost;
    if (answer_.open == 1) answer_.unobservable = frame_.known.directions.col(0).head<3>().normalized();
  }
  for (const AssociatedObservation& observation : frame_.observations) {
    if (observation.landmark != kNone) answer_.associations[observation.given] = observation.landmark;
  }
  answer_.counters.landmarks = map_.count();
  answer_.counters.edges = map_.certain_edges();
  answer_.counters.submaps = map_.submaps.size();
  return answer_;
}

Mapper::Mapper(const Options& options) : state_(std::make_unique<State>(options)) {}
Mapper::~Mapper() = default;

const Answer& Mapper::process(std::span<const PlaneObservation> observations, const View& view) {
  return state_->process(observations, view);
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

}  // namespace hallway::slam_plane::spatial
