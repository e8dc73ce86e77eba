// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hallway::conformance {

/// Why a library cannot be loaded at all, so that there is nothing to test.
class NotLoadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A plugin library as the loader gives it: unlike host::Library it checks no more than it needs, so that tests can tell what is wrong.
class LoadedLibrary {
 public:
  /// Loads and initialises a file that host::check_library_file() finds good. Throws NotLoadable.
  explicit LoadedLibrary(const std::filesystem::path& file);
  /// unload(), if nobody has.
  ~LoadedLibrary();
  LoadedLibrary(const LoadedLibrary&) = delete;
  LoadedLibrary& operator=(const LoadedLibrary&) = delete;

  const hw_entry_t& entry() const { return *entry_; }
  const hw_plugin_factory_t& factory() const { return *factory_; }
  /// The description of the plugin `id`; of the first one where `id` is empty. Throws NotLoadable.
  const hw_plugin_info_t& info(const std::string& id) const;
  /// Ends and unloads the library.
  void unload();

 private:
  void start(const std::filesystem::path& file);

  void* handle_ = nullptr;
  const hw_entry_t* entry_ = nullptr;
  const hw_plugin_factory_t* factory_ = nullptr;
};

/// The sample kinds that a plugin takes, needed or not.
std::vector<std::uint32_t> inputs_of(const hw_plugin_info_t& info);
/// The output kinds that a plugin may put.
std::vector<std::uint32_t> outputs_of(const hw_plugin_info_t& info);

}  // namespace hallway::conformance
