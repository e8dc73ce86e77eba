// SPDX-License-Identifier: MIT
#include "run/run_files.hpp"

#include "base/file.hpp"

namespace hallway::run {

void write_attachments(const std::filesystem::path& folder, const std::vector<Attachment>& attachments) {
  for (const Attachment& attachment : attachments) {
    make_folder((folder / attachment.name).parent_path());
    write_file_atomically(folder / attachment.name, attachment.content);
  }
}

}  // namespace hallway::run
