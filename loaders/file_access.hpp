// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::loaders {

/// The only way to files that a parser has: those inside one folder, after links and `..` are resolved.
class FileAccess {
 public:
  /// @param root        folder that may be read from
  /// @param model       the file that may name others, relative to its own folder
  /// @param byte_limit  of all files read together
  /// Throws Error{kIo} if either is not there, or the model is outside the folder.
  FileAccess(const std::filesystem::path& root, const std::filesystem::path& model, std::uint64_t byte_limit);

  /// Throws Error{kIo}.
  std::string read_model();
  /// The file that the model names (links and percent signs decoded by the caller). Throws Error{kIo} with the name as
  /// file and the cause; names that lead outside are also kept for refused().
  std::string read(std::string_view name);
  /// True if read() would find a regular file.
  bool exists(std::string_view name) const;

  /// The model's name without its folder.
  std::string model_name() const { return model_.filename().string(); }
  /// What was read, relative to the root, sorted.
  std::vector<std::string> files() const { return {files_.begin(), files_.end()}; }
  /// Causes why names were refused, in order.
  const std::vector<std::string>& refused() const { return refused_; }

 private:
  /// Throws Error{kBadInput} for a name that leads outside, Error{kIo} for one that leads nowhere.
  std::filesystem::path resolve(std::string_view name) const;
  std::string read_path(const std::filesystem::path& path);

  std::filesystem::path root_;
  std::filesystem::path model_;
  std::uint64_t bytes_left_;
  std::set<std::string> files_;
  std::vector<std::string> refused_;
};

}  // namespace hallway::loaders
