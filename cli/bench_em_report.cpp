// SPDX-License-Identifier: MIT
#include "bench_em_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planes/files.hpp"

namespace hallway::cli {
namespace {

using Json = nlohmann::ordered_json;

Json spread(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::ranges::sort(values);
  double sum = 0;
  for (const double value : values) sum += value;
  return {{"mean", sum / static_cast<double>(values.size())},
          {"median", values[values.size() / 2]},
          {"max", values.back()}};
}

template <typename Member>
Json times(const PluginResult& result, Member member) {
  std::vector<double> values;
  for (const SceneResult& scene : result.scenes) values.push_back(scene.*member);
  return spread(std::move(values));
}

Json summary(const PluginResult& result) {
  std::vector<planes::Score> scores;
  for (const SceneResult& scene : result.scenes) scores.push_back(scene.score);
  return planes::scores_json(scores);
}

Json scene_json(const SceneResult& scene) {
  const planes::Score& score = scene.score;
  Json faults = Json::object();
  for (const planes::Fault& fault : score.faults) {
    Json& count = faults[planes::fault_name(fault.kind)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return {{"scene", scene.scene},
          {"points", scene.points},
          {"noise", scene.noise},
          {"ms", scene.ms},
          {"true_planes", score.truths},
          {"found_planes", score.found},
          {"matched", score.matched},
          {"apart", score.apart},
          {"apart_matched", score.apart_matched},
          {"faults", std::move(faults)}};
}

/// A number in a cell of 6, "-" for null.
std::string cell(const Json& number, int digits) {
  return number.is_null() ? fmt::format("{:>6}", "-")
                          : fmt::format("{:>6.{}f}", number.get<double>(), digits);
}

/// Precision and recall at each IoU, of `score` itself or of the member of its IoUs given.
std::string rates(const Json& score, const char* member) {
  std::string text;
  for (const Json& at : score["iou"]) {
    const Json& of = *member == '\0' ? at : at[member];
    text += cell(of["precision"], 3) + " " + cell(of["recall"], 3);
  }
  return text;
}

std::string normal_cell(const Json& score) {
  const Json& normal = score["normal_error_deg"];
  return "   " + cell(normal.is_null() ? Json() : normal["mean"], 3);
}

/// The lines of a plugin: all planes, then those that can be told.
std::string plugin_lines(const PluginResult& result, std::size_t width) {
  const Json all = summary(result);
  std::string text = fmt::format("{:<{}}", result.plugin, width) + rates(all, "") + normal_cell(all);
  const Json ms = times(result, &SceneResult::ms);
  text += "  " + cell(ms.is_null() ? Json() : ms["median"], 1) + " " +
          cell(ms.is_null() ? Json() : ms["max"], 1) + " ";
  for (const auto& [name, count] : all["faults"].items())
    text += fmt::format(" {:>6}", count.get<std::size_t>());
  text += "\n";
  if (all["iou"][0].contains("decidable"))
    text += fmt::format("{:<{}}", "  decidable", width) + rates(all, "decidable") + "\n";
  return text;
}

}  // namespace

std::string bench_em_table(const std::vector<PluginResult>& results,
                           const std::vector<planes::Score>& known) {
  std::size_t width = 12;
  for (const PluginResult& result : results) width = std::max(width, result.plugin.size());
  std::string text =
      fmt::format("{:<{}}   IoU 0.8       0.9           0.95        normal          ms\n", "", width);
  text += fmt::format(
      "{:<{}} prec.  rec.  prec.  rec.  prec.  rec.   error°  median    max  missing extra split merged "
      "stolen misal. unatt.\n",
      "plugin", width);
  for (const PluginResult& result : results) text += plugin_lines(result, width);
  if (!known.empty()) {
    const Json best = planes::scores_json(known);
    text += fmt::format("{:<{}}", "planes known", width) + rates(best, "") + normal_cell(best) + "\n";
  }
  if (results.empty()) return text;
  const Json all = summary(results.front());
  text += fmt::format("{} scenes, {} planes; {} more counted apart", results.front().scenes.size(),
                      all["true_planes"].get<std::size_t>(), all["apart"]["true_planes"].get<std::size_t>());
  if (known.empty()) return text + "\n";
  const auto undecidable = [&all](std::size_t i) {
    return all["true_planes"].get<std::size_t>() -
           all["iou"][i]["decidable"]["true_planes"].get<std::size_t>();
  };
  return text + fmt::format("; {}, {}, {} not decidable\n", undecidable(0), undecidable(1), undecidable(2));
}

Json bench_em_json(const std::vector<PluginResult>& results) {
  Json list = Json::array();
  for (const PluginResult& result : results) {
    Json scenes = Json::array();
    for (const SceneResult& scene : result.scenes) scenes.push_back(scene_json(scene));
    list.push_back({{"plugin", result.plugin},
                    {"id", result.id},
                    {"version", result.version},
                    {"ms", times(result, &SceneResult::ms)},
                    {"cpu_ms", times(result, &SceneResult::cpu_ms)},
                    {"score", summary(result)},
                    {"scenes", std::move(scenes)}});
  }
  return list;
}

}  // namespace hallway::cli
