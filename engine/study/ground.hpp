// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "host/pipeline.hpp"
#include "run/sources/source.hpp"
#include "study/plan.hpp"

namespace hallway::study {

/// Where a study finds maps and writes what it changes of them.
struct Folders {
  std::filesystem::path maps{};  ///< scenarios and maps
  std::filesystem::path out{};
};

/// The input of a run, ready to be read.
class Ground {
 public:
  virtual ~Ground() = default;
  virtual run::Source& source() = 0;
  /// The pipeline that a run of it has with that plugin.
  virtual std::vector<host::StageSpec> stages(const PluginChoice& plugin) const = 0;
};

/// A map that was changed is written to `out`/maps, so that `hallway run SCENARIO --set map=FILE` drives through it too.
/// Throws Error for a scenario, map or recording that cannot be read, and for settings that it does not have.
/// @param data  folder of recorded data
std::unique_ptr<Ground> make_ground(const RunSpec& spec, const Folders& folders,
                                    const std::filesystem::path& data, unsigned threads);

/// The same text for runs that have their ground in common.
std::string ground_key(const RunSpec& spec);

}  // namespace hallway::study
