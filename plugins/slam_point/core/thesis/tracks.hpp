// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/thesis/history.hpp"

namespace hallway::slam_point::thesis {

/// One landmark (thesis 6.2.2).
struct Track {
  History history;
  Iteration first = 0;  ///< when it was seen first; 0: with the frame that began the map
  Iteration last = 0;   ///< and last
  Vec3 first_seen = Vec3::Zero();
  std::uint32_t observations = 0;
  Vec3 position = Vec3::Zero();  ///< map frame [m]; while level is 0, by its first observation alone
  int level = 0;  ///< of the group that mapped it: 0 none, 1 temporary, 2 final, 3 made when a point was gone
  Index home = kNone;         ///< the group that maps it
  std::vector<Index> groups;  ///< those that it is a member of, in the order of creation
  Index merged_into = kNone;  ///< set when it turned out to be another one

  /// Whether its position tells where the sensor is.
  bool is_mapped() const { return level > 0 || first == 0; }
};

/// All landmarks, and which of them the last iterations saw (thesis 6.2.3 and 6.5.1).
class Tracks {
 public:
  /// `kept`: iterations whose observations are kept; `reach_m`: the largest distance visit_near() is asked for [m].
  Tracks(Iteration kept, double reach_m, IndexKind index = IndexKind::grid)
      : kept_(kept), grid_(index, reach_m), chart_(kept) {}

  /// Begins an iteration, and drops what is older than the kept ones. `planar`: landmarks that are placed from now on are in the plane z = 0.
  /// O(points in view).
  void begin_iteration(Iteration iteration, bool planar = false);

  /// Makes a landmark that this iteration sees first, at `position` in the map [m]. Call see() next.
  Index add(const Vec3& position);

  /// Notes that this iteration sees a landmark at `point` in the sensor frame [m].
  void see(Index track, const Vec3& point);

  /// Moves a landmark in the map.
  void place(Index track, const Vec3& position);

  /// Gives the newer one's observations to the older one; the newer is found no more.
  void merge(Index into, Index from);

  /// The landmarks seen in any of the iterations [first, last], each once, by first encounter. O(sightings). Valid until the next call.
  const std::vector<Index>& seen_between(Iteration first, Iteration last);

  /// Calls visit(track) for each landmark near p (map frame) and some farther ones.
  template <typename Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    grid_.visit_near(p, visit);
  }

  /// The landmark that a landmark turned out to be.
  Index resolve(Index track) const;

  Track& operator[](Index track) { return tracks_[track]; }
  const Track& operator[](Index track) const { return tracks_[track]; }
  Index size() const { return static_cast<Index>(tracks_.size()); }
  Iteration now() const { return now_; }

 private:
  Vec3 in_plane(const Vec3& position) const {
    return planar_ ? Vec3(position.x(), position.y(), 0.0) : position;
  }

  Iteration kept_;
  Iteration now_ = 0;
  bool planar_ = false;
  std::vector<Track> tracks_;
  PointIndex grid_;
  std::vector<std::vector<Index>> chart_;  // by iteration modulo kept_
  std::vector<std::uint32_t> listed_;      // track -> the last enumeration that listed it
  std::uint32_t listing_ = 0;
  std::vector<Index> list_;
};

}  // namespace hallway::slam_point::thesis
