// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "map/robot_file.hpp"
#include "output_file.hpp"
#include "renderer_option.hpp"
#include "run/pictures/pictures.hpp"
#include "run/pictures/record.hpp"
#include "shared_options.hpp"
#include "show_list.hpp"

namespace hallway::cli {
namespace {

struct RenderOptions {
  std::string input;
  std::string view = "top";
  std::string out;
  std::string size = "1280x800";
  std::optional<double> cut_z_m;
  std::string eye;
  std::string target;
  std::string area;
  std::optional<double> fov_deg;
  std::vector<std::string> show;
  std::vector<std::string> hide;
  std::optional<double> error_scale;
  std::optional<std::uint32_t> iteration;
  std::optional<std::string> renderer;
  bool strict = false;
  bool json = false;
};

void parse_size(const std::string& text, sim::PictureSpec& spec) {
  const auto parts = split(text, 'x');
  const auto width = parts.size() == 2 ? parse_int(parts[0]) : std::nullopt;
  const auto height = parts.size() == 2 ? parse_int(parts[1]) : std::nullopt;
  constexpr std::int64_t kLargest = 100'000;  // what can be drawn is the renderer's to say
  if (!width || !height || *width < 0 || *height < 0 || *width > kLargest || *height > kLargest) {
    refuse("--size takes WIDTHxHEIGHT in pixels, e.g. 1280x800, not \"{}\"", printable(text));
  }
  spec.width_px = static_cast<int>(*width);
  spec.height_px = static_cast<int>(*height);
}

std::optional<Vec3> optional_place(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  return parse_place(option, text);
}

sim::PictureSpec spec_of(const RenderOptions& options) {
  sim::PictureSpec spec;
  spec.file = options.out;
  spec.view = options.view == "top"      ? sim::PictureView::kTop
              : options.view == "panels" ? sim::PictureView::kPanels
              : options.view == "camera" ? sim::PictureView::kCamera
                                         : sim::PictureView::kPerspective;
  spec.iteration = options.iteration;
  if (spec.iteration && spec.view == sim::PictureView::kPanels)
    refuse("--view panels shows no single iteration");
  parse_size(options.size, spec);
  spec.cut_z_m = options.cut_z_m;
  spec.eye_m = optional_place("--eye", options.eye);
  spec.target_m = optional_place("--target", options.target);
  if (spec.eye_m.has_value() != spec.target_m.has_value()) refuse("--eye and --target are given together");
  if (spec.eye_m && spec.view != sim::PictureView::kPerspective)
    refuse("--eye and --target belong to --view perspective");
  return spec;
}

/// X0,Y0,X1,Y1: two opposite corners.
Eigen::AlignedBox2d parse_area(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ',')) {
    const auto number = parse_double(trim(part));
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  Eigen::AlignedBox2d area;
  if (numbers.size() == 4 && split(text, ',').size() == 4) {
    area.extend(Vec2(numbers[0], numbers[1]));
    area.extend(Vec2(numbers[2], numbers[3]));
  }
  if (area.isEmpty() || !(area.sizes().minCoeff() > 0.0))
    refuse("--area takes X0,Y0,X1,Y1, two corners in metres, not \"{}\"", printable(text));
  return area;
}

run::DrawOptions draw_options_of(const RenderOptions& options) {
  run::DrawOptions drawn{.renderer = chosen_renderer(options.renderer), .error_scale = options.error_scale};
  if (!options.area.empty()) {
    if (options.view != "top") refuse("--area belongs to --view top");
    drawn.area = parse_area(options.area);
  }
  if (options.fov_deg) {
    if (options.view != "perspective") refuse("--fov belongs to --view perspective");
    drawn.vertical_fov = *options.fov_deg * std::numbers::pi / 180.0;
  }
  return drawn;
}

/// What is drawn, and how.
struct Drawing {
  sim::PictureSpec spec;
  ShowList show;
  run::DrawOptions options;
};

/// An empty picture would look like an empty map.
void warn_of_area(const Drawing& drawing, const world::CompiledWorld& world) {
  const Box& bounds = world.partition.tree.bounds;
  if (!drawing.options.area || bounds.isEmpty()) return;
  const Eigen::AlignedBox2d ground(bounds.min().head<2>(), bounds.max().head<2>());
  if (ground.intersects(*drawing.options.area)) return;
  print_warning("--area shows no brush: they are between {:.1f},{:.1f} and {:.1f},{:.1f}", ground.min().x(),
                ground.min().y(), ground.max().x(), ground.max().y());
}

std::string draw_robot(const RenderOptions& options, const Drawing& drawing, const map::Document& document) {
  if (drawing.show.map.anything())
    refuse("--show {} is of a map with a world, not of a robot file", options.show.front());
  return run::draw_robot_picture(map::read_robot(document), fs::path(options.input).stem().string(),
                                 drawing.spec, drawing.show.things, drawing.options);
}

std::string draw_map(const RenderOptions& options, const Drawing& drawing) {
  if (const map::Document document = load_map(options.input); map::is_robot_file(document))
    return draw_robot(options, drawing, document);
  MapRequest request{.file = options.input, .strict = options.strict};
  if (drawing.show.map.pvs_from_m) request.level = pvs::Level::kFull;
  CompiledMap compiled = compile_map(request);
  warn_of_area(drawing, compiled.world);
  std::vector<render::Surface> meshes = model_faces(compiled, options.strict);
  const run::MapSubject subject{.world = compiled.world,
                                .title = fs::path(options.input).stem().string(),
                                .meshes = std::move(meshes),
                                .document = &compiled.document,
                                .things = drawing.show.things};
  return run::draw_map_picture(subject, drawing.spec, drawing.show.map, drawing.options);
}

std::string draw_run(const RenderOptions& options, const Drawing& drawing) {
  if (!drawing.show.thing.empty())
    refuse("--show {} is of a map, not of the folder of a run", drawing.show.thing);
  run::Record record = run::read_record(options.input);
  sim::PictureSpec spec = drawing.spec;
  if (spec.iteration || spec.view == sim::PictureView::kCamera) {
    run::read_history(record);
    if (!spec.iteration) spec.iteration = run::last_iteration(record);
  }
  if (drawing.show.map.anything() && !record.world) {
    throw Error(ErrorCode::kBadInput, "has no map to show", {.file = path_text(options.input)});
  }
  if (drawing.show.map.pvs_from_m) {
    const std::string map = (fs::path(options.input) / run::files::kMap).string();
    record.world = compile_map({.file = map, .level = pvs::Level::kFull, .use_cache = false}).world;
  }
  if (record.world) warn_of_area(drawing, *record.world);
  return run::draw_run_picture(record, spec, drawing.show.map, drawing.options);
}

int render(const RenderOptions& options) {
  Drawing drawing{spec_of(options), parse_show(options.show, options.hide), draw_options_of(options)};
  sim::PictureSpec& spec = drawing.spec;
  spec.show = drawing.show.run;
  check_picture_file(options.out);
  std::error_code code;
  const bool is_run = fs::is_directory(options.input, code);
  if (!is_run && spec.view == sim::PictureView::kPanels) refuse("--view panels is of the folder of a run");
  if (!is_run && spec.view == sim::PictureView::kCamera) refuse("--view camera is of the folder of a run");
  if (!is_run && spec.iteration) refuse("--iteration is of the folder of a run");
  const std::string ending = fs::path(options.input).extension().string();
  if (!is_run && (ending == ".toml" || ending == ".mcap" || ending == ".csv"))
    throw Error(ErrorCode::kBadInput,
                "is neither a map nor the folder of a run; `hallway run` makes such a folder",
                {.file = path_text(options.input)});
  const std::string png = is_run ? draw_run(options, drawing) : draw_map(options, drawing);
  write_file_atomically(options.out, png);
  if (options.json) {
    print_json({{"schema", "hallway.picture/1"},
                {"file", path_text(options.out)},
                {"width_px", spec.width_px},
                {"height_px", spec.height_px},
                {"bytes", png.size()}});
  }
  return 0;
}

}  // namespace

void add_render_command(Command& app) {
  Command& command = app.command("render", "Draw a map, or the map that a run estimated, as a PNG picture");
  RenderOptions& options = command.runs(&render);
  command.argument("input", &options.input, "A .map file, of a robot too, or the folder of a run")
      .required()
      .value("MAP|RUN");
  add_shared(command, Shared::kView, &options.view)
      .choices({"top", "perspective", "panels", "camera"})
      .show_default();
  add_shared(command, Shared::kOutFile, &options.out).required();
  command.option("--size", &options.size, "Width and height in pixels").value("WxH").show_default();
  command
      .option("--cut", &options.cut_z_m,
              "Cut away everything above this height (metres) [what opens a closed building]")
      .value("Z");
  command.option("--eye", &options.eye, "perspective: viewpoint in metres [what shows everything]")
      .value("X,Y,Z");
  command.option("--target", &options.target, "perspective: the place looked at").value("X,Y,Z");
  command
      .option("--fov", &options.fov_deg,
              "perspective: angle from the lower to the upper edge, degrees [34.4]")
      .value("DEG")
      .range(1.0, 170.0);
  command.option("--area", &options.area, "top: the ground to show, by two corners in metres [everything]")
      .value("X0,Y0,X1,Y1");
  command
      .option("--show", &options.show,
              "Show more. Of a run: " + run_layer_names() + " [all but submaps]. Of a map alone: " +
                  thing_layer_names() + " [all]. Of the map of either: " + map_layer_names() + " [none]")
      .value("LAYER,...")
      .repeatable();
  command.option("--hide", &options.hide, "Show less: layers as of --show, or all; --show counts after it")
      .value("LAYER,...")
      .repeatable();
  command
      .option("--error-scale", &options.error_scale,
              "Of a run: draw errors of landmarks longer by this factor [a power of ten that shows them]")
      .value("X")
      .range(1e-6, 1e9);
  command
      .option("--iteration", &options.iteration,
              "Of a run: the robot at this iteration, with what it saw, did and touched until then [the "
              "whole run]")
      .value("N");
  add_renderer_option(command, options.renderer);
  add_shared(command, Shared::kStrict, &options.strict);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Examples: hallway render out/office --view perspective --out office.png --hide errors\n"
      "          hallway render out/office --iteration 120 --out at_120.png --hide estimate\n"
      "          hallway render maps/office.map --out seen.png --show pvs-from=2,3,1.5,portals");
}

}  // namespace hallway::cli
