// SPDX-License-Identifier: MIT
#pragma once

#include <stdlib.h>  // mkdtemp is POSIX, not in <cstdlib>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "base/file.hpp"

namespace hallway::test {

/// A new empty folder that goes with everything in it when the object goes.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hallway-test-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder at " + pattern);
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;  // a test that took away its own rights must not end the program here
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A path inside the folder; nothing is made.
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Writes a file inside the folder and gives its path.
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    const std::filesystem::path file = path_ / name;
    write_file_atomically(file, content);
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace hallway::test
