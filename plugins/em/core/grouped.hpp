// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/workers.hpp"

namespace hallway::em {

/// The numbers below `count` by groups: list g has, ascending, those of which `group_of` is g; numbers of a group not
/// below `groups`, such as kNoPlane, are in none. `group_of` is called from several threads, once or twice for each. O(count + groups).
template <typename GroupOf>
std::vector<std::vector<std::uint32_t>> grouped(std::size_t count, std::size_t groups,
                                                const GroupOf& group_of, Workers& workers) {
  std::vector<std::vector<std::size_t>> places(Workers::parts(count));  // of each part: where its numbers go
  workers.run_parts(count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<std::size_t> counts(groups, 0);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t group = group_of(i);
      if (group < groups) ++counts[group];
    }
    places[part] = std::move(counts);
  });
  std::vector<std::size_t> sizes(groups, 0);
  for (std::vector<std::size_t>& of_part : places) {
    for (std::size_t g = 0; g < groups; ++g) {
      sizes[g] += of_part[g];
      of_part[g] = sizes[g] - of_part[g];
    }
  }
  std::vector<std::vector<std::uint32_t>> lists(groups);
  workers.run(groups, [&](std::size_t g, std::size_t) { lists[g].resize(sizes[g]); });
  workers.run_parts(count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<std::size_t>& next = places[part];
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t group = group_of(i);
      if (group < groups) lists[group][next[group]++] = static_cast<std::uint32_t>(i);
    }
  });
  return lists;
}

}  // namespace hallway::em
