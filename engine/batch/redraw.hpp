// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "batch/runner.hpp"

namespace hallway::batch {

/// Draws the pictures of all runs of a plan again that left a folder, one after the other, with more arguments of `hallway render`: what all pictures have to have in
/// common is only known when all runs are done. Ends early where `setup.stop` says so.
/// @return the pictures that could not be drawn; they stay as they were. Throws Error{kIo} where no process can be started.
std::vector<std::string> redraw_pictures(const Plan& plan, const RunnerSetup& setup,
                                         const std::vector<std::string>& more);

}  // namespace hallway::batch
