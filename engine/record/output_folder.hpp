// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace hallway::record {

/// A folder that appears whole or not at all: everything is written into a folder beside it, and commit() gives that its
/// final name. Destroyed without commit(), it leaves nothing behind, and what stood under the name before stays.
class OutputFolder {
 public:
  /// Checks that `path` can be written before any work is done.
  /// @param replace  whether an earlier run folder (one with a run.json) under this name may be replaced at commit()
  /// Throws Error{kIo} if the place cannot be written, or holds something that may not be replaced.
  OutputFolder(std::filesystem::path path, bool replace);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& working_path() const { return working_path_; }
  /// The final name, as given.
  const std::filesystem::path& path() const { return path_; }

  /// Gives the folder its final name. Throws Error{kIo}; what stood there before then stays.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path working_path_;
  bool replace_;
  bool committed_ = false;
};

}  // namespace hallway::record
