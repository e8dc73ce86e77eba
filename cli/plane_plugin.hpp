// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/pipeline.hpp"
#include "render/view.hpp"

namespace hallway::cli {

/// "em:mode=em1:sigma_m=0.02": a plugin and values of its parameters; "FILE.so:ID" names one of several plugins of a file. Throws Error{kUsage}.
host::StageSpec parse_plane_plugin(const std::string& text);

/// What `--view` says: "top" or "perspective".
render::View plane_view(const std::string& name);

}  // namespace hallway::cli
