// SPDX-License-Identifier: MIT
#include "slam_plane/core/submap_neighbourhood.hpp"

#include <utility>

namespace hallway::slam_plane {
namespace {

/// A breadth-first walk from submap to submap.
class Walk {
 public:
  Walk(const WallMap& map, std::size_t most)
      : map_(map), most_(most), met_(map.submaps.size(), false), looked_at_(map.walls.size(), false) {}

  void from(Index submap) {
    meet(submap);
    for (; next_ < found_.submaps.size(); ++next_) {
      for (const Member& member : map_.submaps[found_.submaps[next_]].members) {
        if (member.wall != kNone && !looked_at_[member.wall]) look_at(member.wall);
      }
    }
  }

  SubmapNeighbourhood found() && { return std::move(found_); }

 private:
  void meet(Index submap) {
    if (met_[submap] || found_.submaps.size() >= most_) return;
    met_[submap] = true;
    found_.submaps.push_back(submap);
  }

  void look_at(Index wall) {
    looked_at_[wall] = true;
    found_.walls.push_back(wall);
    const std::vector<Membership>& at = map_.walls[wall].memberships;
    for (auto m = at.rbegin(); m != at.rend() && found_.submaps.size() < most_; ++m) meet(m->submap);
  }

  const WallMap& map_;
  std::size_t most_;
  std::vector<bool> met_;
  std::vector<bool> looked_at_;
  std::size_t next_ = 0;
  SubmapNeighbourhood found_;
};

}  // namespace

SubmapNeighbourhood neighbourhood(const WallMap& map, std::size_t most) {
  Walk walk(map, most);
  if (map.active() != kNone) walk.from(map.active());
  return std::move(walk).found();
}

SubmapNeighbourhood whole_map(const WallMap& map) {
  Walk walk(map, map.submaps.size());
  if (map.active() != kNone) walk.from(map.active());
  for (Index s = 0; s < map.submaps.size(); ++s) walk.from(s);
  return std::move(walk).found();
}

}  // namespace hallway::slam_plane
