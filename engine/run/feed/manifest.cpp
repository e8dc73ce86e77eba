// SPDX-License-Identifier: MIT
#include "run/feed/manifest.hpp"

#include <nlohmann/json.hpp>

namespace hallway::run {

namespace {

record::ManifestFacts common(const ManifestFacts& facts) {
  return {.command = facts.command,
          .name = facts.name,
          .inputs = facts.inputs,
          .settings = facts.settings,
          .parameters = facts.parameters,
          .warnings = facts.warnings,
          .period_ns = facts.period_ns};
}

nlohmann::ordered_json with_machine(nlohmann::ordered_json manifest, const ManifestFacts& facts) {
  manifest["host"]["threads"] = facts.threads;
  manifest["host"]["trace"] = trace::backend_description(facts.trace);
  return manifest;
}

}  // namespace

nlohmann::ordered_json make_manifest(const ManifestFacts& facts, const host::Pipeline& pipeline) {
  return with_machine(record::make_manifest(common(facts), pipeline), facts);
}

nlohmann::ordered_json make_manifest(const ManifestFacts& facts) {
  return with_machine(record::make_manifest(common(facts)), facts);
}

}  // namespace hallway::run
