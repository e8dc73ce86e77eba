// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/run.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {

/// What the user should know of the map, printed too. Throws the first of it if `strict`.
std::vector<std::string> take_warnings(const sim::Simulator& simulator, bool strict);

/// The files of the map's models, named as the map names them.
std::vector<run::Attachment> model_files(const sim::Simulator& simulator);

}  // namespace hallway::cli
