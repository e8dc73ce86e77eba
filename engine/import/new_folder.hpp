// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace hallway::import {

/// Makes a folder and its parents; one that is there already must be empty. Throws Error{kIo}.
void make_new_folder(const std::filesystem::path& path);

}  // namespace hallway::import
