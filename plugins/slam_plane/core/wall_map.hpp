// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/wall_evidence.hpp"
#include "slam_plane/core/wall_index.hpp"

namespace hallway::slam_plane {

/// What one submap knows of one wall, from its own frames only.
struct Member {
  Index wall = kNone;           ///< kNone: emptied
  bool in_first_frame = false;  ///< seen by the frame that started the submap
  WallEvidence evidence;
  WallEstimate estimate;  ///< from this evidence alone, in the submap's frame
};

/// One submap's evidence, and where it lies.
struct SubmapRecord {
  Pose2 T_map_submap;
  bool lines_only = false;  ///< its frames left a direction open: ends are no evidence here
  std::uint32_t frames = 0;
  std::uint32_t first_frame_size = 0;  ///< members with in_first_frame
  std::uint32_t epoch = 0;             ///< see WallRecord::epoch
  std::vector<Member> members;
};

/// One wall of the map: what all submaps tell of it together.
struct WallRecord {
  WallEstimate estimate;              ///< map frame
  std::uint32_t count = 0;            ///< observations in all submaps
  std::uint32_t corners[2] = {0, 0};  ///< of an end as a corner, in determined frames
  std::uint32_t against[2] = {0, 0};  ///< observations of more wall beyond the corner
  std::uint32_t astray[2] = {0, 0};   ///< of the end as a corner elsewhere
  std::uint32_t hidden[2] = {0, 0};   ///< of the end where it was seen farthest, hidden by something in front
  double z_low = 0.0;                 ///< means [m]
  double z_high = 0.0;
  std::uint32_t epoch = 0;                 ///< how many gaps there had been when it was first seen; see Gap
  std::uint32_t corner_epoch[2] = {0, 0};  ///< the same of the first observation of an end as a corner
  std::uint64_t last_seen = 0;             ///< iteration
  Index merged_into = kNone;               ///< set when it turned out to be another wall
  std::vector<Membership> memberships;     ///< in the order of joining

  WallEstimate trail;            ///< where it was seen last
  std::uint64_t trail_seen = 0;  ///< iteration of that
  bool trail_is_off = false;     ///< that is not where it is
  std::uint32_t outliers = 0;    ///< observations in a row that did not lie where the wall is
  WallBasis outliers_begin;      ///< where the first of them lay
  bool is_dynamic = false;       ///< it moves; its estimate is where it was seen last, and it is in no submap

  Index active_member = kNone;  ///< its place in the active submap
  WallBasis inactive_basis;     ///< of `inactive`
  WallForm inactive;            ///< what all submaps but the active one tell
  double inactive_reach[2] = {0.0, 0.0};
  bool has_inactive = false;
};

/// Submaps, the walls that link them, and where both lie in the map. One submap is active: it takes up what frames see.
class WallMap {
 public:
  explicit WallMap(const Options& options);

  Index add_submap(const Pose2& T_map_submap, bool lines_only, std::uint32_t epoch);
  Index add_wall(std::uint32_t epoch, std::uint64_t iteration);
  Index join(Index submap, Index wall, bool in_first_frame);

  /// Makes `submap` the one that observe() writes to; kNone: none.
  void activate(Index submap);
  Index active() const { return active_; }

  /// Adds what a frame at T_submap_robot saw to the active submap. `corner`: which ends are evidence. O(1).
  void observe(Index member, const Pose2& T_submap_robot, const AssociatedObservation& observation,
               const bool (&corner)[2]);
  /// Brings a wall's estimate up to date after observe(). O(1).
  void update(Index wall);
  /// Sums a wall up again from all its submaps, after these have moved. O(its submaps).
  void refresh(Index wall);
  void refresh_all();

  /// Takes note of where a wall was seen last.
  void note_trail(Index wall, std::uint64_t iteration, const Pose2& T_map_robot,
                  const AssociatedObservation& observation);
  /// Takes note that a wall was last seen, by note_trail(), where it does not lie. True if that has gone on so long and so far that the wall is dynamic
  /// from now on. A dynamic wall is moved to where it was seen.
  bool note_outlier(Index wall);

  /// Takes back that an end is a corner, in all submaps.
  void revoke_corner(Index wall, int end);

  /// Gives all evidence of `from` to `into`. O(their submaps).
  void merge(Index into, Index from);
  /// The wall that a wall has become.
  Index resolve(Index wall) const;

  /// Moves all submaps from `epoch` on by a step in the map frame. Their walls are to be refreshed. O(map), little of each part.
  void shift(std::uint32_t epoch, const Vec2& step);

  bool is_corner(const WallRecord& wall, int end) const { return wall.corners[end] >= corner_sightings_; }
  const Noise& noise() const { return noise_; }

  template <typename Visit>
  void visit_near(const Vec2& p, Visit&& visit) const {
    index_.visit_near(p, visit);
  }

  std::vector<WallRecord> walls;
  std::vector<SubmapRecord> submaps;

 private:
  void add_form(const Membership& at, const WallBasis& basis, WallForm& form, double (&reach)[2],
                bool& first) const;
  void sum_inactive(WallRecord& wall);
  void make_dynamic(Index wall);
  void place_dynamic(Index wall);
  void deactivate(WallRecord& wall);

  Noise noise_;
  std::uint32_t corner_sightings_;
  WallIndex index_;
  Index active_ = kNone;
};

/// The map as it is reported. A wall is mapped from `min_observations` on. O(map).
Map report_map(const WallMap& map, int min_observations);

}  // namespace hallway::slam_plane
