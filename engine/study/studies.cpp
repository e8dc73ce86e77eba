// SPDX-License-Identifier: MIT
#include <array>

#include "study/parts.hpp"
#include "study/study.hpp"

namespace hallway::study {

std::span<const Study> studies() {
  static const std::array kStudies{kBinning,  kConstants,  kFigureEight,  kDensity, kMapSize,
                                   kStraight, kStationary, kVictoriaPark, kDynamic, kFortyLoops};
  return kStudies;
}

}  // namespace hallway::study
