// SPDX-License-Identifier: MIT
#include "em/core/em1_options.hpp"

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<Em1Options>, 4> kOwnRows{{
    {"max_iterations", "iterations", 1, 100000, "The search ends after so many iterations.", nullptr,
     &Em1Options::max_iterations},
    {"patience", "iterations", 1, 100000,
     "The search ends when so many iterations in a row have brought no plane and no points.", nullptr,
     &Em1Options::patience},
    {"new_planes", "planes", 1, 1000, "Random planes that an iteration starts.", nullptr,
     &Em1Options::new_planes},
    {"tries", "points", 1, 100000, "Random points that an iteration draws at most to start them from.",
     nullptr, &Em1Options::tries},
}};

constexpr auto kRows = joined_rows(common_rows<Em1Options>(), kOwnRows);

}  // namespace

std::span<const OptionRow<Em1Options>> em1_options() {
  return kRows;
}

void Em1Options::validate() const {
  check_ranges(*this, em1_options());
}

}  // namespace hallway::em
