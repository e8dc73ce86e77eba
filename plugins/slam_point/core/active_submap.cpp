// SPDX-License-Identifier: MIT
#include "slam_point/core/active_submap.hpp"

#include <limits>

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
  prior_informations_ = graph.submaps[submap].informations;
}

void ActiveSubmap::begin_frame(const Pose& T_submap_sensor) {
  frames_.push_back({T_submap_sensor, sightings_.size()});
  to_submap_ = PointMotion(T_submap_sensor);
}

void ActiveSubmap::join(SubmapGraph& graph, Index landmark, const Vec3& point, bool first,
                        std::uint64_t activation, const RayWeight& weight) {
  const Vec3 mean = to_submap_ * point;
  const Index member = graph.join(graph.active(), landmark, mean, first);
  grid_.add(mean);
  prior_.push_back({});
  if (graph.is_directional()) prior_informations_.emplace_back(Mat3::Zero());
  observe(graph, member, point, activation, weight);
}

void ActiveSubmap::observe(SubmapGraph& graph, Index member, const Vec3& point, std::uint64_t activation,
                           const RayWeight& weight) {
  sightings_.push_back({member, point, weight});
  if (graph.is_directional()) {
    graph.observe(member, to_submap_ * point, activation, weight.along,
                  ray_information(to_submap_.turned(point), weight));
  } else {
    graph.observe(member, to_submap_ * point, activation, weight.along);
  }
  grid_.move(member, graph.submaps[graph.active()].members[member].mean);
}

void ActiveSubmap::withdraw(Index member) {
  grid_.remove(member);
  prior_[member] = {};
  if (!prior_informations_.empty()) prior_informations_[member].setZero();
  std::size_t kept = 0;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const std::size_t begin = frames_[f].first_sighting;
    const std::size_t end = end_of(f);
    frames_[f].first_sighting = kept;
    for (std::size_t s = begin; s < end; ++s) {
      if (sightings_[s].member != member) sightings_[kept++] = sightings_[s];
    }
  }
  sightings_.resize(kept);
}

void ActiveSubmap::realign(SubmapGraph& graph, int sweeps, bool planar, double min_spread_m2) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      if (graph.is_directional()) {
        align_directional(graph, f, planar, min_spread_m2);
      } else {
        align(graph, f, planar, min_spread_m2);
      }
    }
    average(graph);
  }
}

void ActiveSubmap::align(const SubmapGraph& graph, std::size_t frame, bool planar, double min_spread_m2) {
  const std::vector<Member>& members = graph.submaps[graph.active()].members;
  const std::size_t end = end_of(frame);
  Alignment alignment(frames_[frame].T_submap_sensor);
  for (std::size_t s = frames_[frame].first_sighting; s < end; ++s) {
    const Member& member = members[sightings_[s].member];
    alignment.add(member.mean, sightings_[s].point, pair_weight(member.weight(), sightings_[s].weight.along));
  }
  alignment.solve(planar, min_spread_m2, frames_[frame].T_submap_sensor);
}

void ActiveSubmap::align_directional(const SubmapGraph& graph, std::size_t frame, bool planar,
                                     double min_spread_m2) {
  const SubmapRecord& submap = graph.submaps[graph.active()];
  const std::size_t end = end_of(frame);
  pairs_.clear();
  for (std::size_t s = frames_[frame].first_sighting; s < end; ++s) {
    const Member& member = submap.members[sightings_[s].member];
    pairs_.push_back({member.mean, submap.informations[sightings_[s].member], sightings_[s].point,
                      sightings_[s].weight, pair_weight(member.weight(), sightings_[s].weight.along)});
  }
  directional_fit(pairs_, {planar, min_spread_m2, std::numeric_limits<double>::infinity()},
                  frames_[frame].T_submap_sensor);
}

void ActiveSubmap::average(SubmapGraph& graph) const {
  SubmapRecord& submap = graph.submaps[graph.active()];
  std::vector<Member>& members = submap.members;
  submap.informations = prior_informations_;
  for (std::size_t m = 0; m < members.size(); ++m) {
    members[m].mean = prior_[m].mean;
    members[m].count = prior_[m].count;
    members[m].quality = prior_[m].quality;
  }
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const std::size_t end = end_of(f);
    const PointMotion to_submap(frames_[f].T_submap_sensor);
    for (std::size_t s = frames_[f].first_sighting; s < end; ++s) {
      const Sighting& sighting = sightings_[s];
      Member& member = members[sighting.member];
      const Vec3 p = to_submap * sighting.point;
      if (graph.is_directional()) {
        member.average(p, sighting.weight.along,
                       ray_information(to_submap.turned(sighting.point), sighting.weight),
                       submap.informations[sighting.member]);
      } else {
        member.average(p, sighting.weight.along);
      }
    }
  }
}

void ActiveSubmap::clear() {
  grid_.clear();
  frames_.clear();
  sightings_.clear();
  prior_.clear();
  prior_informations_.clear();
}

}  // namespace hallway::slam_point
