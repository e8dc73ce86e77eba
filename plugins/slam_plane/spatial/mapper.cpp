// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "slam_plane/spatial/edge_judge.hpp"
#include "slam_plane/spatial/face_map.hpp"
#include "slam_plane/spatial/face_matcher.hpp"
#include "slam_plane/spatial/map_report.hpp"
#include "slam_plane/spatial/map_solver.hpp"
#include "slam_plane/spatial/pose_fit.hpp"
#include "slam_plane/spatial/submap_fit.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr std::uint64_t kRecent = 15;      // frames for which a face counts as seen just before
constexpr std::uint64_t kOldGround = 100;  // frames after which a face that comes back is old ground
constexpr double kStraySigmas = 6.0;       // and kStray_m: beside the face that it should be
constexpr double kStray_m = 0.05;
constexpr double kDoubt_m = 0.002;    // by how much a predicted place may be wrong: a frame,
constexpr double kDoubtShare = 0.05;  // and of the way
constexpr int kCloseSteps = 2;        // over all submaps, when one closes
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
        fit_(options),
        submap_fit_(options) {
    options_.validate();
  }

  const Options& options() const { return options_; }

  const Answer& process(std::span<const Face> faces, const View& view) {
    begin(faces, view);
    if (map_.submaps.empty()) {
      start();
    } else {
      predict();
      associate();
      locate();
      if (lost_ == Lost::no) {
        add_faces();
        if (choose_submap()) {
          integrate();
          merge_twins();
        }
        note_motion();
      } else {
        drift();
      }
    }
    return answer();
  }

  Map map() const { return report_map(map_, options_.min_observations); }

  Map refined_map() const {
    FaceMap refined = map_;
    solve(refined, all_but_first(refined), kRefineSteps);
    return report_map(refined, options_.min_observations);
  }

 private:
  void begin(std::span<const Face> faces, const View& view);
  void start();
  void predict();
  void associate();
  void locate();
  PoseInformation fit_to_map(Pose3& T);
  bool drop_strays(const Pose3& T);
  void add_faces();
  bool choose_submap();
  bool change_submap();
  void close();
  void integrate();
  void set_apart();
  void merge_twins();
  void note_motion();
  void drift();
  const Answer& answer();

  static std::vector<Index> all_but_first(const FaceMap& map) {
    std::vector<Index> all(map.submaps.empty() ? 0 : map.submaps.size() - 1);
    std::iota(all.begin(), all.end(), Index{1});
    return all;
  }
  std::vector<Index> faces_in_view() const;

  Options options_;
  FaceMap map_;
  EdgeJudge judge_;
  FaceMatcher matcher_;
  PoseFit fit_;
  SubmapFit submap_fit_;

  std::uint64_t iteration_ = 0;
  std::vector<Sighting> frame_;
  Pose3 T_map_robot_;
  Pose3 T_submap_robot_;
  std::optional<Pose3> T_map_before_;  // of the last frame, if it had a pose
  Vec6 motion_ = Vec6::Zero();         // predicted, from frame to frame, in the robot's frame
  bool moving_ = false;                // it is known
  PoseInformation known_;
  Lost lost_ = Lost::no;
  double doubt_m_ = 0.0;  // of the predicted place, while the pose is lost
  bool first_of_submap_ = false;
  bool old_ground_ = false;
  Answer answer_;
};

void Mapper::State::begin(std::span<const Face> faces, const View& view) {
  ++iteration_;
  frame_.clear();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].outline.size() >= 3) frame_.push_back(sighting_of(faces[i], i));
  }
  judge_.judge(view, frame_);
  answer_.associations.assign(faces.size(), kNoWall);
  lost_ = Lost::no;
}

/// The map begins with the first frame that determines its own pose.
void Mapper::State::start() {
  known_ = fit_.own_information(frame_);
  if (!known_.determined()) {
    lost_ = known_.open == 6 ? Lost::nothing_known : Lost::undetermined;
    return;
  }
  map_.activate(map_.add_submap(Pose3{}));
  first_of_submap_ = true;
  add_faces();
  integrate();
  note_motion();
}

void Mapper::State::predict() {
  T_submap_robot_ = T_submap_robot_ * Pose3{rotation_by(motion_.tail<3>()), motion_.head<3>()};
  T_map_robot_ = map_.submaps[map_.active()].T_map_submap * T_submap_robot_;
}

/// Where the prediction is a little wrong, a narrow face may be taken for its neighbour: what is matched by it only corrects it.
void Mapper::State::associate() {
  Pose3 T = T_map_robot_;
  const std::uint64_t since = iteration_ > kRecent ? iteration_ - kRecent : 0;
  matcher_.match_recent(map_, since, T, frame_);
  fit_to_map(T);
  for (Sighting& sighting : frame_) sighting.face = kNone;
  matcher_.match_recent(map_, since, T, frame_);
  matcher_.match_map(map_, T, frame_);
}

PoseInformation Mapper::State::fit_to_map(Pose3& T) {
  const Pose3 predicted = T;
  PoseInformation information;
  for (const bool all_edges : {false, true}) {
    T = predicted;
    fit_.clear();
    for (const Sighting& sighting : frame_) {
      if (sighting.face != kNone)
        fit_.add(sighting, map_.faces[sighting.face].plane, map_.lines(sighting.face, all_edges));
    }
    information = fit_.solve(T);
    if (information.determined()) break;
  }
  return information;
}

/// Takes away what lies beside its face, unless so much does that the pose must be wrong.
bool Mapper::State::drop_strays(const Pose3& T) {
  std::vector<Sighting*> strays;
  std::size_t matched = 0;
  for (Sighting& sighting : frame_) {
    if (sighting.face == kNone) continue;
    ++matched;
    const Feature& plane = map_.faces[sighting.face].plane;
    if (fit_.distance2(sighting, plane, T) > kStraySigmas * kStraySigmas &&
        std::abs(plane.distance(T * sighting.centre)) > kStray_m)
      strays.push_back(&sighting);
  }
  if (strays.empty() || 2 * strays.size() >= matched) return false;
  for (Sighting* sighting : strays) {
    sighting->face = kNone;
    sighting->stray = true;
  }
  return true;
}

void Mapper::State::locate() {
  Pose3 T = T_map_robot_;
  known_ = fit_to_map(T);
  if (drop_strays(T)) {
    T = T_map_robot_;
    known_ = fit_to_map(T);
  }
  T_map_robot_ = T;
  const bool none =
      std::none_of(frame_.begin(), frame_.end(), [](const Sighting& s) { return s.face != kNone; });
  if (none) {
    lost_ = Lost::nothing_known;
  } else if (!known_.determined() || doubt_m_ > options_.map_bound_m) {
    lost_ = Lost::undetermined;
  }
}

void Mapper::State::add_faces() {
  for (Sighting& sighting : frame_) {
    if (sighting.face == kNone && !sighting.stray) sighting.face = map_.add_face();
  }
}

std::vector<Index> Mapper::State::faces_in_view() const {
  std::vector<Index> faces;
  for (const Sighting& sighting : frame_) {
    if (sighting.face != kNone) faces.push_back(sighting.face);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Aligns the frame to a submap that it may be added to; false if there is none.
bool Mapper::State::choose_submap() {
  T_submap_robot_ = map_.submaps[map_.active()].T_map_submap.inverse() * T_map_robot_;
  const SubmapRecord& active = map_.submaps[map_.active()];
  const bool stays = active.frames < options_.max_submap_frames &&
                     overlap_of(active.first_seen, faces_in_view()) >= options_.overlap;
  if (stays && submap_fit_.locate(map_, frame_, T_submap_robot_)) return true;
  return change_submap();
}

bool Mapper::State::change_submap() {
  close();
  const Index before = map_.active();
  if (const Index old = submap_fit_.find_old(map_, faces_in_view(), options_.overlap); old != kNone) {
    map_.activate(old);
    T_submap_robot_ = map_.submaps[old].T_map_submap.inverse() * T_map_robot_;
    if (submap_fit_.locate(map_, frame_, T_submap_robot_)) {
      map_.submaps[old].frames = 0;
      ++answer_.counters.reopened;
      return true;
    }
  }
  if (fit_.own_information(frame_).determined()) {
    map_.activate(map_.add_submap(T_map_robot_));
    T_submap_robot_ = Pose3{};
    first_of_submap_ = true;
    return true;
  }
  map_.activate(before);
  T_submap_robot_ = map_.submaps[before].T_map_submap.inverse() * T_map_robot_;
  return submap_fit_.locate(map_, frame_, T_submap_robot_);
}

/// Places submaps anew: those about the robot, or all of them where old ground was met.
void Mapper::State::close() {
  ++answer_.counters.closes;
  std::vector<Index> free = all_but_first(map_);
  if (!old_ground_ && free.size() > kWindow) free = submap_fit_.nearest(map_, faces_in_view(), kWindow);
  old_ground_ = false;
  const Pose3 T_active = map_.submaps[map_.active()].T_map_submap;
  answer_.counters.global_steps += static_cast<std::uint64_t>(solve(map_, free, kCloseSteps));
  const Pose3 moved = map_.submaps[map_.active()].T_map_submap * T_active.inverse();
  T_map_robot_ = moved * T_map_robot_;
  if (T_map_before_) T_map_before_ = moved * *T_map_before_;
}

void Mapper::State::merge_twins() {
  for (Sighting& sighting : frame_) {
    if (sighting.face == kNone) continue;
    for (Index other = 0; other < map_.faces.size(); ++other) {
      const Index own = sighting.face;
      if (other == own || !map_.faces[other].alive() || !matcher_.are_twins(map_, own, other)) continue;
      const Index kept = std::min(own, other), gone = std::max(own, other);
      map_.merge(kept, gone);
      ++answer_.counters.merged;
      for (Sighting& s : frame_) {
        if (s.face == gone) s.face = kept;
      }
    }
  }
}

void Mapper::State::integrate() {
  if (first_of_submap_) map_.submaps[map_.active()].first_seen = faces_in_view();
  first_of_submap_ = false;
  for (const Sighting& sighting : frame_) {
    if (sighting.face == kNone) continue;
    map_.observe(T_submap_robot_, sighting, iteration_);
    answer_.counters.edges_revoked +=
        static_cast<std::uint64_t>(map_.revoke_edges(sighting.face, iteration_));
    FaceRecord& face = map_.faces[sighting.face];
    if (face.observations > 1 && face.last_seen + kOldGround < iteration_) old_ground_ = true;
    face.last_seen = iteration_;
  }
  set_apart();
  ++map_.submaps[map_.active()].frames;
}

/// What one frame saw as two, on one plane, is two.
void Mapper::State::set_apart() {
  const std::vector<Index> seen = faces_in_view();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = i + 1; k < seen.size(); ++k) {
      if (matcher_.on_one_plane(map_.faces[seen[i]], map_.faces[seen[k]])) map_.set_apart(seen[i], seen[k]);
    }
  }
}

/// Learns from a pose how the robot moves. What is predicted goes on in the frame of the active submap.
void Mapper::State::note_motion() {
  const Pose3 T_submap_robot = map_.submaps[map_.active()].T_map_submap.inverse() * T_map_robot_;
  if (T_map_before_) {
    const Pose3 moved = T_map_before_->inverse() * T_map_robot_;
    Vec6 now;
    now << moved.t, rotation_vector(moved.q);
    motion_ += (moving_ ? options_.smoothing : 1.0) * (now - motion_);
    moving_ = true;
  }
  T_map_before_ = T_map_robot_;
  T_submap_robot_ = T_submap_robot;
  doubt_m_ = 0.0;
}

/// Without a pose the robot goes on as predicted in what is open.
void Mapper::State::drift() {
  if (lost_ == Lost::undetermined) ++answer_.counters.degenerate;
  T_submap_robot_ = map_.submaps[map_.active()].T_map_submap.inverse() * T_map_robot_;
  doubt_m_ += kDoubt_m + kDoubtShare * motion_.head<3>().norm();
  T_map_before_.reset();
  for (Sighting& sighting : frame_) sighting.face = kNone;
}

const Answer& Mapper::State::answer() {
  answer_.has_pose = lost_ == Lost::no;
  answer_.lost = lost_;
  answer_.open = lost_ == Lost::no ? 0 : known_.open;
  answer_.undetermined.setZero();
  answer_.covariance.setZero();
  if (answer_.has_pose) {
    answer_.T_map_robot = T_map_robot_;
    answer_.covariance = known_.matrix.inverse();
    answer_.covariance = 0.5 * (answer_.covariance + answer_.covariance.transpose()).eval();
  } else {
    ++answer_.counters.lost;
    if (answer_.open == 1) answer_.undetermined = known_.directions.col(0).head<3>().normalized();
  }
  for (const Sighting& sighting : frame_) {
    if (sighting.face != kNone) answer_.associations[sighting.given] = sighting.face;
  }
  answer_.counters.faces = answer_.counters.edges = 0;
  for (const FaceRecord& face : map_.faces) {
    if (!face.alive()) continue;
    ++answer_.counters.faces;
    for (const EdgeRecord& edge : face.edges) answer_.counters.edges += map_.is_certain(edge) ? 1u : 0u;
  }
  answer_.counters.submaps = map_.submaps.size();
  return answer_;
}

Mapper::Mapper(const Options& options) : state_(std::make_unique<State>(options)) {}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const Answer& Mapper::process(std::span<const Face> faces, const View& view) {
  return state_->process(faces, view);
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
