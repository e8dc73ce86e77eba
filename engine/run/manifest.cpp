// SPDX-License-Identifier: MIT
#include "run/manifest.hpp"

namespace hallway::run {

nlohmann::ordered_json make_manifest(const ManifestFacts& facts, host::Pipeline& pipeline) {
  nlohmann::ordered_json manifest = record::make_manifest({.command = facts.command,
                                                           .name = facts.name,
                                                           .inputs = facts.inputs,
                                                           .settings = facts.settings,
                                                           .parameters = facts.parameters,
                                                           .warnings = facts.warnings,
                                                           .period_ns = facts.period_ns},
                                                          pipeline);
  manifest["host"]["threads"] = facts.threads;
  manifest["host"]["trace"] = trace::backend_description(facts.trace);
  return manifest;
}

}  // namespace hallway::run
