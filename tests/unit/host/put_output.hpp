// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "host/output/outputs.hpp"

namespace hallway::host {

/// Hands an output over as a plugin does.
template <typename Payload>
hw_status_t put(OutputCollector& collector, std::uint32_t kind, Payload payload) {
  payload.size = sizeof payload;
  const hw_output_t output{sizeof output, kind, 0, 0, &payload};
  return collector.put(&output);
}

}  // namespace hallway::host
