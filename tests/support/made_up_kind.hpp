// SPDX-License-Identifier: MIT
#pragma once

#include "host/samples/sample_kind.hpp"
#include "support/made_up_sample.h"

namespace hallway::test {

/// The row of kMadeUpSample. A program that made_up_kind.cpp is linked into knows the kind.
extern const host::SampleKind kMadeUpKind;

}  // namespace hallway::test
