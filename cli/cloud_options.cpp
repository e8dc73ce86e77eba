// SPDX-License-Identifier: MIT
#include "cloud_options.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "base/refuse.hpp"
#include "base/text.hpp"

namespace hallway::cli {
namespace {

import::Camera parse_intrinsics(const std::string& text){std::vector<double> numbers;
for (const std::string_view part : split(text, ',')) {
  const auto number = parse_double(trim(part));
  if (number) numbers.push_back(*number);
}
if (numbers.size() != 4 || split(text, ',').size() != 4 || numbers[0] <= 0 || numbers[1] <= 0) {
  refuse("--intrinsics takes fx,fy,cx,cy in pixels, not \"{}\"", printable(text));
}
return {numbers[0], numbers[1], numbers[2], numbers[3]};
}  // namespace

planes::CloudColumns parse_columns(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string_view name : split(text, ',')) names.emplace_back(trim(name));
  if (names.size() < 3 || names.size() > 4)
    refuse("--columns takes the names of x, y, z and, where there is one, the label");
  return {names[0], names[1], names[2], names.size() == 4 ? names[3] : "label"};
}

}  // namespace hallway::cli

void add_cloud_options(Command& command, CloudInput& input) {
  command.option("--columns", &input.columns, "Names of the columns of a CSV file [x,y,z,label]")
      .value("X,Y,Z[,LABEL]");
  command.option("--intrinsics", &input.intrinsics, "Camera of a depth image, pixels").value("FX,FY,CX,CY");
  command.option("--depth-scale", &input.depth_scale, "Units of a depth image in one metre")
      .range(1e-3, 1e6)
      .value("N")
      .show_default();
}

planes::CloudOptions cloud_options(const CloudInput& input) {
  planes::CloudOptions options{.units_per_metre = input.depth_scale};
  if (!input.columns.empty()) options.columns = parse_columns(input.columns);
  if (!input.intrinsics.empty()) options.camera = parse_intrinsics(input.intrinsics);
  return options;
}

}  // namespace hallway::cli
