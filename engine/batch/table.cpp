// SPDX-License-Identifier: MIT
#include "batch/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "base/text.hpp"

namespace hallway::batch {
namespace {

using Json = nlohmann::ordered_json;

void add_numbers(std::vector<std::pair<std::string, double>>& numbers, const std::string& name,
                 const Json& json) {
  if (json.is_number()) numbers.emplace_back(name, json.get<double>());
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items())
    add_numbers(numbers, name.empty() ? key : name + "." + key, value);
}

/// Names in the order in which they are first met.
void add_name(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

std::string verdict_name(const Result& result) {
  return result.verdict.is_object() ? result.verdict.value("what", "") : "";
}

std::string label_of(const Result& result, const std::string& name) {
  for (const Label& label : result.labels) {
    if (label.name == name) return label.value;
  }
  return {};
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::pair<std::string, double>> numbers_of(const Json& metrics) {
  std::vector<std::pair<std::string, double>> numbers;
  add_numbers(numbers, "", metrics);
  return numbers;
}

std::optional<double> number_of(const Json& metrics, const std::string& name) {
  for (const auto& [key, number] : numbers_of(metrics)) {
    if (key == name) return number;
  }
  return std::nullopt;
}

std::string path_verdict_of(const Result& result) {
  const auto verdict = result.metrics.find("verdict");
  return verdict != result.metrics.end() && verdict->is_string() ? verdict->get<std::string>() : "";
}

std::string print_csv(const std::vector<Result>& results) {
  std::vector<std::string> labels, metrics;
  for (const Result& result : results) {
    for (const Label& label : result.labels) add_name(labels, label.name);
    for (const auto& [name, number] : numbers_of(result.metrics)) add_name(metrics, name);
  }
  std::string text = "name";
  for (const std::string& label : labels) text += "," + csv_field(label);
  text += ",status,verdict,problem,wall_s,path_verdict";
  for (const std::string& metric : metrics) text += "," + csv_field(metric);
  text += "\r\n";
  for (const Result& result : results) {
    text += csv_field(result.name);
    for (const std::string& label : labels) text += "," + csv_field(label_of(result, label));
    text += fmt::format(",{},{},{},{},{}", result.status, csv_field(verdict_name(result)),
                        csv_field(result.problem), format_double(result.wall_s),
                        csv_field(path_verdict_of(result)));
    const auto numbers = numbers_of(result.metrics);
    for (const std::string& metric : metrics) {
      const auto found = std::find_if(numbers.begin(), numbers.end(),
                                      [&](const auto& number) { return number.first == metric; });
      text += found == numbers.end() ? "," : "," + format_double(found->second);
    }
    text += "\r\n";
  }
  return text;
}

Json labels_json(const Result& result) {
  Json labels = Json::object();
  for (const Label& label : result.labels) labels[label.name] = label.value;
  return labels;
}

Json to_json(const std::vector<Result>& results) {
  Json cells = Json::array();
  for (const Result& result : results) {
    cells.push_back({{"name", result.name},
                     {"labels", labels_json(result)},
                     {"status", result.status},
                     {"problem", result.problem},
                     {"verdict", result.verdict},
                     {"wall_s", result.wall_s},
                     {"metrics", result.metrics}});
  }
  return {{"schema", "hallway.batch_results/1"}, {"cells", cells}};
}

std::vector<std::string> violations(const std::vector<Result>& results, const Plan& plan) {
  std::vector<std::string> all;
  for (const Result& result : results) {
    const std::string verdict = path_verdict_of(result);
    if (!plan.verdict.empty() && verdict != plan.verdict)
      all.push_back(fmt::format("{}: verdict is {}, not {}", result.name,
                                verdict.empty() ? "missing" : verdict, plan.verdict));
    for (const Threshold& threshold : plan.thresholds) {
      const auto number = number_of(result.metrics, threshold.metric);
      const std::string subject = result.name + ": " + threshold.metric;
      if (!number) {
        all.push_back(subject + " is missing");
      } else if (threshold.most && !(*number <= *threshold.most)) {
        all.push_back(fmt::format("{} is {}, more than {}", subject, format_double(*number),
                                  format_double(*threshold.most)));
      } else if (threshold.least && !(*number >= *threshold.least)) {
        all.push_back(fmt::format("{} is {}, less than {}", subject, format_double(*number),
                                  format_double(*threshold.least)));
      }
    }
  }
  return all;
}

}  // namespace hallway::batch
