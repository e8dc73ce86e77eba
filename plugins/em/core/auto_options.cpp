// SPDX-License-Identifier: MIT
#include "em/core/auto_options.hpp"

#include <array>

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<AutoOptions>, 12> kRows{{
    {"noise", "length", 0.0, 1e9,
     "Standard deviation of the points across their planes; 0: estimated from the cloud.",
     &AutoOptions::noise, nullptr},
    {"min_points", "points", 4, 1000000, "A plane has at least so many different points.", nullptr,
     &AutoOptions::min_points},
    {"sample_points", "points", 1000, 100000000,
     "In a cloud half as large again or larger, planes are sought among so many points, then refined with "
     "all.",
     nullptr, &AutoOptions::sample_points},
    {"seeds", "neighbourhoods", 1, 100000, "Neighbourhoods tried in a round of the search for planes.",
     nullptr, &AutoOptions::seeds},
    {"rounds", "rounds", 1, 1000, "A search ends after so many rounds, or when they find nothing more.",
     nullptr, &AutoOptions::rounds},
    {"passes", "passes", 1, 100,
     "Passes of expectation and maximisation after a search, fewer where nothing changes any more.", nullptr,
     &AutoOptions::passes},
    {"bend", "1", 0.0, 0.25,
     "Facets that lie side by side and meet without a step are one plane where all of it is flat within this "
     "share of its width (standard deviations); 0 leaves them apart.",
     &AutoOptions::bend, nullptr},
    {"rougher", "searches", 0, 10,
     "How often, after the first search, surfaces rougher than those found so far are sought.", nullptr,
     &AutoOptions::rougher},
    {"gap", "length", 0.0, 1e9,
     "Planes are split where their points leave a gap wider than this; 0: they are not.", &AutoOptions::gap,
     nullptr},
    {"seams", "1", 0, 1,
     "1: a point within the noise of two planes that meet is a member of both; 0: of the likelier one.",
     nullptr, &AutoOptions::seams},
    {"warm_start", "1", 0, 1,
     "1: the planes of the last frame are tried first, and planes that are the same keep their ids.", nullptr,
     &AutoOptions::warm_start},
    {"threads", "threads", 0, 64,
     "Threads that share the work; 0: as many as there are processors, at most 4. The result is the same for "
     "any number.",
     nullptr, &AutoOptions::threads},
}};

}  // namespace

std::span<const OptionRow<AutoOptions>> auto_options() {
  return kRows;
}

void AutoOptions::validate() const {
  check_ranges(*this, auto_options());
}

}  // namespace hallway::em
