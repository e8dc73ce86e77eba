// SPDX-License-Identifier: MIT
#include "planes/overlap.hpp"

#include <algorithm>
#include <map>

namespace hallway::planes {

std::vector<std::size_t> places_of_points(const Truth& truth) {
  std::map<std::int64_t, std::size_t> places;
  for (std::size_t i = 0; i < truth.planes.size(); ++i) places[truth.planes[i].label] = i;
  std::vector<std::size_t> of_points;
  of_points.reserve(truth.labels.size());
  for (const std::int64_t label : truth.labels) {
    const auto place = label == kNoLabel ? places.end() : places.find(label);
    of_points.push_back(place == places.end() ? kNoPlace : place->second);
  }
  return of_points;
}

Overlap overlap_of(const Truth& truth, const std::vector<PlaneObservation>& found) {
  const std::vector<std::size_t> places = places_of_points(truth);
  std::vector<bool> assigned(places.size(), false);
  Overlap overlap;
  overlap.truth_sizes.resize(truth.planes.size());
  std::vector<std::size_t> of_members;
  for (std::size_t f = 0; f < found.size(); ++f) {
    overlap.found_sizes.push_back(found[f].members.size());
    of_members.clear();
    for (const PointIndex member : found[f].members) {
      assigned[member] = true;
      if (places[member] != kNoPlace) of_members.push_back(places[member]);
    }
    std::sort(of_members.begin(), of_members.end());
    for (std::size_t i = 0; i < of_members.size(); ++i) {
      if (i == 0 || of_members[i] != of_members[i - 1]) overlap.common.push_back({of_members[i], f, 0});
      ++overlap.common.back().points;
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] == kNoPlace) {
      ++overlap.outliers;
      overlap.assigned_outliers += assigned[i] ? 1u : 0u;
    } else {
      ++overlap.truth_sizes[places[i]];
      ++overlap.labelled;
      overlap.unassigned += assigned[i] ? 0u : 1u;
    }
  }
  return overlap;
}

}  // namespace hallway::planes
