// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "host/machine/library_facts.hpp"
#include "host/machine/machine_profile.hpp"

namespace hallway::host {

/// Whether a plugin's file will load on a machine, and why not.
struct Loadability {
  std::vector<std::string> problems{};  ///< reasons for which it will not; empty: it will
  std::vector<std::string> remarks{};   ///< what does not prevent it, but is worth knowing
};

/// Compares what a library wants with what a machine has. Libraries that the file itself names a folder for are looked for there if that
/// folder goes with the file (`$ORIGIN`). O(facts + libraries of the machine).
Loadability judge(const LibraryFacts& facts, const MachineProfile& machine);

}  // namespace hallway::host
