// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/submaps/pose_motions.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Index of a landmark or of a submap; also its public id.
using Index = std::uint32_t;
inline constexpr Index kNone = 0xffffffffu;

/// What one submap knows of one landmark: evidence from its own frames only, never from the map.
struct Member {
  Index landmark = kNone;
  std::uint32_t count = 0;      ///< observations averaged; 0: emptied by a merge
  bool in_first_frame = false;  ///< seen by the frame that started the submap
  Vec3 mean = Vec3::Zero();     ///< weighted by each observation's weight, submap frame [m]
  double quality = 1.0;         ///< mean weight of its observations (Observation::weight)

  /// What its mean counts for: the sum of its observations' weights.
  double weight() const { return static_cast<double>(count) * quality; }
  /// Averages an observation of a weight above 0 into the mean. `information` and what the mean counts for, `known`: where noise has
  /// directions, in the submap frame.
  void average(const Vec3& p, double observation_weight, const Mat3& information, Mat3& known);
  /// Averages an observation of a weight above 0 into the mean.
  [[gnu::always_inline]] void average(const Vec3& p, double observation_weight) {
    const double whole = weight() + observation_weight;
    ++count;
    quality = whole / static_cast<double>(count);
    mean += (observation_weight / whole) * (p - mean);
  }
};

/// Where a landmark stands in a submap.
struct Membership {
  Index submap = kNone;
  Index member = kNone;
};

/// One submap's evidence.
struct SubmapRecord {
  std::vector<Member> members;
  std::uint32_t first_frame_size = 0;  ///< members with in_first_frame
  Index part = 0;                      ///< of the map; kNone when it was given up
  bool held = false;                   ///< its pose is the frame of its part: it stays where it is
  std::vector<Mat3>
      informations{};  ///< of each member's mean, submap frame; where noise has directions, else empty
};

/// What a landmark's place counts for where noise has directions, in units of 1 / noise_m^2, map frame.
struct LandmarkInformation {
  Mat3 whole = Mat3::Zero();    ///< of all submaps
  Mat3 settled = Mat3::Zero();  ///< of all but the active one
};

/// One landmark: the mean of its places in all submaps, by their weights.
struct LandmarkRecord {
  Vec3 position = Vec3::Zero();       ///< map frame [m]
  std::uint32_t count = 0;            ///< observations in all submaps
  std::uint64_t last_activation = 0;  ///< which activation of a submap saw it last
  double weight = 0.0;                ///< of its members in all submaps
  Vec3 settled_sum = Vec3::Zero();    ///< weighted sum of positions over all submaps but the active one
  std::uint32_t settled_count = 0;
  double settled_weight = 0.0;
  Index active_member = kNone;  ///< its place in the active submap
  Index merged_into = kNone;    ///< set when it turned out to be another landmark
  Index part = 0;               ///< of the map: whose frame `position` is in; kNone when it was given up
  bool moving = false;          ///< found to move: no submap holds it, and none will
  std::vector<Membership> memberships;  ///< in the order of joining
};

/// Submaps, the landmarks that link them, and where both lie in the map.
///
/// The map has parts: each a map of its own, in a frame of its own, whose place among the others is not known. One of them is the
/// current one: what is added belongs to it, and what is near a place is looked for in it.
class SubmapGraph {
 public:
  /// `reach_m`: the largest distance that visit_landmarks_near() is asked for [m]. `directional_inlier_m`
  /// above 0: noise has directions, so that means are weighted by matrices; and where submaps are placed together, evidence that lies
  /// farther than this from its landmark, in units of its own noise times noise_m, counts for less [m].
  explicit SubmapGraph(double reach_m, IndexKind index = IndexKind::grid, double directional_inlier_m = 0.0)
      : grid_(index, reach_m), directional_inlier_(directional_inlier_m) {}

  /// Whether noise has directions.
  bool is_directional() const { return directional_inlier_ > 0.0; }
  double directional_inlier_m() const { return directional_inlier_; }

  /// A submap of the current part. The first of all is held.
  Index add_submap(const Pose& T_map_submap);
  /// A landmark that no submap holds yet, at `position` in the map frame [m].
  Index add_landmark(const Vec3& position, std::uint64_t activation);
  /// Makes the landmark a member of the submap with no evidence yet, at `mean` in the submap frame. Returns the member's index.
  Index join(Index submap, Index landmark, const Vec3& mean, bool in_first_frame);

  /// Makes `submap` the active one: its share in its landmarks changes with every frame.
  void activate(Index submap);
  /// Ends that: the active submap's means stay as they are until it is opened again.
  void deactivate();
  Index active() const { return active_; }

  /// Takes note that submaps have moved, the active one perhaps among them, and sums up the landmarks of those that have.
  void take_moved(const std::vector<Index>& moved_landmarks);

  /// Averages `p` (submap frame, metres) into a member of the active submap, and moves its landmark accordingly. O(1).
  /// `weight`: see Observation::weight.
  void observe(Index member, const Vec3& p, std::uint64_t activation, double weight = 1.0);
  /// The same where noise has directions: `information` of p, submap frame.
  void observe(Index member, const Vec3& p, std::uint64_t activation, double weight, const Mat3& information);

  /// Sums a landmark up again from all its submaps, after their poses or means have changed. O(its submaps).
  void resum(Index landmark);

  /// Where the evidence puts a landmark that has some, summed up anew [m, map frame]. O(its submaps).
  Vec3 mean_position(Index landmark) const;

  /// One submap's evidence of a landmark, in the map frame, where noise has directions.
  struct Evidence {
    Vec3 place = Vec3::Zero();
    Mat3 information = Mat3::Zero();
  };
  Evidence evidence(const Membership& at, const Pose& T_map_submap) const;

  /// Gives all evidence of `from` to `into`, which is then one landmark; `from` keeps none and is found no more.
  /// Not while the active submap holds both.
  void merge(Index into, Index from);

  /// What a landmark has become by merges.
  Index survivor(Index landmark) const {
    while (landmarks[landmark].merged_into != kNone) landmark = landmarks[landmark].merged_into;
    return landmark;
  }

  /// Takes a landmark that moves out of all submaps: their places for it stay, empty. It is found no more.
  void withdraw(Index landmark);

  /// Calls visit(landmark) for each landmark of the current part near p and some farther ones; see PointIndex::visit_near.
  template <typename Visit>
  void visit_landmarks_near(const Vec3& p, Visit&& visit) const {
    visit_part_landmarks_near(part_, p, visit);
  }

  /// The same in any part; p is in its frame.
  template <typename Visit>
  void visit_part_landmarks_near(Index part, const Vec3& p, Visit&& visit) const {
    grid_.visit_near(p, [&](Index l) {
      if (landmarks[l].part == part) visit(l);
    });
  }

  /// The landmark that `landmark` probably is: of the others within `bound_m`, which is at most the reach, the nearest that does not differ; of equally
  /// near ones the oldest. kNone if there is none. differs(other) tells two that are known to be two.
  template <typename Differs>
  Index find_duplicate(Index landmark, double bound_m, Differs&& differs) const {
    const Vec3& place = landmarks[landmark].position;
    double nearest2 = bound_m * bound_m;
    Index duplicate = kNone;
    visit_landmarks_near(place, [&](Index other) {
      const double d2 = (landmarks[other].position - place).squaredNorm();
      if (other == landmark || landmarks[other].count == 0 || d2 > nearest2) return;
      if ((d2 == nearest2 && duplicate < other) || differs(other)) return;
      nearest2 = d2;
      duplicate = other;
    });
    return duplicate;
  }

  /// The part that the sensor is in.
  Index part() const { return part_; }
  /// Makes a part the current one. Not while a submap is active.
  void set_part(Index part) { part_ = part; }

  /// Gives a submap up for good, with the landmarks that no other submap holds. Not the active one.
  void drop(Index submap);
  /// Landmarks that drop() gave up so far.
  std::size_t dropped_landmarks() const { return dropped_; }

  void clear();

  std::vector<LandmarkRecord> landmarks;
  std::vector<SubmapRecord> submaps;
  std::vector<Pose> poses;  ///< T_map_submap of each submap
  std::vector<LandmarkInformation>
      informations;     ///< of each landmark; where noise has directions, else empty
  bool planar = false;  ///< all evidence is in the plane z = 0: only x, y and yaw of a pose are unknown

 private:
  void sum_up(Index landmark);
  void sum_up_directional(Index landmark);

  PointIndex grid_;
  double directional_inlier_;
  Index active_ = kNone;
  Index part_ = 0;
  std::size_t dropped_ = 0;
  PointMotion from_active_{Pose{}};  // into the map
  PoseMotions motions_;              // of the round of sums under way
};

}  // namespace hallway::slam_point
