// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/isolate/verdict.hpp"
#include "host/pipeline.hpp"

namespace hallway::record {

/// Where a plugin's parameter got its value, when it was not left at its default.
struct ParameterOrigin {
  std::string plugin;  ///< id
  std::string name;
  std::string origin;  ///< "office.toml:12", "command line", "run.json"
};

/// Where the parameters of a pipeline's plugins were set, by the file and line of each.
std::vector<ParameterOrigin> origins_of(std::span<const host::StageSpec> stages);

/// The plugins of a pipeline as run.json has them: id, version, hash of the file, parameters. Of one that ended before it could
/// say what it is, what was asked for. Throws Error{kIo} if a file cannot be read.
nlohmann::ordered_json print_plugins(const std::vector<ParameterOrigin>& origins,
                                     const host::Pipeline& pipeline);

/// A verdict, as run.json and the command line's documents have it.
/// @param iteration  of its frame; unset where it was no call of process()
nlohmann::ordered_json print_verdict(const host::Verdict& verdict, std::optional<std::uint32_t> iteration);

}  // namespace hallway::record
