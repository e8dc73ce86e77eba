// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cloud_options.hpp"
#include "command.hpp"
#include "console.hpp"
#include "finder_options.hpp"
#include "output_file.hpp"
#include "planes/files.hpp"
#include "planes/picture.hpp"
#include "render/png.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

constexpr const char* kDocumentFile = "planes.json";

struct PlanesOptions {
  std::string cloud;
  std::string plugin;
  CloudInput input;
  std::string labels;
  std::int64_t unlabelled = planes::kNoLabel;
  FinderOptions finder;
};

/// A cloud, what a plugin made of it, and how well, where labels are known.
struct Found {
  planes::Cloud cloud{};
  planes::Answer answer{};
  host::PluginInfo plugin{};
  std::optional<planes::Truth> truth{};
  std::optional<planes::Score> score{};
};

Found find(const PlanesOptions& options) {
  planes::CloudOptions reading = cloud_options(options.input);
  reading.unlabelled = options.unlabelled;
  Found found{.cloud = planes::read_cloud(options.cloud, reading)};
  if (!options.labels.empty())
    found.cloud.labels = planes::read_labels(options.labels, found.cloud, options.unlabelled);
  const auto finder = std::move(finders_of({options.plugin}, options.finder).front());
  found.plugin = finder->info();
  found.answer = finder->find(found.cloud.points, options.finder.repeat, found.cloud.image);
  if (!found.cloud.labels.empty()) {
    found.truth = planes::truth_of_labels(found.cloud);
    found.score = planes::score_planes(found.cloud.points, *found.truth, found.answer.planes);
  }
  return found;
}

Json document_of(const PlanesOptions& options, const Found& found) {
  return {{"schema", "hallway.planes/1"},
          {"cloud", path_text(options.cloud)},
          {"rows", found.cloud.n_rows},
          {"points", found.cloud.points.size()},
          {"not_finite", found.cloud.not_finite},
          {"plugin", {{"id", found.plugin.id}, {"version", found.plugin.version}}},
          {"ms", found.answer.ms},
          {"cpu_ms", found.answer.cpu_ms},
          {"planes", planes::planes_json(found.cloud, found.answer.planes)},
          {"score", found.score ? planes::score_json(*found.score, *found.truth) : Json()}};
}

std::string draw(const PlanesOptions& options, const Found& found) {
  const planes::PictureContent content{found.cloud.points, found.answer.planes,
                                       printable(fs::path(options.cloud).filename().string()),
                                       fmt::format("{} · {} planes of {} points", found.plugin.id,
                                                   found.answer.planes.size(), found.cloud.points.size())};
  const render::View view = plane_view(options.finder);
  return render::encode_png(found.score
                                ? planes::draw_comparison(content, *found.truth, *found.score, view, {})
                                : planes::draw_planes(content, view, {}));
}

void write_files(const PlanesOptions& options, const Found& found, const Json& document) {
  const fs::path folder = options.finder.out;
  make_folder(folder);
  write_file_atomically(folder / kDocumentFile, document.dump(1) + "\n");
  write_file_atomically(folder / "planes.ply", planes::print_ply(found.cloud, found.answer.planes));
  write_file_atomically(folder / "planes.png", draw(options, found));
}

std::string table(const Found& found) {
  std::string text = fmt::format("{:>5} {:>8} {:>27} {:>10} {:>9} {:>6}\n", "plane", "points", "normal",
                                 "offset", "rms", "excl");
  for (std::size_t i = 0; i < found.answer.planes.size(); ++i) {
    const PlaneObservation& plane = found.answer.planes[i];
    const Vec3& n = plane.plane.normal;
    text += fmt::format("{:>5} {:>8} {:>9.4f}{:>9.4f}{:>9.4f} {:>10.4g} {:>9.3g} {:>6.2f}\n", i, plane.points,
                        n.x(), n.y(), n.z(), plane.plane.offset, plane.rms, plane.exclusive_share);
  }
  text += fmt::format("{} planes in {} points, {:.2f} ms\n", found.answer.planes.size(),
                      found.cloud.points.size(), found.answer.ms);
  if (!found.score) return text;
  const planes::Score& score = *found.score;
  text += fmt::format("{} of {} labelled planes found at IoU 0.8, {} at 0.9, {} at 0.95; {} counted apart\n",
                      score.matched[0], score.truths, score.matched[1], score.matched[2], score.apart);
  std::string extra;
  for (const planes::Fault& fault : score.faults) {
    if (fault.kind != planes::FaultKind::kExtra) {
      text += "  " + planes::fault_text(fault, *found.truth) + "\n";
      continue;
    }
    for (const std::size_t plane : fault.found) extra += fmt::format(" {}", plane);
  }
  // One line for all: where only some planes are labelled, most that are found are extra.
  if (!extra.empty()) text += "  extra:" + extra + "\n";
  return text;
}

int planes_of(const PlanesOptions& options) {
  if (!options.finder.out.empty())
    check_output_folder(options.finder.out, kDocumentFile, options.finder.force);
  const Found found = find(options);
  const Json document = document_of(options, found);
  if (!options.finder.out.empty()) write_files(options, found, document);
  if (found.cloud.not_finite > 0)
    print_warning("{} of {} rows are no points: a coordinate is not finite", found.cloud.not_finite,
                  found.cloud.n_rows);
  options.finder.print(document, table(found));
  return 0;
}

void add_input_options(Command& command, PlanesOptions& options) {
  command
      .argument("cloud", &options.cloud,
                "Points: PLY, PCD, CSV with a header (x, y, z, label), OBJ, or a depth image in PNG")
      .required()
      .value("CLOUD");
  add_cloud_options(command, options.input);
  command
      .option("--labels", &options.labels,
              "Labels to score against: a whole number for each row of the cloud")
      .value("FILE");
  command
      .option("--unlabelled", &options.unlabelled,
              "Label of points that belong to no plane, beside all negative ones")
      .value("N")
      .show_default();
}

}  // namespace

void add_planes_command(Command& app) {
  Command& command = app.command("planes", "Find planes in a point cloud with a plugin");
  PlanesOptions& options = command.runs(&planes_of);
  add_input_options(command, options);
  add_shared(command, Shared::kPlugin, &options.plugin).required();
  add_shared(command, Shared::kSetPlugin, &options.finder.settings).repeatable();
  add_finder_options(command, options.finder);
  add_finder_output_options(command, options.finder);
  command.footer(
      "With labels (a column of the file, or --labels) the planes are scored, and the picture shows the "
      "labelled ones beside "
      "them.\n"
      "Example: hallway planes room.pcd --plugin em --out out/room");
}

}  // namespace hallway::cli
