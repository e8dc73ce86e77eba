// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// The submap that is being filled: finds its members near a place, and keeps the frames it was filled from until it
/// closes, so that they can be aligned again to what they became together.
class ActiveSubmap {
 public:
  /// `graph` must outlive it. `reach_m`: the largest distance that visit_members_near() is asked for [m].
  ActiveSubmap(SubmapGraph& graph, double reach_m, IndexKind index = IndexKind::grid)
      : graph_(graph), grid_(index, reach_m) {}

  /// Takes up `submap`, new or old, and makes it the graph's active one.
  void open(Index submap);

  /// Begins a frame; T_submap_sensor is where it was aligned.
  void begin_frame(const Pose& T_submap_sensor);

  /// Adds a new member for `landmark`, seen at `point` by the frame begun last. `first` says that this frame starts the submap.
  void join(Index landmark, const Vec3& point, bool first, std::uint64_t activation,
            const RayWeight& weight = {});

  /// Averages an observation of the frame begun last into a member. `weight`: see Observation::weights(); across the ray only
  /// where the graph's noise has directions.
  void observe(Index member, const Vec3& point, std::uint64_t activation, const RayWeight& weight = {});

  /// Takes a member out of the kept frames, so that none is aligned to it again. O(kept sightings).
  void withdraw(Index member);

  /// Aligns each kept frame to the members' means again and averages anew, `sweeps` times; what the submap knew when it
  /// was opened counts as it did. A frame whose pose that leaves open keeps its alignment.
  void realign(int sweeps, const FitRules& rules);

  /// Calls visit(member) for each member near p (submap frame) and some farther ones.
  template <typename Visit>
  void visit_members_near(const Vec3& p, Visit&& visit) const {
    grid_.visit_near(p, visit);
  }

  std::size_t frames() const { return frames_.size(); }

  void clear();

 private:
  struct Frame {
    Pose T_submap_sensor;
    std::size_t first_sighting = 0;
  };
  struct Sighting {
    Index member = kNone;
    Vec3 point = Vec3::Zero();  // sensor frame
    double weight = 1.0;        // along its ray, or in all directions
  };
  struct Prior {
    Vec3 mean = Vec3::Zero();
    std::uint32_t count = 0;
    double quality = 1.0;
  };

  /// What a sweep needs of a member, by itself so that it lies close together.
  struct Reference {
    Vec3 mean = Vec3::Zero();
    double weight = 0.0;
  };
  /// What the sightings of a member come to.
  struct Sum {
    Vec3 place = Vec3::Zero();  // weighted
    double weight = 0.0;
    std::uint32_t count = 0;
  };

  std::size_t end_of(std::size_t frame) const {
    return frame + 1 < frames_.size() ? frames_[frame + 1].first_sighting : sightings_.size();
  }
  RayWeight weight_of(std::size_t sighting) const { return {sightings_[sighting].weight, across_[sighting]}; }
  void sweep(const FitRules& rules);
  void sweep_directional(const FitRules& rules);
  void align_and_sum(std::size_t frame, const FitRules& rules);
  void align_directional(std::size_t frame, const FitRules& rules);

  void average_directional() const;

  SubmapGraph& graph_;
  PointIndex grid_;  // of members' means
  std::vector<Frame> frames_;
  PointMotion to_submap_{Pose{}};  // of the frame begun last
  std::vector<Sighting> sightings_;
  std::vector<double> across_;  // of each sighting, where noise has directions: its weight across the ray
  std::vector<Reference> references_;     // by member
  std::vector<Sum> sums_;                 // likewise
  std::vector<Prior> prior_;              // by member: what was known at open()
  std::vector<Mat3> prior_informations_;  // likewise, where noise has directions
  std::vector<DirectionalPair> pairs_;
};

}  // namespace hallway::slam_point
