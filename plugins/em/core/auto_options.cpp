// SPDX-License-Identifier: MIT
#include "em/core/auto_options.hpp"

#include <array>

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<AutoOptions>, 12> kRows{{
    {"noise", "length", 0.0, 1e9,
     "Standard deviation of the points across their planes; 0: estimated from the cloud.",
     &AutoOptions::noise},
    {"min_points", "points", 4, 1000000, "A plane has at least so many different points.",
     &AutoOptions::min_points},
    {"sample_points", "points", 1000, 100000000,
     "In a cloud half as large again or larger, planes are sought among so many points, then refined with "
     "all.",
     &AutoOptions::sample_points},
    {"seeds", "neighbourhoods", 1, 100000, "Neighbourhoods tried in a round of the search for planes.",
     &AutoOptions::seeds},
    {"rounds", "rounds", 1, 1000, "A search ends after so many rounds, or when they find nothing more.",
     &AutoOptions::rounds},
    {"passes", "passes", 1, 100,
     "Passes of expectation and maximisation after a search, fewer where nothing changes any more.",
     &AutoOptions::passes},
    {"bend", "1", 0.0, 0.25,
     "Facets that lie side by side and meet without a step are one plane where all of it is flat within this "
     "share of its width (standard deviations); 0 leaves them apart.",
     &AutoOptions::bend},
    {"rougher", "searches", 0, 10,
     "How often, after the first search, surfaces rougher than those found so far are sought.",
     &AutoOptions::rougher},
    {"gap", "length", 0.0, 1e9,
     "Planes are split where their points leave a gap wider than this; 0: they are not.", &AutoOptions::gap},
    {"seams", "1", 0, 1,
     "1: a point within the noise of two planes that meet is a member of both; 0: of the likelier one.",
     &AutoOptions::seams},
    {"warm_start", "1", 0, 1,
     "1: the planes of the last frame are tried first, and planes that are the same keep their ids.",
     &AutoOptions::warm_start},
    {"threads", "threads", 0, 64,
     "Threads that share the work; 0: as many as there are processors, at most 4. The result is the same for "
     "any number.",
     &AutoOptions::threads},
}};

}  // namespace

std::span<const OptionRow<AutoOptions>> auto_options() {
  return kRows;
}

void AutoOptions::validate() const {
  check_options(*this, auto_options());
}

}  // namespace hallway::em
