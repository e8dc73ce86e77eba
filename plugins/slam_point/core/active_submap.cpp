// SPDX-License-Identifier: MIT
#include "slam_point/core/active_submap.hpp"

#include "slam_point/core/alignment.hpp"
#include "slam_point/core/robust_fit.hpp"

namespace hallway::slam_point {

void ActiveSubmap::open(SubmapGraph& graph, Index submap) {
  clear();
  graph.activate(submap);
  const std::vector<Member>& members = graph.submaps[submap].members;
  for (Index m = 0; m < members.size(); ++m) {
    const Member& member = members[m];
    grid_.add(member.mean);
    if (member.count == 0) grid_.remove(m);  // emptied by a merge
    prior_.push_back({member.mean, member.count, member.quality});
  }
}

void ActiveSubmap::begin_frame(const Pose& T_submap_sensor) {
  frames_.push_back({T_submap_sensor, sightings_.size()});
  to_submap_ = PointMotion(T_submap_sensor);
}

void ActiveSubmap::join(SubmapGraph& graph, Index landmark, const Vec3& point, bool first,
                        std::uint64_t activation, double weight) {
  const Vec3 mean = to_submap_ * point;
  const Index member = graph.join(graph.active(), landmark, mean, first);
  grid_.add(mean);
  prior_.push_back({});
  observe(graph, member, point, activation, weight);
}

void ActiveSubmap::observe(SubmapGraph& graph, Index member, const Vec3& point, std::uint64_t activation,
                           double weight) {
  sightings_.push_back({member, point, weight});
  graph.observe(member, to_submap_ * point, activation, weight);
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
        alignment.add(member.mean, sightings_[s].point, pair_weight(member.weight(), sightings_[s].weight));
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
    members[m].quality = prior_[m].quality;
  }
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const std::size_t end = f + 1 < frames_.size() ? frames_[f + 1].first_sighting : sightings_.size();
    const PointMotion to_submap(frames_[f].T_submap_sensor);
    for (std::size_t s = frames_[f].first_sighting; s < end; ++s) {
      members[sightings_[s].member].average(to_submap * sightings_[s].point, sightings_[s].weight);
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
