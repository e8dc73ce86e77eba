// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "run/pictures.hpp"
#include "run/record.hpp"

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

std::optional<Vec3> parse_place(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto parts = split(text, ',');
  Vec3 place = Vec3::Zero();
  bool good = parts.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const auto number = parse_double(trim(parts[i]));
    good = number.has_value();
    if (good) place[static_cast<Eigen::Index>(i)] = *number;
  }
  if (!good) refuse(fmt::format("{} takes X,Y,Z in metres, not \"{}\"", option, printable(text)));
  return place;
}

sim::PictureSpec spec_of(const RenderOptions& options) {
  sim::PictureSpec spec;
  spec.file = options.out;
  spec.view = options.view == "top" ? sim::PictureView::kTop : sim::PictureView::kPerspective;
  parse_size(options.size, spec);
  spec.cut_z_m = options.cut_z_m;
  spec.eye_m = parse_place("--eye", options.eye);
  spec.target_m = parse_place("--target", options.target);
  if (spec.eye_m.has_value() != spec.target_m.has_value()) refuse("--eye and --target are given together");
  if (spec.eye_m && spec.view == sim::PictureView::kTop)
    refuse("--eye and --target belong to --view perspective");
  const std::vector<std::string>& layers = sim::picture_layer_names();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const bool wanted = options.show.empty() ||
                        std::find(options.show.begin(), options.show.end(), layers[i]) != options.show.end();
    if (wanted) spec.show.push_back(static_cast<sim::PictureLayer>(i));
  }
  return spec;
}

std::string draw_map(const RenderOptions& options, const sim::PictureSpec& spec) {
  const map::Document document = map::load(options.input);
  if (document.worldspawn() == nullptr) {
    throw Error(ErrorCode::kBadInput, "holds no map: it has no entity of class worldspawn",
                {.file = printable(options.input)});
  }
  const map::World world = map::build_world(document);
  for (const map::Problem& problem : world.problems) {
    const Error error(ErrorCode::kBadInput, problem.message,
                      {.file = printable(options.input),
                       .line = problem.line,
                       .element = map::brush_name(problem.entity, problem.brush)});
    if (options.strict) throw error;
    print_warning(std::string(error.what()) + "; left out");
  }
  return run::draw_map_picture(world, fs::path(options.input).stem().string(), spec);
}

int render(const RenderOptions& options) {
  const sim::PictureSpec spec = spec_of(options);
  std::error_code code;
  if (fs::exists(options.out, code) && !fs::is_regular_file(options.out, code)) {
    throw Error(ErrorCode::kIo, "is not a file that can be replaced", {.file = printable(options.out)});
  }
  const std::string png = fs::is_directory(options.input, code)
                              ? run::draw_run_picture(run::read_record(options.input), spec)
                              : draw_map(options, spec);
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
  command->add_option("--view", options->view, "top: like a plan; perspective: from a viewpoint")
      ->check(CLI::IsMember({"top", "perspective"}))
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
  command->add_option("--show", options->show, "What to show of a run [all]")
      ->delimiter(',')
      ->type_name("LAYER,...")
      ->check(CLI::IsMember(sim::picture_layer_names()));
  command->add_flag("--strict", options->strict, "Refuse a map with brushes that are no solids");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->footer(
      "Example: hallway render out/office --view perspective --out office.png --show map,truth,estimate");
  command->callback([&chosen, options] { chosen = [options] { return render(*options); }; });
}

}  // namespace hallway::cli
