// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "render/view.hpp"

namespace hallway::cli {

/// What `--view` says: "top" or "perspective".
render::View plane_view(const std::string& name);

}  // namespace hallway::cli
