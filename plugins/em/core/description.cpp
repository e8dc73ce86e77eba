// SPDX-License-Identifier: MIT
#include "em/core/description.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hallway::em {
namespace {

std::vector<std::uint32_t> nearest_planes(const SortedCloud& cloud, const std::vector<Candidate>& planes) {
  std::vector<std::uint32_t> nearest(cloud.points.size(), kNoPlane);
  std::vector<double> least(cloud.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t j = 0; j < planes.size(); ++j) {
    for (const std::uint32_t i : planes[j].members) {
      const double distance = std::abs(planes[j].fit.distance(cloud.points[i]));
      if (distance >= least[i]) continue;
      least[i] = distance;
      nearest[i] = static_cast<std::uint32_t>(j);
    }
  }
  return nearest;
}

Plane plane_of(const SortedCloud& cloud, const Candidate& candidate, const std::vector<std::uint32_t>& uses) {
  std::vector<Vec3> members;
  for (const std::uint32_t i : candidate.members) members.push_back(cloud.points[i] + cloud.origin);
  Plane plane;
  plane.centroid = candidate.fit.centroid + cloud.origin;
  plane.normal = orient(candidate.fit.normal, plane.centroid);
  plane.offset = plane.normal.dot(plane.centroid);
  const Outline outline = outline_of(members, plane.normal, plane.centroid);
  plane.corners = corners_of(outline);
  plane.hull = hull_of(outline);
  plane.rms = candidate.fit.rms();
  plane.exclusive_share = exclusive_share(candidate, uses);
  return plane;
}

double noise_of_labelled(const SortedCloud& cloud, const std::vector<Candidate>& planes,
                         const std::vector<std::uint32_t>& nearest) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i] == kNoPlane) continue;
    squares += std::pow(planes[nearest[i]].fit.distance(cloud.points[i]), 2);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

Extraction describe(const SortedCloud& cloud, const std::vector<Candidate>& planes) {
  const std::vector<std::uint32_t> nearest = nearest_planes(cloud, planes);
  const std::vector<std::uint32_t> uses = count_uses(planes, cloud.points.size());
  std::vector<std::vector<PointIndex>> members(planes.size());
  for (std::size_t i = 0; i < cloud.place_of.size(); ++i) {
    const std::uint32_t place = cloud.place_of[i];
    if (place != kNoPlane && nearest[place] != kNoPlane)
      members[nearest[place]].push_back(static_cast<PointIndex>(i));
  }
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return members[a].size() > members[b].size(); });
  Extraction extraction;
  extraction.labels.assign(cloud.place_of.size(), kNoPlane);
  extraction.noise = noise_of_labelled(cloud, planes, nearest);
  for (const std::size_t j : order) {
    if (members[j].empty()) continue;
    Plane plane = plane_of(cloud, planes[j], uses);
    plane.id = extraction.planes.size();
    plane.members = std::move(members[j]);
    for (const PointIndex i : plane.members) extraction.labels[i] = static_cast<std::uint32_t>(plane.id);
    extraction.planes.push_back(std::move(plane));
  }
  return extraction;
}

}  // namespace hallway::em
