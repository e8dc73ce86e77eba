// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/output/outputs.hpp"
#include "host/samples/payload.hpp"

namespace hallway::host {

/// A row of the table of output kinds.
struct OutputKind {
  std::uint32_t kind;                                  ///< HW_OUTPUT_…
  const char* name;                                    ///< in messages and files
  std::optional<std::uint32_t> sample = std::nullopt;  ///< HW_SAMPLE_… that it is to the plugins behind
  /// Makes the payload of that sample of what was put for one of a frame, and refers to `outputs`. @return false, and leaves the payload alone, where
  /// nothing was put. Null where `sample` is none or Outputs does not keep the output.
  bool (*find)(const Outputs& outputs, std::uint32_t sample, Payload& payload) = nullptr;
};

/// All rows.
std::span<const OutputKind> output_kinds();

/// A stable name for an output kind: "pose", "landmarks", …; "kind 77" for an unknown one.
std::string output_kind_name(std::uint32_t kind);

/// The kind of sample that outputs of a kind are to the plugins behind the one that puts them; none where they are for the host alone.
std::optional<std::uint32_t> sample_of_output(std::uint32_t output_kind);

}  // namespace hallway::host
