// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/setting.hpp"
#include "host/pipeline.hpp"
#include "record/plugin_json.hpp"

namespace hallway::record {

/// A file that was read, as it was.
struct Attachment {
  std::string name;
  std::string content;
};

/// What a command knows of a run before it begins.
struct ManifestFacts {
  std::string command;                        ///< "run", "replay" or "robot"
  std::string name;                           ///< a short name for titles, e.g. the scenario's
  std::vector<Attachment> inputs{};           ///< files read; their names and hashes are recorded
  std::vector<Setting> settings{};            ///< with their origins
  std::vector<ParameterOrigin> parameters{};  ///< of the plugins
  std::vector<std::string> warnings{};        ///< what the user was told
  std::int64_t period_ns = 0;                 ///< from frame to frame
};

/// run.json, schema "hallway.run/1", as far as it is known before the first iteration (docs/formats.md). Everything that
/// may differ between two runs of the same input stands under `host`.
nlohmann::ordered_json make_manifest(const ManifestFacts& facts, const host::Pipeline& pipeline);
/// The same of a command that runs no plugins: `plugins` is empty.
nlohmann::ordered_json make_manifest(const ManifestFacts& facts);

/// Writes a document as the files of a run folder have it. Throws Error{kIo}.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& document);

}  // namespace hallway::record
