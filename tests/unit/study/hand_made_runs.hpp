// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "study/study.hpp"

namespace hallway::test {

/// A run of `steps` iterations whose estimate is off by `error` throughout and takes `cpu_ms` for each.
inline study::StudyRun even_run(const std::string& plugin, std::uint64_t seed, std::size_t steps,
                                const Vec3& error, double cpu_ms) {
  study::StudyRun run{.spec = {.labels = {{"density", "25"}},
                               .input = study::Drive{.steps = static_cast<std::uint32_t>(steps)},
                               .plugin = {.plugin = plugin},
                               .seed = seed,
                               .sample_every = 10}};
  run.trace.T_world_map = Pose();
  for (std::size_t i = 0; i < steps; ++i) {
    const Vec3 truth(static_cast<double>(i), 0.0, 0.0);
    run.trace.steps.push_back({.visible = 30, .cpu_ms = cpu_ms, .truth = truth, .estimate = truth + error});
  }
  return run;
}

}  // namespace hallway::test
