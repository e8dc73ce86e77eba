// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

namespace hallway {

/// Declares an algorithm's options as a plugin's parameters. A row of the table has a name, unit, least and greatest value, help, and a
/// pointer to the member, `real` or `whole`, the other one null. `options` outlives `parameters`.
template <typename Options, typename Rows>
void add_options(sdk::Parameters& parameters, Options& options, const Rows& rows) {
  for (const auto& row : rows) {
    if (row.real != nullptr) {
      parameters.add(row.name, &(options.*row.real), row.min, row.max, row.unit, row.help);
    } else {
      parameters.add(row.name, &(options.*row.whole), static_cast<int>(row.min), static_cast<int>(row.max),
                     row.unit, row.help);
    }
  }
}

}  // namespace hallway
