// SPDX-License-Identifier: MIT
#pragma once

#include "host/samples/payload.hpp"

namespace hallway::host {

/// Makes what a sensor of the kind might give, of no other sample: for tests of plugins, which need samples of kinds that they do not know by name.
/// Where the row has no `example` of its own, numbers that must be finite are from 0 to 1, all others are 0, and optional arrays are there
/// in every other step. A pure function of its arguments.
void make_example(Payload& payload, const SampleKind& kind, const ExampleOf& of);

}  // namespace hallway::host
