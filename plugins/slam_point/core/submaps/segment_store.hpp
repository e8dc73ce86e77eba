// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// What one segment knows of one landmark.
struct SegmentMember {
  Index landmark = kNone;
  std::uint32_t count = 0;      ///< observations averaged
  double weight = 0.0;          ///< the sum of their weights
  bool in_first_frame = false;  ///< seen by the frame that started the segment
  Vec3 mean = Vec3::Zero();     ///< submap frame [m]
};

/// Some frames of one submap that saw nearly the same landmarks, as one: they were aligned to each other alone. Since what
/// they saw differs little (where noise has directions, and is from about one side), hardly anything of their evidence is lost in that, and errors of their poses stay inside.
struct Segment {
  Index submap = kNone;
  std::uint32_t frames = 0;
  std::uint32_t first_frame_size = 0;  ///< members with in_first_frame
  std::vector<SegmentMember> members;
  Vec3 origin =
      Vec3::Zero();  ///< where its first frame's sensor was, submap frame [m]; where noise has directions
  std::vector<Mat3>
      informations{};  ///< of each member's mean, submap frame; where noise has directions, else empty
};

/// The evidence of all frames, condensed into segments: what the map is made from when it is asked for. Segments of a submap
/// are taken up again when the same is seen again, so that memory grows with ground covered and not with time.
class SegmentStore {
 public:
  /// A point of the frame that is being added, and its landmark.
  struct Sighting {
    Index landmark = kNone;
    Vec3 point = Vec3::Zero();  ///< sensor frame [m]
    double weight = 1.0;        ///< above 0, as Observation::weight
    double across = 1.0;        ///< likewise, across the ray; only where noise has directions

    RayWeight weights() const { return {weight, across}; }
  };
  using Sightings = std::vector<Sighting>;

  /// `directional`: noise has directions.
  explicit SegmentStore(bool directional = false) : directional_(directional) {}

  /// Adds a frame that `submap` took in. `T_submap_sensor` is where it stood there; within its segment it is aligned anew, to
  /// the segment's means, unless they leave its rotation open (`min_spread_m2`: see Alignment::solve). Landmarks of a frame
  /// are distinct. O(points), but where another segment is looked for: then O(segments of the submap * members).
  void add_frame(Index submap, const Pose& T_submap_sensor, const FitRules& rules,
                 const Sightings& sightings);

  const std::vector<Segment>& segments() const { return segments_; }

  /// Squared distances of all points from the means of their segments, by their weights [m^2].
  double scatter_m2() const { return scatter_m2_; }
  /// Degrees of freedom of scatter_m2(): coordinates less those of means and of poses. Their quotient estimates the variance of
  /// one coordinate of an observation of weight 1.
  double freedom() const { return freedom_; }
  /// Estimated variance of one coordinate of an observation of weight 1 [m^2]; 0 while it rests on too little.
  double noise2_m2() const;
  std::uint64_t observations() const { return observations_; }
  std::uint64_t frames() const { return frames_; }

  void clear();

 private:
  void take_view(const Pose& T_submap_sensor, const Sightings& sightings);
  bool is_from_here(const Segment& segment) const;
  Index choose(Index submap, const Sightings& sightings);
  double overlap(const Segment& segment, std::size_t seen) const;
  Index start(Index submap, const Sightings& sightings);
  void open(Index segment);
  Pose align_directional(const Pose& T_submap_sensor, const FitRules& rules, const Sightings& sightings);
  void average_directional(const Vec3& p, const Vec3& ray, const Sighting& sighting);
  Pose align(const Pose& T_submap_sensor, const FitRules& rules, const Sightings& sightings) const;
  void average(const Pose& T_submap_sensor, bool planar, const Sightings& sightings);

  bool directional_;
  // Of the frame that is being added, where noise has directions; submap frame:
  Vec3 origin_ = Vec3::Zero();  // where its sensor is,
  Vec3 sight_ = Vec3::Zero();   // its mean direction of view, and
  double range_ = 0.0;          // how far points are, the near ones above all
  std::vector<DirectionalPair> pairs_;
  std::vector<Segment> segments_;
  std::vector<std::vector<Index>> of_submap_;  // submap -> its segments
  Index open_ = kNone;
  std::vector<Index> place_;         // landmark -> member of the open segment, valid where placed_ says so
  std::vector<Index> placed_;        // landmark -> the segment that place_ is of, or kNone
  std::vector<std::uint64_t> seen_;  // landmark -> number of the last frame that saw it, counted from 1
  double scatter_m2_ = 0.0;
  double freedom_ = 0.0;
  std::uint64_t observations_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace hallway::slam_point
