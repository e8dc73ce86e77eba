// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/active_submap.hpp"

namespace hallway::slam_point {

void ActiveSubmap::open(Index submap) {
  clear();
  graph_.activate(submap);
  const std::vector<Member>& members = graph_.submaps[submap].members;
  for (Index m = 0; m < members.size(); ++m) {
    const Member& member = members[m];
    grid_.add(member.mean);
    if (member.count == 0) grid_.remove(m);  // emptied by a merge
    prior_.push_back({member.mean, member.count, member.quality});
  }
  prior_informations_ = graph_.submaps[submap].informations;
}

void ActiveSubmap::begin_frame(const Pose& T_submap_sensor) {
  frames_.push_back({T_submap_sensor, sightings_.size()});
  to_submap_ = PointMotion(T_submap_sensor);
}

void ActiveSubmap::join(Index landmark, const Vec3& point, bool first, std::uint64_t activation,
                        const RayWeight& weight) {
  const Vec3 mean = to_submap_ * point;
  const Index member = graph_.join(graph_.active(), landmark, mean, first);
  grid_.add(mean);
  prior_.push_back({});
  if (graph_.is_directional()) prior_informations_.emplace_back(Mat3::Zero());
  observe(member, point, activation, weight);
}

void ActiveSubmap::observe(Index member, const Vec3& point, std::uint64_t activation,
                           const RayWeight& weight) {
  sightings_.push_back({member, point, weight.along});
  if (graph_.is_directional()) {
    across_.push_back(weight.across);
    graph_.observe(member, to_submap_ * point, activation, weight.along,
                   ray_information(to_submap_.turned(point), weight));
  } else {
    graph_.observe(member, to_submap_ * point, activation, weight.along);
  }
  grid_.move(member, graph_.submaps[graph_.active()].members[member].mean);
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
      if (sightings_[s].member == member) continue;
      if (!across_.empty()) across_[kept] = across_[s];
      sightings_[kept++] = sightings_[s];
    }
  }
  sightings_.resize(kept);
  if (!across_.empty()) across_.resize(kept);
}

void ActiveSubmap::realign(int sweeps, const FitRules& rules) {
  for (int i = 0; i < sweeps; ++i) {
    if (graph_.is_directional()) {
      sweep_directional(rules);
    } else {
      sweep(rules);
    }
  }
}

void ActiveSubmap::sweep(const FitRules& rules) {
  std::vector<Member>& members = graph_.submaps[graph_.active()].members;
  references_.clear();
  sums_.clear();
  for (std::size_t m = 0; m < members.size(); ++m) {
    const double known = static_cast<double>(prior_[m].count) * prior_[m].quality;
    references_.push_back({members[m].mean, members[m].weight()});
    sums_.push_back({known * prior_[m].mean, known, prior_[m].count});
  }
  for (std::size_t f = 0; f < frames_.size(); ++f) align_and_sum(f, rules);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Sum& sum = sums_[m];
    members[m].count = sum.count;
    if (sum.count == 0) continue;
    members[m].quality = sum.weight / static_cast<double>(sum.count);
    members[m].mean = sum.place / sum.weight;
  }
}

void ActiveSubmap::sweep_directional(const FitRules& rules) {
  for (std::size_t f = 0; f < frames_.size(); ++f) align_directional(f, rules);
  average_directional();
}

/// Aligns a frame to the members as the sweep found them, and adds it to what they become.
void ActiveSubmap::align_and_sum(std::size_t frame, const FitRules& rules) {
  const std::size_t begin = frames_[frame].first_sighting;
  const std::size_t end = end_of(frame);
  Pose& T_submap_sensor = frames_[frame].T_submap_sensor;
  Alignment alignment(T_submap_sensor);
  for (std::size_t s = begin; s < end; ++s) {
    const Sighting& sighting = sightings_[s];
    const Reference& reference = references_[sighting.member];
    alignment.add(reference.mean, sighting.point, pair_weight(reference.weight, sighting.weight));
  }
  alignment.solve(rules, T_submap_sensor);
  const PointMotion to_submap(T_submap_sensor);
  for (std::size_t s = begin; s < end; ++s) {
    const Sighting& sighting = sightings_[s];
    Sum& sum = sums_[sighting.member];
    sum.place += sighting.weight * (to_submap * sighting.point);
    sum.weight += sighting.weight;
    ++sum.count;
  }
}

void ActiveSubmap::align_directional(std::size_t frame, const FitRules& rules) {
  const SubmapRecord& submap = graph_.submaps[graph_.active()];
  const std::size_t end = end_of(frame);
  pairs_.clear();
  for (std::size_t s = frames_[frame].first_sighting; s < end; ++s) {
    const Member& member = submap.members[sightings_[s].member];
    pairs_.push_back({member.mean, submap.informations[sightings_[s].member], sightings_[s].point,
                      weight_of(s), pair_weight(member.weight(), sightings_[s].weight)});
  }
  directional_fit(pairs_, rules.without_outliers(), frames_[frame].T_submap_sensor);
}

void ActiveSubmap::average_directional() const {
  SubmapRecord& submap = graph_.submaps[graph_.active()];
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
      member.average(p, sighting.weight, ray_information(to_submap.turned(sighting.point), weight_of(s)),
                     submap.informations[sighting.member]);
    }
  }
}

void ActiveSubmap::clear() {
  grid_.clear();
  frames_.clear();
  sightings_.clear();
  across_.clear();
  prior_.clear();
  prior_informations_.clear();
}

}  // namespace hallway::slam_point
