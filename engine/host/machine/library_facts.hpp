// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/version.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hallway::host {

/// A version that a library wants of another one: `GLIBC_2.34` of `libc.so.6`.
struct NeededVersion {
  std::string library{};
  std::string version{};
};

/// What stands in a shared object about itself, read without running any of it.
struct LibraryFacts {
  std::filesystem::path file{};
  bool whole =
      false;  ///< a 64-bit little-endian file that holds what its headers announce; else only `machine` and `problem` are known
  std::string problem{};  ///< what is wrong with the file itself; empty where nothing is
  std::string machine{};  ///< as machine_name() says it; "32-bit" and "big-endian" where it is that
  bool shared_object = false;
  std::vector<std::string> needed{};          ///< libraries, in the file's order
  std::vector<std::string> search_folders{};  ///< of RUNPATH or RPATH, `$ORIGIN` as it stands
  std::vector<NeededVersion> needed_versions{};
  std::vector<std::string> defined_versions{};  ///< that it offers to others
  bool symbols_known = false;                   ///< false where the file has no section headers
  std::vector<std::string> exports{};  ///< names of functions and data that it defines for others, sorted
  std::optional<hw_version_t> abi{};   ///< that `hw_entry` names
};

/// Reads the facts of a file. Throws Error{kPluginLoad} only where there is no regular file to read; what is wrong in it is told in
/// LibraryFacts::problem. O(size of the file).
LibraryFacts read_library_facts(const std::filesystem::path& file);

}  // namespace hallway::host
