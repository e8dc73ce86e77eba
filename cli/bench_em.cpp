// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "bench_em_report.hpp"
#include "command.hpp"
#include "console.hpp"
#include "finder_options.hpp"
#include "output_file.hpp"
#include "planes/files.hpp"
#include "planes/oracle.hpp"
#include "planes/picture.hpp"
#include "planes/scene_files.hpp"
#include "render/png.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

constexpr const char* kDocumentFile = "results.json";

struct BenchOptions {
  std::vector<std::string> plugins;
  std::uint32_t scenes = 20;
  std::uint64_t seed = 1;
  std::string planes = "3..40";
  std::string points = "300..30000";
  std::string sigma = "0.005..0.05";
  std::string half_size = "0.5..2";
  double outliers = 0.1;
  std::string scenes_dir;
  std::uint32_t pictures = 3;
  bool write_scenes = false;
  FinderOptions finder;
};

/// "LOW..HIGH", or one number for both.
planes::Range<double> parse_range(const char* option, const std::string& text) {
  const std::size_t dots = text.find("..");
  const auto low = parse_double(text.substr(0, dots));
  const auto high = dots == std::string::npos ? low : parse_double(text.substr(dots + 2));
  if (low && high && *low <= *high) return {*low, *high};
  refuse("{} takes LOW..HIGH, not \"{}\"", option, printable(text));
}

planes::Range<std::uint32_t> parse_counts(const char* option, const std::string& text) {
  const planes::Range<double> range = parse_range(option, text);
  constexpr double kMost = 5e6;
  const auto whole = [](double number) {
    return static_cast<double>(static_cast<std::uint32_t>(number)) == number;
  };
  if (range.low < 1 || range.high > kMost || !whole(range.low) || !whole(range.high))
    refuse("{} takes whole numbers from 1 to 5000000", option);
  return {static_cast<std::uint32_t>(range.low), static_cast<std::uint32_t>(range.high)};
}

/// Scenes by number: generated, or those of a folder.
class Scenes {
 public:
  explicit Scenes(const BenchOptions& options) : seed_(options.seed), count_(options.scenes) {
    if (!options.scenes_dir.empty()) {
      files_ = planes::list_scenes(options.scenes_dir);
      count_ = static_cast<std::uint32_t>(files_.size());
      return;
    }
    shape_.planes = parse_counts("--planes", options.planes);
    shape_.points = parse_counts("--points", options.points);
    shape_.noise = parse_range("--sigma", options.sigma);
    shape_.half_size = parse_range("--half-size", options.half_size);
    shape_.outliers = options.outliers;
    planes::make_scene(seed_, 0, shape_);  // what is wrong with the options is said before any work
  }

  std::uint32_t count() const { return count_; }
  std::string name(std::uint32_t i) const {
    return files_.empty() ? fmt::format("scene_{:02}", i) : files_[i].name;
  }
  planes::LabelledCloud get(std::uint32_t i) const {
    return files_.empty() ? planes::as_read(planes::make_scene(seed_, i, shape_))
                          : planes::read_scene(files_[i]);
  }
  bool generated() const { return files_.empty(); }
  void write(std::uint32_t i, const fs::path& folder) const {
    const planes::Scene scene = planes::make_scene(seed_, i, shape_);
    write_file_atomically(folder / (name(i) + ".csv"), planes::print_scene_points(scene));
    write_file_atomically(folder / (name(i) + "_planes.csv"), planes::print_scene_planes(scene));
  }

 private:
  std::uint64_t seed_;
  std::uint32_t count_;
  planes::SceneOptions shape_{};
  std::vector<planes::SceneFile> files_;
};

/// A plugin and what it has made of the scenes so far.
struct Contender {
  std::unique_ptr<planes::PlaneFinder> finder;
  PluginResult result;
};

std::vector<Contender> contenders(const BenchOptions& options) {
  std::vector<Contender> list;
  for (auto& finder : finders_of(options.plugins, options.finder)) {
    const host::PluginInfo& info = finder->info();
    PluginResult result{
        .plugin = printable(options.plugins[list.size()]), .id = info.id, .version = info.version};
    list.push_back({std::move(finder), std::move(result)});
  }
  return list;
}

/// The score of planes::answer_knowing(); none where the scene does not tell enough for that.
std::optional<planes::Score> score_knowing(const planes::LabelledCloud& scene) {
  const auto answer = planes::answer_knowing(scene.cloud.points, scene.truth);
  if (answer.empty()) return std::nullopt;
  return planes::score_planes(scene.cloud.points, scene.truth, answer);
}

void try_scene(Contender& contender, const std::string& name, const planes::LabelledCloud& scene,
               unsigned repeat, const std::optional<planes::Score>& known) {
  const planes::Answer answer = contender.finder->find(scene.cloud.points, repeat);
  contender.result.scenes.push_back(
      {.scene = name,
       .points = scene.cloud.points.size(),
       .noise = scene.truth.noise,
       .ms = answer.ms,
       .cpu_ms = answer.cpu_ms,
       .score = planes::score_planes(scene.cloud.points, scene.truth, answer.planes)});
  if (known) planes::count_decidable(*known, contender.result.scenes.back().score);
}

/// The scenes with most faults, first of all; ties by number.
std::vector<std::uint32_t> worst(const PluginResult& result, std::size_t most) {
  std::vector<std::uint32_t> order(result.scenes.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return result.scenes[a].score.faults.size() > result.scenes[b].score.faults.size();
  });
  order.resize(std::min(order.size(), most));
  return order;
}

/// A name of files for a plugin as it was asked for.
std::string file_name(const std::string& plugin) {
  std::string name = plugin;
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || c == '.' || c == '=';
    if (!plain) c = '_';
  }
  return name;
}

void draw_worst(const BenchOptions& options, const Scenes& scenes, Contender& contender) {
  for (const std::uint32_t i : worst(contender.result, options.pictures)) {
    const planes::LabelledCloud scene = scenes.get(i);
    const planes::Answer answer = contender.finder->find(scene.cloud.points);
    const planes::Score score = planes::score_planes(scene.cloud.points, scene.truth, answer.planes);
    const render::Image image =
        planes::draw_comparison({scene.cloud.points, answer.planes, contender.result.plugin,
                                 fmt::format("{} · {} of {} planes at IoU 0.8 · {} faults", scenes.name(i),
                                             score.matched[0], score.truths, score.faults.size())},
                                scene.truth, score, plane_view(options.finder), {});
    write_file_atomically(fs::path(options.finder.out) /
                              fmt::format("{}-{}.png", scenes.name(i), file_name(contender.result.plugin)),
                          render::encode_png(image));
  }
}

Json document_of(const BenchOptions& options, const Scenes& scenes, const std::vector<PluginResult>& results,
                 const std::vector<planes::Score>& known) {
  Json json{{"schema", "hallway.bench_em/1"}, {"scenes", scenes.count()}};
  if (scenes.generated()) {
    json["seed"] = options.seed;
    json["options"] = {{"planes", options.planes},
                       {"points", options.points},
                       {"sigma", options.sigma},
                       {"half_size", options.half_size},
                       {"outliers", options.outliers}};
  } else {
    json["scenes_dir"] = path_text(options.scenes_dir);
  }
  json["plugins"] = bench_em_json(results);
  if (!known.empty()) json["planes_known"] = planes::scores_json(known);
  return json;
}

int bench_em(const BenchOptions& options) {
  if (options.write_scenes && (options.finder.out.empty() || !options.scenes_dir.empty()))
    refuse("--write-scenes writes generated scenes to the folder of --out");
  const Scenes scenes(options);
  std::vector<Contender> plugins = contenders(options);
  if (!options.finder.out.empty()) {
    check_output_folder(options.finder.out, kDocumentFile, options.finder.force);
    make_folder(options.finder.out);
  }
  catch_interrupts();
  std::vector<planes::Score> known;  // of all scenes, or none
  {
    Progress progress("scenes", scenes.count(), options.finder.quiet || options.finder.json);
    for (std::uint32_t i = 0; i < scenes.count(); ++i) {
      if (interrupted()) throw Error(ErrorCode::kInterrupted, "interrupted");
      const planes::LabelledCloud scene = scenes.get(i);
      const std::optional<planes::Score> best = score_knowing(scene);
      if (best) known.push_back(*best);
      for (Contender& contender : plugins)
        try_scene(contender, scenes.name(i), scene, options.finder.repeat, best);
      if (options.write_scenes) scenes.write(i, options.finder.out);
      progress.update(i + 1);
    }
  }
  if (known.size() < scenes.count()) known.clear();
  std::vector<PluginResult> results;
  for (Contender& contender : plugins) results.push_back(contender.result);
  const Json document = document_of(options, scenes, results, known);
  if (!options.finder.out.empty()) {
    for (Contender& contender : plugins) draw_worst(options, scenes, contender);
    write_file_atomically(fs::path(options.finder.out) / kDocumentFile, document.dump(1) + "\n");
  }
  options.finder.print(document, bench_em_table(results, known));
  return 0;
}

void add_scene_options(Command& command, BenchOptions& options) {
  command.option("--scenes", &options.scenes, "Number of scenes")
      .range(1u, 1'000'000u)
      .value("N")
      .show_default();
  add_shared(command, Shared::kSeed, &options.seed).show_default();
  command.option("--planes", &options.planes, "Planes of a scene").value("LOW..HIGH").show_default();
  command.option("--points", &options.points, "Points of a scene").value("LOW..HIGH").show_default();
  command.option("--sigma", &options.sigma, "Noise of a scene, metres along each axis")
      .value("LOW..HIGH")
      .show_default();
  command.option("--half-size", &options.half_size, "Half sides of a scene's rectangles, metres")
      .value("LOW..HIGH")
      .show_default();
  command.option("--outliers", &options.outliers, "Most outliers of a scene, as a share of its points")
      .range(0.0, 0.9)
      .value("X")
      .show_default();
  command
      .option("--scenes-dir", &options.scenes_dir,
              "Scenes NAME.csv (x,y,z,label) and NAME_planes.csv of a folder instead")
      .value("DIR");
}

}  // namespace

void add_bench_em_command(Command& app) {
  Command& command =
      app.command("bench-em", "Score plugins that find planes on scenes whose planes are known");
  BenchOptions& options = command.runs(&bench_em);
  add_shared(command, Shared::kPlugin, &options.plugins).required().repeatable();
  add_shared(command, Shared::kSetPlugin, &options.finder.settings).repeatable();
  add_scene_options(command, options);
  add_finder_options(command, options.finder);
  command
      .option("--pictures", &options.pictures, "Of how many scenes, those with most faults, for each plugin")
      .value("N")
      .show_default();
  command.flag("--write-scenes", &options.write_scenes, "Write the scenes too");
  add_finder_output_options(command, options.finder);
  command.footer(
      "Planes of fewer than 20 points, and parallel ones nearer than 5 sigma, are counted apart.\n"
      "Decidable are the planes that a labelling which knows all of them gets right.\n"
      "Example: hallway bench-em --plugin em --plugin em2 --scenes 200 --seed 7 --out out/bench");
}

}  // namespace hallway::cli
