// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include "options/option_table.hpp"

namespace hallway {

/// Declares an algorithm's options as a plugin's parameters. `options` outlives `parameters`.
template <typename Options>
void add_options(sdk::Parameters& parameters, Options& options, std::span<const OptionRow<Options>> rows) {
  for (const OptionRow<Options>& row : rows) {
    if (row.real != nullptr) {
      parameters.add(row.name, &(options.*row.real), row.min, row.max, row.unit, row.help);
    } else {
      parameters.add(row.name, &(options.*row.whole), static_cast<int>(row.min), static_cast<int>(row.max),
                     row.unit, row.help);
    }
  }
}

}  // namespace hallway
