// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::host {

/// What a machine offers to a plugin. On a robot `hallway-robot profile` writes it to a file; another machine reads that and can say whether
/// a plugin will load there.
struct MachineProfile {
  std::string name{};     ///< of the machine, for messages
  std::string machine{};  ///< as machine_name() says it
  std::string glibc{};    ///< "2.36"
  std::string glibcxx{};  ///< highest of libstdc++'s symbol versions, "3.4.30"; empty where that is not known
  std::string cxxabi{};   ///< "1.3.13"; the same
  unsigned abi_major = 0;  ///< of the plugin ABI that its Hallway speaks
  unsigned abi_minor = 0;
  std::vector<std::string> libraries{};  ///< that its loader finds by name, sorted; empty: not known
};

/// The machine that this program runs on. Reads the loader's cache and the headers of the C++ library.
MachineProfile this_machine();

/// The profile as TOML, and back. `parse` throws Error{kBadInput} naming `file` and what is wrong: no TOML, an unknown or missing key.
std::string print_profile(const MachineProfile& profile);
MachineProfile parse_profile(const std::string& text, const std::filesystem::path& file);

/// The names of the libraries in a loader's cache (the format of glibc 2.2 and later, `/etc/ld.so.cache`) that are for this machine; none
/// where the bytes are no such cache.
std::optional<std::vector<std::string>> libraries_in_cache(std::string_view bytes);

/// Compares versions of numbers and points by their numbers: 2.9 is before 2.36. Negative, 0 or positive.
int compare_versions(std::string_view a, std::string_view b);

}  // namespace hallway::host
