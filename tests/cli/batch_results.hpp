// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"

namespace hallway::test {

inline nlohmann::ordered_json read_json(const std::filesystem::path& path) {
  return nlohmann::ordered_json::parse(read_file(path));
}

/// Metrics without those that a clock gives.
inline nlohmann::ordered_json without_times(nlohmann::ordered_json metrics) {
  for (const char* key : {"iteration_ms", "iteration_cpu_ms"}) metrics.erase(key);
  return metrics;
}

/// A CSV file of plain fields, by rows.
inline std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// The result of a run by its name; null where there is none.
inline nlohmann::ordered_json cell_of(const nlohmann::ordered_json& results, const std::string& name) {
  for (const nlohmann::ordered_json& cell : results.at("cells")) {
    if (cell.at("name") == name) return cell;
  }
  return {};
}

}  // namespace hallway::test
