// SPDX-License-Identifier: MIT
#include "em/core/extraction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "em/core/facets.hpp"
#include "em/core/grouped.hpp"
#include "em/core/plane_shape.hpp"
#include "em/core/seams.hpp"

namespace hallway::em {
namespace {

using Places = std::vector<std::uint32_t>;

/// The share of points of its own of each group: that of its patches, by their points. `sizes`: points of each patch.
std::vector<double> shares_of(Mixture& mixture, const std::vector<std::uint32_t>& groups,
                              const std::vector<std::size_t>& sizes) {
  const std::vector<double> of_patches = mixture.exclusive_shares();
  std::vector<double> own(groups.size(), 0.0);
  std::vector<double> all(groups.size(), 0.0);
  for (std::size_t j = 0; j < groups.size(); ++j) {
    const auto points = static_cast<double>(sizes[j]);
    own[groups[j]] += of_patches[j] * points;
    all[groups[j]] += points;
  }
  for (std::size_t j = 0; j < groups.size(); ++j) own[j] = all[j] > 0.0 ? own[j] / all[j] : 1.0;
  return own;
}

std::vector<std::size_t> sizes_of(const std::vector<Places>& lists) {
  std::vector<std::size_t> sizes;
  for (const Places& list : lists) sizes.push_back(list.size());
  return sizes;
}

/// Two ascending lists as one.
Places merged(Places left, const Places& right) {
  if (right.empty()) return left;
  const auto middle = static_cast<std::ptrdiff_t>(left.size());
  left.insert(left.end(), right.begin(), right.end());
  std::inplace_merge(left.begin(), left.begin() + middle, left.end());
  return left;
}

/// Indices of the points given that stand at `places`, ascending.
std::vector<PointIndex> given_at(const CanonicalCloud& cloud, const Places& places) {
  std::vector<PointIndex> indices;
  for (const std::uint32_t i : places) {
    const auto here = cloud.given_at(i);
    indices.insert(indices.end(), here.begin(), here.end());
  }
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// The places of each group, ascending, by its first patch.
std::vector<Places> joined_places(std::vector<Places> of_patches, const std::vector<std::uint32_t>& groups) {
  for (std::size_t j = 0; j < groups.size(); ++j) {
    if (groups[j] == j) continue;
    Places& first = of_patches[groups[j]];
    first = merged(std::move(first), of_patches[j]);
    of_patches[j].clear();
  }
  return of_patches;
}

/// The frame of each group: that of its patch, or through the points of all of its patches.
std::vector<PlaneFrame> frames_of(const CanonicalCloud& cloud, const Mixture& mixture,
                                  const std::vector<std::uint32_t>& groups,
                                  const std::vector<Places>& places) {
  std::vector<PlaneFrame> frames;
  for (const Patch& patch : mixture.patches) frames.push_back(patch.frame);
  for (std::size_t j = 0; j < groups.size(); ++j) {
    const std::uint32_t first = groups[j];
    if (first == j) continue;
    const Vec3 origin = mixture.patches[first].frame.origin;
    Moments moments;
    for (const std::uint32_t i : places[first]) moments.add(cloud.points.at(i) - origin);
    frames[first] = moments.fit(origin).frame;
  }
  return frames;
}

/// Most different points first; of equals the one whose first point comes first in canonical order.
std::vector<std::size_t> by_size(const std::vector<Places>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&places](std::size_t j) { return places[j].empty(); });
  std::sort(order.begin(), order.end(), [&places](std::size_t left, std::size_t right) {
    if (places[left].size() != places[right].size()) return places[left].size() > places[right].size();
    return places[left].front() < places[right].front();
  });
  return order;
}

/// Plane equation, centroid, RMS and outline in the frame of the points given; `patch` is in the canonical
/// one.
void describe(const CanonicalCloud& cloud, const Places& places, const PlaneFrame& patch, Plane& plane) {
  const Vec3 anchor = cloud.frame.to_cloud(patch.origin);
  plane.normal = orient(cloud.frame.axes * patch.normal, anchor);
  plane.offset = plane.normal.dot(anchor);
  const Vec3 normal = cloud.frame.axes.transpose() * plane.normal;
  std::vector<Vec3> members;
  members.reserve(places.size());
  for (const std::uint32_t i : places) members.push_back(cloud.points.at(i));
  const Footprint foot = footprint_of(members, normal, patch.origin);
  plane.centroid = cloud.frame.to_cloud(foot.centroid);
  plane.rms = foot.rms;
  Outline outline = foot.outline;
  outline.frame = {anchor, cloud.frame.axes * outline.frame.u, cloud.frame.axes * outline.frame.v,
                   plane.normal};
  plane.corners = corners_of(outline);
  plane.hull = hull_of(outline);
}

}  // namespace

Extraction extraction_of(const CanonicalCloud& cloud, Mixture& mixture, const AutoOptions& options,
                         std::size_t given, Workers& workers) {
  Extraction result;
  result.labels.assign(given, kNoPlane);
  result.noise = mixture.noise();
  const std::vector<std::uint32_t>& patch_of_point = mixture.labels();
  const std::size_t patches = mixture.patches.size();
  std::vector<Places> of_patches = grouped(
      cloud.points.count, patches, [&](std::size_t i) { return patch_of_point[i]; }, workers);
  const std::vector<std::uint32_t> groups =
      facet_groups(cloud.points, mixture.patches, of_patches, options.bend, workers);
  const std::vector<double> shares = shares_of(mixture, groups, sizes_of(of_patches));
  const std::vector<Places> places = joined_places(std::move(of_patches), groups);
  const std::vector<PlaneFrame> frames = frames_of(cloud, mixture, groups, places);
  const std::vector<std::size_t> order = by_size(places);
  const std::vector<Places> shared = options.seams != 0
                                         ? places_at_seams(cloud.points, mixture, groups, workers)
                                         : std::vector<Places>(places.size());
  result.planes.resize(order.size());
  workers.run(order.size(), [&](std::size_t k, std::size_t) {
    const std::size_t j = order[k];
    Plane& plane = result.planes[k];
    plane.id = k;
    plane.exclusive_share = shares[j];
    describe(cloud, merged(places[j], shared[j]), frames[j], plane);
    for (const std::uint32_t i : places[j]) {
      for (const PointIndex index : cloud.given_at(i)) result.labels[index] = static_cast<std::uint32_t>(k);
    }
  });
  std::vector<Places> members = grouped(
      given, order.size(), [&](std::size_t i) { return result.labels[i]; }, workers);
  for (std::size_t k = 0; k < order.size(); ++k)
    result.planes[k].members = merged(std::move(members[k]), given_at(cloud, shared[order[k]]));
  return result;
}

}  // namespace hallway::em
