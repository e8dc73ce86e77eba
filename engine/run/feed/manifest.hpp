// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "host/pipeline.hpp"
#include "record/plugin_json.hpp"
#include "run/feed/run.hpp"
#include "sim/setting.hpp"
#include "trace/scene.hpp"

namespace hallway::run {

using record::ParameterOrigin;

/// What a command knows of a run before it begins.
struct ManifestFacts {
  std::string command;                        ///< "run" or "replay"
  std::string name;                           ///< a short name for titles, e.g. the scenario's
  std::vector<Attachment> inputs{};           ///< files read; their names and hashes are recorded
  std::vector<sim::Setting> settings{};       ///< with their origins
  std::vector<ParameterOrigin> parameters{};  ///< of the plugins
  std::vector<std::string> warnings{};        ///< what the user was told
  std::int64_t period_ns = 0;                 ///< from frame to frame
  unsigned threads = 1;                       ///< a fact of the machine: no result depends on it
  trace::Backend trace = trace::Backend::kEmbree;
};

/// run.json, schema "hallway.run/1", as far as it is known before the first iteration (docs/formats.md). Everything that
/// may differ between two runs of the same input stands under `host`.
nlohmann::ordered_json make_manifest(const ManifestFacts& facts, const host::Pipeline& pipeline);
/// The same of a command that runs no plugins: `plugins` is empty.
nlohmann::ordered_json make_manifest(const ManifestFacts& facts);

}  // namespace hallway::run
