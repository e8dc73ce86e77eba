// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hallway::host {

/// A stable name for an output kind: "pose", "landmarks", …; "kind 77" for an unknown one.
std::string output_kind_name(std::uint32_t kind);

/// The kind of sample that outputs of a kind are to the plugins behind the one that puts them; none where they are for the host alone.
std::optional<std::uint32_t> sample_of_output(std::uint32_t output_kind);

}  // namespace hallway::host
