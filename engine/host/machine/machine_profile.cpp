// SPDX-License-Identifier: MIT
#include "host/machine/machine_profile.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <hallway/version.h>
#include <link.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "host/machine/elf_image.hpp"
#include "host/machine/library_facts.hpp"

namespace hallway::host {
namespace {

constexpr std::string_view kSchema = "hallway.machine/1";
constexpr std::size_t kMaxCacheBytes = std::size_t{64} << 20;

/// The file of the C++ library that this program uses.
std::filesystem::path cxx_library() {
  std::string file;
  ::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* found) {
        const std::string_view name = info->dlpi_name != nullptr ? info->dlpi_name : "";
        if (name.find("libstdc++.so") == std::string_view::npos) return 0;
        *static_cast<std::string*>(found) = name;
        return 1;
      },
      &file);
  return file;
}

/// The highest version of a family ("GLIBCXX_") among names like GLIBCXX_3.4.30.
std::string highest(const std::vector<std::string>& names, std::string_view family) {
  std::string best;
  for (const std::string& name : names) {
    if (!name.starts_with(family)) continue;
    const std::string version = name.substr(family.size());
    const bool numbers = !version.empty() && version.find_first_not_of("0123456789.") == std::string::npos;
    if (numbers && (best.empty() || compare_versions(version, best) > 0)) best = version;
  }
  return best;
}

/// The value of a key as T. Throws where it is missing or something else; `what` says what it should be.
template <typename T>
const T& value_of(const TomlTable& table, const char* key, const char* what, const std::string& file) {
  const TomlNode* node = find(table, key);
  if (node == nullptr) throw Error(ErrorCode::kBadInput, fmt::format("`{}` is missing", key), {file, 0, {}});
  if (const T* value = std::get_if<T>(&node->value)) return *value;
  throw Error(ErrorCode::kBadInput, fmt::format("`{}` is {}, not {}", key, kind_name(*node), what),
              {file, node->line, {}});
}

std::string text_key(const TomlTable& table, const char* key, const std::string& file) {
  return value_of<std::string>(table, key, "a text", file);
}

unsigned version_key(const TomlTable& table, const char* key, const std::string& file) {
  const auto number = value_of<std::int64_t>(table, key, "a whole number", file);
  if (number >= 0 && number <= UINT16_MAX) return static_cast<unsigned>(number);
  throw Error(ErrorCode::kBadInput, fmt::format("`{}` is no number of a version: {}", key, number),
              {file, 0, {}});
}

void check_keys(const TomlTable& table, const std::string& file) {
  const std::vector<std::string> known{"schema", "name",      "machine",   "glibc",    "glibcxx",
                                       "cxxabi", "abi_major", "abi_minor", "libraries"};
  for (const TomlEntry& entry : table) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    throw Error(ErrorCode::kBadInput,
                fmt::format("unknown key \"{}\"{}", printable(entry.key), suggestion(entry.key, known)),
                {file, entry.node.line, {}});
  }
}

}  // namespace

int compare_versions(std::string_view a, std::string_view b) {
  const auto next = [](std::string_view& text) {
    const std::size_t point = text.find('.');
    const auto number = parse_uint(text.substr(0, point));
    text = point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
    return number ? *number : 0;
  };
  while (!a.empty() || !b.empty()) {
    const auto left = a.empty() ? 0 : next(a), right = b.empty() ? 0 : next(b);
    if (left != right) return left < right ? -1 : 1;
  }
  return 0;
}

std::optional<std::vector<std::string>> libraries_in_cache(std::string_view bytes) {
  // Header: 20 bytes of magic and version, number of libraries, bytes of texts, and 20 more; then 24 bytes for each library.
  constexpr std::string_view kMagic = "glibc-ld.so.cache1.1";
  constexpr std::size_t kHeader = 48, kEntry = 24, kCountAt = 20;
  // Flags of a library for glibc 2 and newer; the second byte says for which machine.
  constexpr std::uint32_t kForGlibc2 = 3, kX86_64 = 0x0300, kAArch64 = 0x0a00;
  const std::uint32_t wanted = kForGlibc2 | (our_machine() == EM_X86_64 ? kX86_64 : kAArch64);
  // An older cache may stand before it.
  const std::size_t begin = bytes.find(kMagic);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view cache = bytes.substr(begin);
  if (cache.size() < kHeader) return std::nullopt;
  const auto number_at = [&](std::size_t at) { return load<std::uint32_t>(cache.data() + at); };
  const std::size_t count = number_at(kCountAt);
  if (count > (cache.size() - kHeader) / kEntry) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kHeader + i * kEntry;
    if ((number_at(at) & 0xffffu) != wanted) continue;
    const std::string_view name = ElfImage::text_at(cache, number_at(at + 4));
    if (!name.empty()) names.emplace_back(name);
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

MachineProfile this_machine() {
  MachineProfile profile;
  utsname system{};
  if (::uname(&system) == 0) profile.name = printable(static_cast<const char*>(system.nodename));
  profile.machine = machine_name(our_machine());
  profile.glibc = ::gnu_get_libc_version();
  profile.abi_major = HW_ABI_MAJOR;
  profile.abi_minor = HW_ABI_MINOR;
  try {
    const LibraryFacts facts = read_library_facts(cxx_library());
    profile.glibcxx = highest(facts.defined_versions, "GLIBCXX_");
    profile.cxxabi = highest(facts.defined_versions, "CXXABI_");
  } catch (const Error&) {
    // A program that has the C++ library within itself cannot say which one plugins would find.
  }
  try {
    if (auto libraries = libraries_in_cache(read_file("/etc/ld.so.cache", kMaxCacheBytes)))
      profile.libraries = std::move(*libraries);
  } catch (const Error&) {
    // Systems without a cache are searched by the loader; what is not known is said to be so.
  }
  return profile;
}

std::string print_profile(const MachineProfile& profile) {
  std::string text =
      "# What a plugin finds on this machine; `hallway plugin check FILE --profile THIS` says whether it "
      "loads here.\n";
  const auto quoted = [](const std::string& value) { return fmt::format("\"{}\"", printable(value)); };
  text += fmt::format("schema = \"{}\"\nname = {}\nmachine = {}\nglibc = {}\nglibcxx = {}\ncxxabi = {}\n",
                      kSchema, quoted(profile.name), quoted(profile.machine), quoted(profile.glibc),
                      quoted(profile.glibcxx), quoted(profile.cxxabi));
  text +=
      fmt::format("abi_major = {}\nabi_minor = {}\nlibraries = [\n", profile.abi_major, profile.abi_minor);
  for (const std::string& library : profile.libraries) text += "  " + quoted(library) + ",\n";
  return text + "]\n";
}

MachineProfile parse_profile(const std::string& text, const std::filesystem::path& path) {
  const std::string file = path.string();
  const TomlTable table = parse_toml(text, file);
  if (const std::string schema = text_key(table, "schema", file); schema != kSchema) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("its schema is \"{}\", not \"{}\"", printable(schema), kSchema), {file, 0, {}});
  }
  check_keys(table, file);
  MachineProfile profile{.name = text_key(table, "name", file),
                         .machine = text_key(table, "machine", file),
                         .glibc = text_key(table, "glibc", file),
                         .glibcxx = text_key(table, "glibcxx", file),
                         .cxxabi = text_key(table, "cxxabi", file),
                         .abi_major = version_key(table, "abi_major", file),
                         .abi_minor = version_key(table, "abi_minor", file)};
  for (const TomlNode& library : value_of<TomlArray>(table, "libraries", "a list of names", file)) {
    if (const auto* name = std::get_if<std::string>(&library.value)) profile.libraries.push_back(*name);
  }
  std::ranges::sort(profile.libraries);
  return profile;
}

}  // namespace hallway::host
