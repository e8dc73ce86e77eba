// SPDX-License-Identifier: MIT
#include "slam_point/core/active_submap.hpp"

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {

void ActiveSubmap::open(SubmapGraph& graph, Index submap) {
  clear();
  graph.activate(submap);
  const std::vector<Member>& members = graph.submaps[submap].members;
  for (Index m = 0; m < members.size(); ++m) {
    const Member& member = members[m];
    grid_.add(member.mean);
    if (member.count == 0) grid_.remove(m);  // emptied by a merge
    prior_.push_back({member.mean, member.count});
  }
}

void ActiveSubmap::begin_frame(const Pose& T_submap_sensor) {
  frames_.push_back({T_submap_sensor, sightings_.size()});
}

void ActiveSubmap::join(SubmapGraph& graph, Index landmark, const Vec3& point, bool first,
                        std::uint64_t activation) {
  const Vec3 mean = frames_.back().T_submap_sensor * point;
  const Index member = graph.join(graph.active(), landmark, mean, first);
  grid_.add(mean);
  prior_.push_back({});
  observe(graph, member, point, activation);
}

void ActiveSubmap::observe(SubmapGraph& graph, Index member, const Vec3& point, std::uint64_t activation) {
  sightings_.push_back({member, point});
  graph.observe(member, frames_.back().T_submap_sensor * point, activation);
  grid_.move(member, graph.submaps[graph.active()].members[member].mean);
}

void ActiveSubmap::withdraw(Index member) {
  grid_.remove(member);
  prior_[member] = {};
  std::size_t kept = 0;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const std::size_t begin = frames_[f].first_sighting;
    const std::size_t end = f + 1 < frames_.size() ? frames_[f + 1].first_sighting : sightings_.size();
    frames_[f].first_sighting = kept;
    for (std::size_t s = begin; s < end; ++s) {
      if (sightings_[s].member != member) sightings_[kept++] = sightings_[s];
    }
  }
  sightings_.resize(kept);
}

void ActiveSubmap::realign(SubmapGraph& graph, int sweeps, bool planar, double min_spread_m2) {
  const std::vector<Member>& members = graph.submaps[graph.active()].members;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const std::size_t end = f + 1 < frames_.size() ? frames_[f + 1].first_sighting : sightings_.size();
      Alignment alignment(frames_[f].T_submap_sensor);
      for (std::size_t s = frames_[f].first_sighting; s < end; ++s) {
        const Member& member = members[sightings_[s].member];
        const double n = static_cast<double>(member.count);
        alignment.add(member.mean, sightings_[s].point, n / (n + 1.0));
      }
      alignment.solve(planar, min_spread_m2, frames_[f].T_submap_sensor);
    }
    average(graph);
  }
}

void ActiveSubmap::average(SubmapGraph& graph) const {
  std::vector<Member>& members = graph.submaps[graph.active()].members;
  for (std::size_t m = 0; m < members.size(); ++m) {
    members[m].mean = prior_[m].mean;
    members[m].count = prior_[m].count;
  }
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const std::size_t end = f + 1 < frames_.size() ? frames_[f + 1].first_sighting : sightings_.size();
    for (std::size_t s = frames_[f].first_sighting; s < end; ++s) {
      Member& member = members[sightings_[s].member];
      ++member.count;
      member.mean += (frames_[f].T_submap_sensor * sightings_[s].point - member.mean) /
                     static_cast<double>(member.count);
    }
  }
}

void ActiveSubmap::clear() {
  grid_.clear();
  frames_.clear();
  sightings_.clear();
  prior_.clear();
}

}  // namespace hallway::slam_point
