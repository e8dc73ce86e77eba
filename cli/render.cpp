// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "renderer_option.hpp"
#include "run/pictures.hpp"
#include "run/record.hpp"
#include "show_list.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::string input;
  std::string view = "top";
  std::string out;
  std::string size = "1280x800";
  std::optional<double> cut_z_m;
  std::string eye;
  std::string target;
  std::vector<std::string> show;
  std::optional<std::string> renderer;
  bool strict = false;
  bool json = false;
};

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kUsage, message);
}

void parse_size(const std::string& text, sim::PictureSpec& spec) {
  const auto parts = split(text, 'x');
  const auto width = parts.size() == 2 ? parse_int(parts[0]) : std::nullopt;
  const auto height = parts.size() == 2 ? parse_int(parts[1]) : std::nullopt;
  constexpr std::int64_t kLargest = 100'000;  // what can be drawn is the renderer's to say
  if (!width || !height || *width < 0 || *height < 0 || *width > kLargest || *height > kLargest) {
    refuse(fmt::format("--size takes WIDTHxHEIGHT in pixels, e.g. 1280x800, not \"{}\"", printable(text)));
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
                                         : sim::PictureView::kPerspective;
  parse_size(options.size, spec);
  spec.cut_z_m = options.cut_z_m;
  spec.eye_m = optional_place("--eye", options.eye);
  spec.target_m = optional_place("--target", options.target);
  if (spec.eye_m.has_value() != spec.target_m.has_value()) refuse("--eye and --target are given together");
  if (spec.eye_m && spec.view != sim::PictureView::kPerspective)
    refuse("--eye and --target belong to --view perspective");
  return spec;
}

/// What is drawn, and how.
struct Drawing {
  sim::PictureSpec spec;
  ShowList show;
  render::Renderer renderer;
};

std::string draw_map(const RenderOptions& options, const Drawing& drawing) {
  MapRequest request{.file = options.input, .strict = options.strict};
  if (drawing.show.map.pvs_from_m) request.level = pvs::Level::kFull;
  CompiledMap compiled = compile_map(request);
  std::vector<render::Surface> meshes = model_faces(compiled, options.strict);
  const run::MapSubject subject{
      .world = compiled.world, .title = fs::path(options.input).stem().string(), .meshes = std::move(meshes)};
  return run::draw_map_picture(subject, drawing.spec, drawing.show.map, drawing.renderer);
}

std::string draw_run(const RenderOptions& options, const Drawing& drawing) {
  run::Record record = run::read_record(options.input);
  if (drawing.show.map.anything() && !record.world) {
    throw Error(ErrorCode::kBadInput, "has no map to show", {.file = printable(options.input, 4096)});
  }
  if (drawing.show.map.pvs_from_m) {
    const std::string map = (fs::path(options.input) / run::files::kMap).string();
    record.world = compile_map({.file = map, .level = pvs::Level::kFull, .use_cache = false}).world;
  }
  return run::draw_run_picture(record, drawing.spec, drawing.show.map, drawing.renderer);
}

int render(const RenderOptions& options) {
  Drawing drawing{spec_of(options), parse_show(options.show), chosen_renderer(options.renderer)};
  sim::PictureSpec& spec = drawing.spec;
  spec.show = drawing.show.run;
  check_output_file(options.out);
  std::error_code code;
  const bool is_run = fs::is_directory(options.input, code);
  if (!is_run && spec.view == sim::PictureView::kPanels) refuse("--view panels is of the folder of a run");
  const std::string png = is_run ? draw_run(options, drawing) : draw_map(options, drawing);
  write_file_atomically(options.out, png);
  if (options.json) {
    print_json({{"schema", "hallway.picture/1"},
                {"file", printable(options.out, 4096)},
                {"width_px", spec.width_px},
                {"height_px", spec.height_px},
                {"bytes", png.size()}});
  }
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand("render", "Draw a map, or what a run believed, as a PNG picture");
  const auto options = std::make_shared<RenderOptions>();
  command->add_option("input", options->input, "A .map file, or the folder of a run")
      ->required()
      ->type_name("MAP|RUN");
  command
      ->add_option("--view", options->view,
                   "top: like a plan; perspective: from a viewpoint; panels: of a run in which planes were "
                   "found in points, four in one")
      ->check(CLI::IsMember({"top", "perspective", "panels"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "PNG file to write; an earlier one is replaced")
      ->required()
      ->type_name("FILE");
  command->add_option("--size", options->size, "Width and height in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command
      ->add_option("--cut", options->cut_z_m,
                   "Cut away what stands above this height (metres) [what opens a closed building]")
      ->type_name("Z");
  command->add_option("--eye", options->eye, "perspective: viewpoint in metres [what shows everything]")
      ->type_name("X,Y,Z");
  command->add_option("--target", options->target, "perspective: the place looked at")->type_name("X,Y,Z");
  command
      ->add_option(
          "--show", options->show,
          "What to show. Of a run [all]: " + run_layer_names() + ". Of the map: " + map_layer_names())
      ->type_name("LAYER,...")
      ->take_all()
      ->expected(1);
  add_renderer_option(*command, options->renderer);
  command->add_flag("--strict", options->strict, "Refuse a map with brushes that are no solids");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->footer(
      "Examples: hallway render out/office --view perspective --out office.png --show map,truth,estimate\n"
      "          hallway render maps/office.map --out seen.png --show pvs-from=2,3,1.5,portals");
  command->callback([&chosen, options] { chosen = [options] { return render(*options); }; });
}

}  // namespace hallway::cli
