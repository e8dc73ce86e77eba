// SPDX-License-Identifier: MIT
#include "study/chart.hpp"

#include <array>

namespace hallway::study {

render::Rgb series_colour(std::size_t index) {
  static constexpr std::array<render::Rgb, 8> kColours{{{0, 104, 168},
                                                        {213, 94, 0},
                                                        {0, 136, 105},
                                                        {170, 34, 90},
                                                        {120, 94, 200},
                                                        {150, 110, 0},
                                                        {60, 160, 215},
                                                        {74, 80, 92}}};
  return kColours[index % kColours.size()];
}

std::vector<Vec2> thinned(const std::vector<Vec2>& points, std::size_t most) {
  if (points.size() <= most || most == 0) return points;
  std::vector<Vec2> few;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t begin = i * points.size() / most, end = (i + 1) * points.size() / most;
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = begin; k < end; ++k) sum += points[k];
    few.push_back(sum / static_cast<double>(end - begin));
  }
  return few;
}

}  // namespace hallway::study
