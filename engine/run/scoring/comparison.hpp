// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "render/image.hpp"
#include "render/renderer.hpp"
#include "run/pictures/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A run that is shown beside others of the same input.
struct Compared {
  std::string name;
  const Record& record;
};

/// Several runs, at least one, in a panel each: the map and the truth of the first, and of each the estimated path, the mapped landmarks and their errors. All panels
/// show the same part of the world, that of the map and the truth, from the same place, and draw errors longer by the same power of ten.
/// Throws Error{kBadInput} for more runs than a picture has room for.
/// Throws render::NoRenderer where there are faces to draw and this machine does not have the renderer.
/// @param spec  view, layers, and the size of one panel; for more than four runs they are smaller
render::Image draw_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec,
                              render::Renderer renderer = render::Renderer::kAuto);

}  // namespace hallway::run
