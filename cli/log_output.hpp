// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "log/byte_io.hpp"

namespace hallway::cli {

/// A new file that appears under its name when it is whole: written beside it and renamed by commit(). Destroyed without
/// commit(), it leaves nothing behind.
class NewFile {
 public:
  /// @param replace  whether a file of that name may be replaced
  /// Throws Error{kIo} if the place cannot be written, or holds something that may not be replaced.
  NewFile(std::filesystem::path path, bool replace);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  log::ByteOutput& output() { return *output_; }
  const std::filesystem::path& path() const { return path_; }
  /// Gives the file its name; output() was closed before. Throws Error{kIo}.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path beside_;
  std::unique_ptr<log::FileOutput> output_;
  bool committed_ = false;
};

}  // namespace hallway::cli
