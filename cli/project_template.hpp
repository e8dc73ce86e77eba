// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace hallway::cli {

/// A file of a new project.
struct TemplateFile {
  const char* from;  ///< in the folder of templates; @NAME@, @CLASS@ and @PREFIX@ in it are replaced
  const char* to;    ///< in the project; @NAME@ is replaced
};

/// Writes a project of that name into a new folder, from the templates beside the program. @return one line for each file, and how to build it.
/// Throws Error{kUsage} for a name that is no id, a file name and an identifier at once; Error{kIo} where the folder is there already or cannot be
/// written.
std::string write_project(std::span<const TemplateFile> files, const std::string& name,
                          const std::filesystem::path& folder);

}  // namespace hallway::cli
