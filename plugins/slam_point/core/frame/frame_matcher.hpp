// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/submaps/active_submap.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// A usable point of the current frame and what it was taken for.
struct Observation {
  Vec3 point = Vec3::Zero();  ///< sensor frame [m]
  std::size_t given = 0;      ///< its place among the points given
  Index landmark = kNone;
  Index member = kNone;   ///< of the active submap, where it was matched to one of its members
  bool withheld = false;  ///< neither a known landmark nor a new one: this frame cannot tell
  Index moving =
      kNone;  ///< where `landmark` is none: one that moves, or has left its place, and that it follows
  double weight =
      1.0;  ///< (noise_m / noise at its range)^2: what it counts for beside a point without range noise
  double across = 1.0;       ///< the same of the noise across its ray, where noise has directions
  TrackId track = kNoTrack;  ///< under which the sensor follows it; kNoTrack: its place tells what it is
  Index expected = kNone;    ///< the landmark of its track; kNone for a new track

  RayWeight weights() const { return {weight, across}; }
  bool is_followed() const { return track != kNoTrack; }
};

/// Finds which landmark each point of a frame is (thesis 6.2.5 and 6.5.1). Matching is one-to-one: of all pairs within
/// the bound the nearest is taken first, so the order of the points does not matter. A point that the sensor follows is
/// paired with the landmark of its track alone, within the same bounds.
class FrameMatcher {
 public:
  explicit FrameMatcher(const Options& options);

  /// How a frame fits the active submap.
  struct Fit {
    bool solved = false;
    int agreeing = 0;  ///< points that lie on their member up to noise
    Pose T_submap_sensor;
  };

  /// Matches to the active submap's members, from the predicted T_submap_sensor, and fits. What does not agree after the fit is
  /// left unmatched. Where most points that the sensor follows do not agree from there, they are tried without a prediction.
  Fit match_active(const SubmapGraph& graph, const ActiveSubmap& active, const Pose& predicted, bool planar,
                   std::vector<Observation>& frame);

  /// Where the frame stands by the landmarks of its points' tracks, wherever in the map they are: for when nothing else tells.
  /// False, and no pose, when they do not determine it. The frame's matches are not touched.
  bool locate_by_tracks(const SubmapGraph& graph, bool planar, const std::vector<Observation>& frame,
                        Pose& T_map_sensor);

  /// Where the frame fits the map best, of all turns of each of `bases` (T_map_sensor) about the sensor's z axis by up to
  /// `max_turn_rad`: for when the prediction failed. Matches within the match bound. Returns how many points agree with the map
  /// there, and puts the pose into `T_map_sensor` when that is not 0. The frame's own matches are not touched.
  int search_turn(const SubmapGraph& graph, const std::vector<Pose>& bases, double max_turn_rad, bool planar,
                  const std::vector<Observation>& frame, Pose& T_map_sensor);

  /// Makes the landmarks of `frame` the ones taken, for is_marked().
  void mark(const SubmapGraph& graph, const std::vector<Observation>& frame);

  /// Whether a landmark is taken.
  bool is_marked(Index landmark) const { return landmark < taken_.size() && taken_[landmark] != 0; }

  /// Matches what is left of a frame to the map, from T_map_sensor. Landmarks seen from activation `local_since` on lie where the
  /// recent submaps put them, so they are matched within `local_bound_m`; older ones within the map bound.
  void match_map(const SubmapGraph& graph, const Pose& T_map_sensor, std::uint64_t local_since,
                 double local_bound_m, std::vector<Observation>& frame);

  /// Fits the frame to its landmarks' positions, from the guess `T_map_sensor`. False when they do not determine it.
  bool fit_map(const SubmapGraph& graph, const std::vector<Observation>& frame, bool planar,
               Pose& T_map_sensor);

  /// Fits the frame to those of its landmarks that are members of `submap`, likewise.
  bool fit_submap(const SubmapGraph& graph, Index submap, const std::vector<Observation>& frame, bool planar,
                  Pose& T_submap_sensor);

  /// Judges the points that were matched to landmarks not seen since activation `local_since` and do not agree with them.
  /// Where most such matches agree, the map has not drifted: the others are neighbours of what they were taken for, e.g. on
  /// the other side of a thin wall, and are unmatched. Where too few are there to tell drift from neighbours, they are
  /// withheld.
  void drop_strays(const SubmapGraph& graph, const Pose& T_map_sensor, std::uint64_t local_since,
                   std::vector<Observation>& frame);

  /// Points within agreement() of their landmark's position.
  int count_agreeing(const SubmapGraph& graph, const std::vector<Observation>& frame,
                     const Pose& T_map_sensor) const;

  /// A residual up to here is noise, for a point of weight 1 [m].
  double agreement() const { return agreement_; }

  FitRules rules(bool planar) const;

 private:
  struct Candidate {
    double d2 = 0.0;
    Index observation = kNone;
    Index landmark = kNone;
    Index member = kNone;  // of the active submap, where candidates are its members
  };

  void begin_pairs() {
    pairs_.clear();
    directional_pairs_.clear();
  }
  /// `known`: the information of the reference, in its frame; null where noise has no directions.
  void add_pair(const Vec3& reference, double reference_weight, const Mat3* known,
                const Observation& observation) {
    const double weight = pair_weight(reference_weight, observation.weight);
    if (known == nullptr) {
      pairs_.push_back({reference, observation.point, weight, observation.weight});
    } else {
      directional_pairs_.push_back({reference, *known, observation.point, observation.weights(), weight});
    }
  }
  bool fit_pairs(bool planar, Pose& T);
  const Mat3* information(const SubmapGraph& graph, Index landmark) const {
    return directional_ ? &graph.informations[landmark].whole : nullptr;
  }
  const Mat3* member_information(const SubmapGraph& graph, Index submap, Index member) const {
    return directional_ ? &graph.submaps[submap].informations[member] : nullptr;
  }
  bool agrees(const SubmapGraph& graph, const PointMotion& to_map, const Observation& observation) const;
  void begin(const SubmapGraph& graph);
  void take(const Candidate& candidate, std::vector<Observation>& frame);
  /// Takes the candidates that neither their point nor their landmark has another of, and leaves the others in candidates_, which stand
  /// together by point: what they are does not depend on order, so most of a frame need not be sorted.
  void take_undisputed(std::vector<Observation>& frame);
  void take_nearest_first(std::vector<Observation>& frame);
  void match_members(const SubmapGraph& graph, const ActiveSubmap& active, const Pose& T, double bound,
                     double followed_bound, std::vector<Observation>& frame);
  bool fit_active(const SubmapGraph& graph, const std::vector<Observation>& frame, bool planar, Pose& T);
  int drop_disagreeing(const SubmapGraph& graph, const Pose& T, std::vector<Observation>& frame);
  double score(const SubmapGraph& graph, const Pose& T_map_sensor,
               const std::vector<Observation>& frame) const;
  double turn_step(const std::vector<Observation>& frame, double max_turn_rad);

  Fit match_from(const SubmapGraph& graph, const ActiveSubmap& active, const Pose& predicted, bool planar,
                 double followed_bound, std::vector<Observation>& frame);

  Options options_;
  bool directional_;  // noise has directions
  double agreement_;
  double reach_;  // of the grids that are asked
  std::vector<Candidate> candidates_;
  std::vector<Candidate> disputed_;
  std::vector<std::uint8_t> claims_;  // landmark -> candidates, at most two; 0 between calls
  std::vector<std::uint8_t> taken_;   // landmark -> matched in this frame
  std::vector<Index> taken_list_;
  std::vector<Index> strays_;
  std::vector<Pair> pairs_;
  std::vector<DirectionalPair> directional_pairs_;  // the same, where noise has directions
  std::vector<double> ranges_;
  std::vector<Observation> trial_;
};

}  // namespace hallway::slam_point
