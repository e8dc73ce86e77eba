// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "batch/table.hpp"
#include "eval/metrics_json.hpp"
#include "record/version.hpp"
#include "study/curves.hpp"
#include "study/study.hpp"

namespace hallway::study {
namespace {

using Json = nlohmann::ordered_json;

/// The columns that name a run.
std::vector<std::string> label_columns(const std::vector<StudyRun>& runs) {
  std::vector<std::string> columns;
  if (!runs.empty()) {
    for (const RunLabel& label : runs.front().spec.labels) columns.push_back(label.name);
  }
  columns.insert(columns.end(), {"plugin", "seed"});
  return columns;
}

std::vector<Field> label_fields(const RunSpec& spec) {
  std::vector<Field> fields;
  for (const RunLabel& label : spec.labels) fields.emplace_back(label.value);
  fields.emplace_back(spec.plugin.label());
  fields.emplace_back(static_cast<double>(spec.seed));
  return fields;
}

/// Adds a column for every name that one of the lists has.
void add_columns(const std::vector<std::vector<std::pair<std::string, double>>>& lists, Table& table) {
  for (const auto& list : lists) {
    for (const auto& [name, value] : list) {
      if (std::find(table.columns.begin(), table.columns.end(), name) == table.columns.end())
        table.columns.push_back(name);
    }
  }
}

/// A row for each run: its labels, failure and verdict, then its numbers by name.
Table numbers_table(const std::vector<StudyRun>& runs,
                    const std::vector<std::vector<std::pair<std::string, double>>>& numbers) {
  Table table{.columns = label_columns(runs)};
  table.columns.insert(table.columns.end(), {"failure", "verdict"});
  const std::size_t first = table.columns.size();
  add_columns(numbers, table);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<Field> row = label_fields(runs[i].spec);
    row.emplace_back(runs[i].trace.failure.empty() ? Field() : Field(runs[i].trace.failure));
    const auto& verdict = runs[i].trace.metrics.verdict;
    row.emplace_back(verdict ? Field(eval::name_of(*verdict)) : Field());
    row.resize(table.columns.size());
    for (const auto& [name, value] : numbers[i]) {
      const auto at =
          std::find(table.columns.begin() + static_cast<std::ptrdiff_t>(first), table.columns.end(), name);
      row[static_cast<std::size_t>(at - table.columns.begin())] = value;
    }
    table.add(std::move(row));
  }
  return table;
}

bool is_time(const std::string& name) {
  return name.starts_with("iteration_ms") || name.starts_with("iteration_cpu_ms");
}

/// Counters whose names end in a unit of time hold facts of the clock.
bool is_time_counter(const std::string& name) {
  return name.ends_with("_us") || name.ends_with("_ms") || name.ends_with("_ns") || name.ends_with("_s");
}

std::vector<std::pair<std::string, double>> numbers_of(const StudyRun& run, bool times) {
  std::vector<std::pair<std::string, double>> numbers;
  for (auto& [name, value] : batch::numbers_of(eval::to_json(run.trace.metrics))) {
    if (is_time(name) == times) numbers.emplace_back(name, value);
  }
  for (const CounterMean& counter : run.trace.counters) {
    if (is_time_counter(counter.name) != times) continue;
    numbers.emplace_back("counter." + counter.name + ".mean", counter.mean);
    numbers.emplace_back("counter." + counter.name + ".last", counter.last);
  }
  return numbers;
}

Table runs_table(const std::vector<StudyRun>& runs, bool times) {
  std::vector<std::vector<std::pair<std::string, double>>> numbers;
  for (const StudyRun& run : runs) numbers.push_back(numbers_of(run, times));
  Table table = numbers_table(runs, numbers);
  table.file = times ? "times" : "runs";
  table.clock = times;
  return table;
}

/// A row for each look at the map: the run's labels, the iterations, and what `fields` gives of the look and of the part before it.
template <typename Fields>
Table samples_table(const std::vector<StudyRun>& runs, Table table, const std::vector<std::string>& columns,
                    Fields fields) {
  table.columns = label_columns(runs);
  table.columns.push_back("iterations");
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (const StudyRun& run : runs) {
    std::size_t begin = 0;
    for (const MapSample& sample : run.trace.samples) {
      std::vector<Field> row = label_fields(run.spec);
      row.emplace_back(static_cast<double>(sample.iterations));
      for (Field& one : fields(sample, part_means(run.trace, begin, sample.iterations)))
        row.push_back(std::move(one));
      row.resize(table.columns.size());
      table.add(std::move(row));
      begin = sample.iterations;
    }
  }
  return table;
}

/// What happened between two looks at the map.
Table curves_table(const std::vector<StudyRun>& runs) {
  return samples_table(runs, {.file = "curves"},
                       {"visible_mean", "landmarks_mapped", "landmark_error_sum_m",
                        "landmark_rmse_first_pose_m", "landmark_rmse_aligned_m", "position_error_mean_m",
                        "x_error_mean_m", "y_error_mean_m", "z_error_mean_m"},
                       [](const MapSample& sample, const PartMeans& part) {
                         std::vector<Field> fields{part.visible, static_cast<double>(sample.mapped),
                                                   field(sample.error_sum_m), field(sample.rmse_first_pose_m),
                                                   field(sample.rmse_aligned_m)};
                         if (part.error) {
                           const Vec3& mean = part.error->signed_mean;
                           fields.insert(fields.end(), {part.error->distance, mean.x(), mean.y(), mean.z()});
                         }
                         return fields;
                       });
}

Table times_curves_table(const std::vector<StudyRun>& runs) {
  return samples_table(
      runs, {.file = "times_curves", .clock = true}, {"cpu_mean_ms"},
      [](const MapSample&, const PartMeans& part) { return std::vector<Field>{part.cpu_ms}; });
}

Json chart_entry(const Chart& chart) {
  return {{"file", chart.file}, {"title", chart.title}, {"figures", chart.figures}, {"clock", chart.clock}};
}

}  // namespace

std::vector<Table> common_tables(const std::vector<StudyRun>& runs) {
  return {runs_table(runs, false), curves_table(runs), runs_table(runs, true), times_curves_table(runs)};
}

Json write_outcome(const Study& study, const Request& request, const Outcome& outcome,
                   const std::filesystem::path& folder) {
  make_folder(folder);
  Json plugins = Json::array();
  for (const PluginChoice& plugin : request.plugins) plugins.push_back(plugin.label());
  Json document{{"schema", "hallway.study/1"},  {"study", study.name}, {"figures", study.figures},
                {"version", record::version()}, {"plugins", plugins},  {"seeds", request.seeds},
                {"quick", request.quick}};
  document["charts"] = Json::array();
  for (const Chart& chart : outcome.charts) {
    document["charts"].push_back(chart_entry(chart));
    write_file_atomically(folder / (chart.file + ".svg"), print_svg(chart));
    write_file_atomically(folder / (chart.file + ".png"), print_png(chart));
  }
  document["tables"] = Json::object();
  document["times"] = Json::object();
  for (const Table& table : outcome.tables) {
    write_file_atomically(folder / (table.file + ".csv"), print_csv(table));
    document[table.clock ? "times" : "tables"][table.file] = to_json(table);
  }
  write_file_atomically(folder / "study.json", document.dump(1) + "\n");
  return document;
}

}  // namespace hallway::study
