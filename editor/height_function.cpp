// SPDX-License-Identifier: MIT
#include "editor/height_function.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>

#include "base/refuse.hpp"
#include "base/text.hpp"

namespace hallway::editor {

struct HeightFunction::Formula {
  std::string text{};
  double x = 0.0;
  double y = 0.0;
  mu::Parser parser{};

  double value() {
    try {
      return parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
      refuse("function: \"{}\" is no formula in x and y: {}", printable(text), printable(error.GetMsg()));
    }
  }
};

HeightFunction::HeightFunction(const std::string& formula) : formula_(std::make_unique<Formula>()) {
  constexpr std::size_t kLongest = 1000;
  if (formula.size() > kLongest) refuse("function: the formula is longer than 1000 characters");
  formula_->text = formula;
  formula_->parser.DefineConst("pi", std::numbers::pi);
  formula_->parser.DefineVar("x", &formula_->x);
  formula_->parser.DefineVar("y", &formula_->y);
  formula_->parser.SetExpr(formula);
  formula_->value();  // so that a mistake is found before there is a place for it
  if (formula_->parser.GetNumResults() != 1)
    refuse("function: \"{}\" has more than one result", printable(formula));
}

HeightFunction::~HeightFunction() = default;

double HeightFunction::at(double x, double y) {
  formula_->x = x;
  formula_->y = y;
  const double height = formula_->value();
  if (std::isfinite(height)) return height;
  refuse("function: \"{}\" is no finite number at x={} y={}", printable(formula_->text), format_double(x),
         format_double(y));
}

}  // namespace hallway::editor
