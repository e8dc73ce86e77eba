// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/auto_options.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Finds finite planes in clouds: algorithm `auto`.
class PlaneExtractor {
 public:
  explicit PlaneExtractor(const AutoOptions& options = {}) : options_(options) {}
  Extraction extract(std::span<const Vec3> cloud) const;

 private:
  AutoOptions options_;
};

}  // namespace hallway::em
