// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace hallway::editor {

/// A height over a place, as a formula in `x` and `y`: + - * / ^, comparisons, `a ? b : c`, `pi`, and functions such as sin, cos, tan, sqrt,
/// abs, exp, ln, min, max, rint.
class HeightFunction {
 public:
  /// Throws Error{kUsage} for what is no such formula.
  explicit HeightFunction(const std::string& formula);
  ~HeightFunction();
  HeightFunction(const HeightFunction&) = delete;
  HeightFunction& operator=(const HeightFunction&) = delete;

  /// Throws Error{kUsage} where the result is no finite number.
  double at(double x, double y);

 private:
  struct Formula;
  std::unique_ptr<Formula> formula_;
};

}  // namespace hallway::editor
