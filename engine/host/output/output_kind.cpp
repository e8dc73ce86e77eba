// SPDX-License-Identifier: MIT
#include "host/output/output_kind.hpp"

#include <fmt/format.h>
#include <hallway/output.h>
#include <hallway/sample.h>

#include <algorithm>
#include <iterator>

#include "host/samples/plane_kind.hpp"

namespace hallway::host {
namespace {

bool find_planes(const Outputs& outputs, std::uint32_t sample, Payload& payload) {
  const auto list = outputs.planes(sample);
  if (list) fill_found(*list, sample, payload);
  return list.has_value();
}

constexpr OutputKind kOutputKinds[] = {{HW_OUTPUT_POSE, "pose"},
                                       {HW_OUTPUT_LANDMARKS, "landmarks"},
                                       {HW_OUTPUT_ASSOCIATIONS, "associations"},
                                       {HW_OUTPUT_SUBMAPS, "submaps"},
                                       {HW_OUTPUT_COUNTERS, "counters"},
                                       {HW_OUTPUT_PLANES, "planes", HW_SAMPLE_PLANES, &find_planes},
                                       {HW_OUTPUT_SEGMENTS, "segments", HW_SAMPLE_SEGMENTS},
                                       {HW_OUTPUT_TOPOLOGY, "topology"},
                                       {HW_OUTPUT_DRIVE_COMMAND, "drive_command"},
                                       {HW_OUTPUT_DRAWING, "drawing"},
                                       {HW_OUTPUT_MAPPED_PLANES, "mapped_planes"}};

const OutputKind* find_output_kind(std::uint32_t kind) {
  const auto* found = std::ranges::find(kOutputKinds, kind, &OutputKind::kind);
  return found == std::end(kOutputKinds) ? nullptr : found;
}

}  // namespace

std::span<const OutputKind> output_kinds() {
  return kOutputKinds;
}

std::string output_kind_name(std::uint32_t kind) {
  const OutputKind* known = find_output_kind(kind);
  return known == nullptr ? fmt::format("kind {}", kind) : known->name;
}

std::optional<std::uint32_t> sample_of_output(std::uint32_t output_kind) {
  const OutputKind* known = find_output_kind(output_kind);
  return known == nullptr ? std::nullopt : known->sample;
}

}  // namespace hallway::host
