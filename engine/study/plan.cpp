// SPDX-License-Identifier: MIT
#include "study/plan.hpp"

namespace hallway::study {

std::string PluginChoice::label() const {
  std::string text = plugin;
  for (const auto& [name, value] : parameters) text += ":" + name + "=" + value;
  return text;
}

std::string RunSpec::label(const std::string& name) const {
  for (const RunLabel& one : labels) {
    if (one.name == name) return one.value;
  }
  return {};
}

std::string RunSpec::group() const {
  std::string text;
  for (const RunLabel& one : labels) text += one.name + " " + one.value + ", ";
  return text + plugin.label();
}

std::uint32_t RunSpec::iterations() const {
  if (const auto* drive = std::get_if<Drive>(&input)) return drive->steps;
  const auto& park = std::get<ParkInterval>(input);
  return park.last - park.first + 1;
}

}  // namespace hallway::study
