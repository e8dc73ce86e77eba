// SPDX-License-Identifier: MIT
#include "host/machine/loadability.hpp"

#include <fmt/format.h>
#include <hallway/entry.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/text.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

/// Whether a library lies in a folder that goes with the plugin's file.
bool lies_beside(const LibraryFacts& facts, const std::string& library) {
  for (const std::string& folder : facts.search_folders) {
    for (const std::string_view origin : {"$ORIGIN", "${ORIGIN}"}) {
      if (!folder.starts_with(origin)) continue;
      const fs::path beside = facts.file.parent_path() / ("." + folder.substr(origin.size())) / library;
      std::error_code none;
      if (fs::is_regular_file(beside, none)) return true;
    }
  }
  return false;
}

void judge_libraries(Loadability& result, const LibraryFacts& facts, const MachineProfile& machine) {
  for (const std::string& library : facts.needed) {
    const bool known = std::binary_search(machine.libraries.begin(), machine.libraries.end(), library);
    // The loader itself is not in its own list on every system, and is there wherever a program runs.
    if (known || library.starts_with("ld-linux") || lies_beside(facts, library)) continue;
    const std::string text = fmt::format("needs the library {}", printable(library));
    if (machine.libraries.empty()) {
      result.remarks.push_back(text + "; whether that is there is not known");
    } else {
      result.problems.push_back(text + ", which is not there");
    }
  }
}

/// A family of symbol versions and what a machine has of it.
struct Family {
  const char* prefix;
  const char* what;
  const std::string& there;
};

/// Says the newest version that is wanted of a family and is not there, not every one.
void judge_family(Loadability& result, const LibraryFacts& facts, const Family& family) {
  std::string newest;
  for (const NeededVersion& needed : facts.needed_versions) {
    if (!needed.version.starts_with(family.prefix)) continue;
    const std::string version = needed.version.substr(std::string_view(family.prefix).size());
    if (version.find_first_not_of("0123456789.") != std::string::npos) {
      if (version == "PRIVATE") {
        result.remarks.push_back(
            fmt::format("uses private symbols of {}: another build of the same version may lack them",
                        printable(needed.library)));
      }
      continue;
    }
    if (newest.empty() || compare_versions(version, newest) > 0) newest = version;
  }
  if (newest.empty()) return;
  if (family.there.empty()) {
    result.remarks.push_back(
        fmt::format("needs {} {}; which one is there is not known", family.what, newest));
  } else if (compare_versions(newest, family.there) > 0) {
    result.problems.push_back(fmt::format("needs {} {}, there is {}", family.what, newest, family.there));
  }
}

void judge_entry(Loadability& result, const LibraryFacts& facts, const MachineProfile& machine) {
  if (!facts.abi) {
    if (facts.symbols_known) {
      result.problems.push_back(
          fmt::format("has no entry symbol {}: it is not a Hallway plugin", HW_ENTRY_SYMBOL));
    } else {
      result.remarks.push_back("has no section headers, so that its symbols are not known");
    }
    return;
  }
  if (facts.abi->abi_major != machine.abi_major) {
    result.problems.push_back(fmt::format("was built for version {}.{} of the plugin ABI, there it is {}.{}",
                                          facts.abi->abi_major, facts.abi->abi_minor, machine.abi_major,
                                          machine.abi_minor));
  } else if (facts.abi->abi_minor > machine.abi_minor) {
    result.remarks.push_back(fmt::format(
        "was built for version {}.{} of the plugin ABI, there it is {}.{}: what is newer it must do without",
        facts.abi->abi_major, facts.abi->abi_minor, machine.abi_major, machine.abi_minor));
  }
  const auto more =
      std::ranges::count_if(facts.exports, [](const std::string& name) { return name != HW_ENTRY_SYMBOL; });
  if (more > 0) {
    result.remarks.push_back(
        fmt::format("exports {} symbols besides {}; -fvisibility=hidden keeps them from meeting others", more,
                    HW_ENTRY_SYMBOL));
  }
}

}  // namespace

Loadability judge(const LibraryFacts& facts, const MachineProfile& machine) {
  Loadability result;
  if (!facts.machine.empty() && facts.machine != machine.machine) {
    result.problems.push_back(
        fmt::format("is for another architecture: {}, there it is {}", facts.machine, machine.machine));
    return result;
  }
  if (!facts.problem.empty()) {
    result.problems.push_back(facts.problem);
    return result;
  }
  if (!facts.shared_object) {
    result.problems.emplace_back("is an ELF file, but not a shared object");
    return result;
  }
  judge_entry(result, facts, machine);
  judge_libraries(result, facts, machine);
  for (const Family& family : {Family{"GLIBC_", "glibc", machine.glibc},
                               Family{"GLIBCXX_", "libstdc++ symbols GLIBCXX", machine.glibcxx},
                               Family{"CXXABI_", "libstdc++ symbols CXXABI", machine.cxxabi}}) {
    judge_family(result, facts, family);
  }
  return result;
}

}  // namespace hallway::host
