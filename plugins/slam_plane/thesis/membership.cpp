// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/membership.hpp"

#include <algorithm>
#include <tuple>

namespace hallway::slam_plane::thesis {

Intervals common_intervals(std::span<const PlaneTrack* const> members) {
  if (members.empty()) return {};
  Intervals common = members.front()->visible();
  for (const PlaneTrack* member : members.subspan(1)) common = intersection(common, member->visible());
  return common;
}

bool fits(const Intervals& common, const PlaneTrack& candidate, int min_interval) {
  return longest(intersection(common, candidate.visible())).size() >= std::max(min_interval, 1);
}

std::vector<int> linking_members(std::span<const PlaneTrack* const> members, const PlaneTrack& newcomer,
                                 int count) {
  struct Link {
    Iteration since;   // the member is visible
    Iteration shared;  // with the newcomer
    int member;
  };
  const Intervals seen = newcomer.visible();
  std::vector<Link> links;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Intervals visible = members[i]->visible();
    const Intervals both = intersection(visible, seen);
    if (both.empty()) continue;
    links.push_back({containing(visible, both.back().first).first, both.back().size(), static_cast<int>(i)});
  }
  std::ranges::sort(links, [](const Link& a, const Link& b) {
    return std::make_tuple(-a.since, -a.shared, a.member) < std::make_tuple(-b.since, -b.shared, b.member);
  });
  std::vector<int> result;
  for (const Link& link : links) {
    if (static_cast<int>(result.size()) < count) result.push_back(link.member);
  }
  return result;
}

Membership judge_member(const Comparison& comparison, Iteration joined, Iteration now,
                        const Options& options) {
  if (comparison.valid && comparison.shared >= options.min_interval) return Membership::confirmed;
  return now - joined < options.judge_after ? Membership::undecided : Membership::too_short;
}

}  // namespace hallway::slam_plane::thesis
