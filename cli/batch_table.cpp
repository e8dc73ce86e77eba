// SPDX-License-Identifier: MIT
#include "batch_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "batch/table.hpp"

namespace hallway::cli {
namespace {

/// A column: its head, the number that it shows, how, and what that is multiplied by.
struct Column {
  const char* head;
  const char* metric;
  const char* format;
  double factor = 1.0;
  const char* otherwise = nullptr;  ///< shown where there is no `metric`
};

/// Beside every error is what it was taken over.
constexpr std::array kColumns{Column{"map RMSE m", "landmark_rmse_m.final_aligned", "{:.4f}"},
                              Column{"online", "landmark_rmse_m.aligned", "{:.4f}"},
                              Column{"mapped %", "coverage.landmarks", "{:.1f}", 100.0, "coverage.walls"},
                              Column{"path RMSE m", "position_rmse_m.aligned", "{:.4f}"},
                              Column{"poses %", "coverage.poses", "{:.1f}", 100.0},
                              Column{"restarts", "parts.restarts", "{:.0f}"},
                              Column{"lost", "lost_iterations", "{:.0f}"},
                              Column{"misassoc.", "association_errors", "{:.0f}"},
                              Column{"ms mean", "iteration_ms.mean", "{:.4f}"},
                              Column{"p99", "iteration_ms.p99", "{:.4f}"}};

std::string field_of(const Column& column, const batch::Result& result) {
  auto number = batch::number_of(result.metrics, column.metric);
  if (!number && column.otherwise != nullptr) number = batch::number_of(result.metrics, column.otherwise);
  return number ? fmt::format(fmt::runtime(column.format), column.factor * *number) : "-";
}

std::string state_of(const batch::Result& result) {
  if (result.verdict.is_object()) return result.verdict.value("what", "failed");
  if (!result.good()) return fmt::format("status {}", result.status);
  const std::string verdict = batch::path_verdict_of(result);
  return verdict.empty() ? "-" : verdict;
}

}  // namespace

std::string results_table(const std::vector<batch::Result>& results) {
  std::size_t width = 4;
  for (const batch::Result& result : results) width = std::max(width, result.name.size());
  std::string text = fmt::format("{:<{}}", "run", width);
  for (const Column& column : kColumns) text += fmt::format("  {:>11}", column.head);
  text += "  verdict\n";
  for (const batch::Result& result : results) {
    text += fmt::format("{:<{}}", result.name, width);
    for (const Column& column : kColumns) text += fmt::format("  {:>11}", field_of(column, result));
    text += "  " + state_of(result) + "\n";
  }
  return text;
}

std::string failures_text(const std::vector<batch::Result>& results,
                          const std::vector<std::string>& violations) {
  std::string text;
  for (const batch::Result& result : results) {
    if (!result.good()) text += fmt::format("failed: {}: {}\n", result.name, result.problem);
  }
  for (const std::string& violation : violations) text += "threshold: " + printable(violation, 500) + "\n";
  return text;
}

}  // namespace hallway::cli
