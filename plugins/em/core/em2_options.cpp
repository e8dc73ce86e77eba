// SPDX-License-Identifier: MIT
#include "em/core/em2_options.hpp"

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<Em2Options>, 5> kOwnRows{{
    {"max_planes", "planes", 1, 1000000, "The search ends after so many planes that were grown and kept.",
     nullptr, &Em2Options::max_planes},
    {"tries", "points", 1, 1000000,
     "The search ends after so many random points in a row that gave no plane.", nullptr, &Em2Options::tries},
    {"grow_steps", "steps", 1, 100000, "A plane is widened so often at most.", nullptr,
     &Em2Options::grow_steps},
    {"min_density", "1", 0.0, 1.0,
     "A plane ends where its density falls below this share of that around its seed; 0: no check.",
     &Em2Options::min_density, nullptr},
    {"density_step", "length", 0.0, 1e9,
     "Width of the strips in which density is watched; 0: 4 times the spacing of the points.",
     &Em2Options::density_step, nullptr},
}};

constexpr auto kRows = joined_rows(common_rows<Em2Options>(), kOwnRows);

}  // namespace

std::span<const OptionRow<Em2Options>> em2_options() {
  return kRows;
}

void Em2Options::validate() const {
  check_ranges(*this, em2_options());
}

}  // namespace hallway::em
