// SPDX-License-Identifier: MIT
#include "icp/core/robust.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/median.hpp"

namespace hallway::icp {

double scale_of(std::vector<double> residuals) {
  if (residuals.empty()) return 0.0;
  return 1.4826 * median(residuals);
}

double weight_of(Kernel kernel, double residual, double scale) {
  if (kernel == Kernel::none || residual == 0.0) return 1.0;
  if (scale == 0.0) return 0.0;
  const double r = residual / scale;
  switch (kernel) {
    case Kernel::huber:
      return r <= 1.345 ? 1.0 : 1.345 / r;
    case Kernel::cauchy:
      return 1.0 / (1.0 + (r / 2.385) * (r / 2.385));
    case Kernel::tukey: {
      const double u = r / 4.685;
      return u < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
    }
    case Kernel::none:
      break;
  }
  return 1.0;
}

}  // namespace hallway::icp
