// SPDX-License-Identifier: MIT
#pragma once

#include "em/core/auto_options.hpp"
#include "em/core/canonical.hpp"
#include "em/core/mixture.hpp"
#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// The planes of a mixture over all points of `cloud`, in the frame and the order of the `given` points that
/// it was made of. Patches that facet_groups() joins at `bend` are one plane; with `seams`, points at seams are members of
/// both planes.
Extraction extraction_of(const CanonicalCloud& cloud, Mixture& mixture, const AutoOptions& options,
                         std::size_t given, Workers& workers);

}  // namespace hallway::em
