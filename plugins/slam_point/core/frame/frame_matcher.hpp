// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/submaps/active_submap.hpp"

namespace hallway::slam_point {

/// Finds which landmark each point of a frame is (thesis 6.2.5 and 6.5.1). Matching is one-to-one: of all pairs within
/// the bound the nearest is taken first, so the order of the points does not matter. A point that the sensor follows is
/// paired with the landmark of its track alone, within the same bounds.
class FrameMatcher {
 public:
  /// `graph`, the map, must outlive it.
  FrameMatcher(const Options& options, const SubmapGraph& graph);

  /// How a frame fits the active submap.
  struct Fit {
    bool solved = false;
    int agreeing = 0;  ///< points that lie on their member up to noise
    Pose T_submap_sensor;
  };

  /// Matches to the active submap's members, from the predicted T_submap_sensor, and fits. What does not agree after the fit is
  /// left unmatched. Where most points that the sensor follows do not agree from there, they are tried without a prediction.
  Fit match_active(const ActiveSubmap& active, const Pose& predicted, Observations& frame);

  /// Where the frame stands by the landmarks of its points' tracks, wherever in the map they are: for when nothing else tells.
  /// False, and no pose, when they do not determine it. The frame's matches are not touched.
  bool locate_by_tracks(const Observations& frame, Pose& T_map_sensor);

  /// Where the frame fits the map best, of all turns of each of `bases` (T_map_sensor) about the sensor's z axis by up to
  /// `max_turn_rad`: for when the prediction failed. Matches within the match bound. Returns how many points agree with the map
  /// there, and puts the pose into `T_map_sensor` when that is not 0. The frame's own matches are not touched.
  int search_turn(const std::vector<Pose>& bases, double max_turn_rad, const Observations& frame,
                  Pose& T_map_sensor);

  /// Makes the landmarks of `frame` the ones taken, for is_marked().
  void mark(const Observations& frame);

  /// Whether a landmark is taken.
  bool is_marked(Index landmark) const { return landmark < taken_.size() && taken_[landmark] != 0; }

  /// Matches what is left of a frame to the map, from T_map_sensor. Landmarks seen from activation `local_since` on lie where the
  /// recent submaps put them, so they are matched within `local_bound_m`; older ones within the map bound.
  void match_map(const Pose& T_map_sensor, std::uint64_t local_since, double local_bound_m,
                 Observations& frame);

  /// Fits the frame to its landmarks' positions, from the guess `T_map_sensor`. False when they do not determine it.
  bool fit_map(const Observations& frame, Pose& T_map_sensor);

  /// Fits the frame to those of its landmarks that are members of `submap`, likewise.
  bool fit_submap(Index submap, const Observations& frame, Pose& T_submap_sensor);

  /// Judges the points that were matched to landmarks not seen since activation `local_since` and do not agree with them.
  /// Where most such matches agree, the map has not drifted: the others are neighbours of what they were taken for, e.g. on
  /// the other side of a thin wall, and are unmatched. Where too few are there to tell drift from neighbours, they are
  /// withheld.
  void drop_outliers(const Pose& T_map_sensor, std::uint64_t local_since, Observations& frame);

  /// Points within Options::agreement() of their landmark's position.
  int count_agreeing(const Observations& frame, const Pose& T_map_sensor) const;

  /// Of the fits to the map.
  FitRules rules() const { return fit_rules(options_.noise_m, graph_.planar); }

 private:
  struct Candidate {
    double d2 = 0.0;
    Index observation = kNone;
    Index landmark = kNone;
    Index member = kNone;  // of the active submap, where candidates are its members

    auto operator<=>(const Candidate&) const = default;
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
  bool fit_pairs(Pose& T);
  const Mat3* information(Index landmark) const {
    return graph_.is_directional() ? &graph_.informations[landmark].whole : nullptr;
  }
  const Mat3* member_information(Index submap, Index member) const {
    return graph_.is_directional() ? &graph_.submaps[submap].informations[member] : nullptr;
  }
  bool agrees(const PointMotion& to_map, const Observation& observation) const;
  void begin();
  void take(const Candidate& candidate, Observations& frame);
  /// Takes the candidates that neither their point nor their landmark has another of, and leaves the others in candidates_, which stand
  /// together by point: what they are does not depend on order, so most of a frame need not be sorted.
  void take_undisputed(Observations& frame);
  void take_nearest_first(Observations& frame);
  void match_members(const ActiveSubmap& active, const Pose& T, double bound, double followed_bound,
                     Observations& frame);
  bool fit_active(const Observations& frame, Pose& T);
  int drop_disagreeing(const Pose& T, Observations& frame);
  double score(const Pose& T_map_sensor, const Observations& frame) const;
  double turn_step(const Observations& frame, double max_turn_rad);

  Fit match_from(const ActiveSubmap& active, const Pose& predicted, double followed_bound,
                 Observations& frame);

  Options options_;
  const SubmapGraph& graph_;
  double agreement2_;  // squared
  double reach_;       // of the grids that are asked
  std::vector<Candidate> candidates_;
  std::vector<Candidate> disputed_;
  std::vector<std::uint8_t> claims_;  // landmark -> candidates, at most two; 0 between calls
  std::vector<std::uint8_t> taken_;   // landmark -> matched in this frame
  std::vector<Index> taken_list_;
  std::vector<Index> outliers_;
  std::vector<Pair> pairs_;
  std::vector<DirectionalPair> directional_pairs_;  // the same, where noise has directions
  std::vector<double> ranges_;
  Observations trial_;
};

}  // namespace hallway::slam_point
