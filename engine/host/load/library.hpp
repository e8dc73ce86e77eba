// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.h>
#include <hallway/hallway.h>

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "host/load/driver_info.hpp"
#include "host/load/plugin_info.hpp"

namespace hallway::host {

/// A library of plugins or drivers that is loaded into this process, and stays so until the last Library of its file is
/// destroyed. Load, use and destroy libraries on one thread.
class Library {
 public:
  /// Checks and loads a file. Throws Error{kPluginLoad} naming the file and one distinct cause: it does not
  /// exist, is not an ELF file, is for another architecture, has no entry symbol, has another ABI major
  /// number, needs a library that is missing (with the loader's own words), has null functions, its init
  /// failed (with its own words), has neither plugins nor drivers, describes itself badly or has two of one id.
  static std::shared_ptr<const Library> load(const std::filesystem::path& file);

  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  /// The file, as it was given.
  const std::filesystem::path& file() const { return file_; }
  /// The ABI version that it was compiled against.
  hw_version_t abi() const;
  /// Its plugins, in their own order.
  const std::vector<PluginInfo>& plugins() const;
  /// The plugin of that id, or null.
  const PluginInfo* find(std::string_view id) const;

  /// Its drivers, in their own order.
  const std::vector<DriverInfo>& drivers() const;

  /// Makes a plugin. Throws Error{kPluginLoad} with the plugin's own reason, or if what it made has null
  /// functions.
  hw_plugin_t create(const PluginInfo& info, const hw_host_t& host) const;
  /// Makes a driver; the same.
  hw_driver_t create(const DriverInfo& info, const hw_host_t& host) const;

 private:
  struct Loaded;
  struct Registry;
  Library(std::filesystem::path file, Loaded* loaded);

  std::filesystem::path file_;
  Loaded* loaded_;
};

}  // namespace hallway::host
