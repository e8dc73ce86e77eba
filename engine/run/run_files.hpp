// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "run/run.hpp"

namespace hallway::run {

/// Writes files that were read, with the folders in their names. Throws Error{kIo}.
void write_attachments(const std::filesystem::path& folder, const std::vector<Attachment>& attachments);

}  // namespace hallway::run
