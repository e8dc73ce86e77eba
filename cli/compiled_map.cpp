// SPDX-License-Identifier: MIT
#include "compiled_map.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "map/reader.hpp"
#include "run/pictures/map_view.hpp"

namespace hallway::cli {
namespace {

/// Shows how far the visible sets are; ends them when the user asks for it.
class VisibilityProgress {
 public:
  void operator()(std::size_t done, std::size_t total) {
    if (!bar_) {
      // Until here Ctrl-C ends the program at once: there is nothing to put in order.
      catch_interrupts();
      bar_ = std::make_unique<Progress>("visibility", total, false);
    }
    bar_->update(done);
    if (interrupted()) throw Error(ErrorCode::kInterrupted, "interrupted");
  }

 private:
  std::unique_ptr<Progress> bar_;
};

std::vector<Error> problems_of(const MapRequest& request, const world::CompiledWorld& world) {
  std::vector<Error> problems;
  for (const map::Problem& problem : world.brushes.problems) {
    problems.emplace_back(ErrorCode::kBadInput, map::problem_text(problem),
                          Where{.file = path_text(request.file),
                                .line = problem.line,
                                .element = map::brush_name(problem.entity, problem.brush)});
  }
  for (const std::size_t index : world.partition.enclosure.in_solid) {
    const map::Occupant& occupant = world.occupants[index];
    problems.emplace_back(ErrorCode::kBadInput,
                          fmt::format("{} is in solid, at {}", run::occupant_text(occupant),
                                      run::place_text(occupant.position_m)),
                          Where{.file = path_text(request.file),
                                .line = occupant.line,
                                .element = fmt::format("entity {}", occupant.entity)});
  }
  return problems;
}

}  // namespace

map::Document load_map(const std::string& file) {
  map::Document document = map::load(file);
  if (document.worldspawn() == nullptr) {
    throw Error(ErrorCode::kBadInput, "holds no map: it has no entity of class worldspawn",
                {.file = path_text(file)});
  }
  return document;
}

CompiledMap compile_map(const MapRequest& request) {
  CompiledMap out{load_map(request.file), {}, {}};
  world::Settings settings;
  settings.level = request.level;
  settings.threads = request.threads;
  if (request.use_cache && request.level) settings.cache = world::cache_folder(request.file);
  {
    VisibilityProgress progress;
    settings.progress = [&progress](std::size_t done, std::size_t total) { progress(done, total); };
    out.world = world::compile(out.document, settings);
  }
  for (const Error& problem : problems_of(request, out.world)) {
    if (request.strict) throw problem;
    out.warnings.emplace_back(problem.what());
  }
  if (!out.world.cache_note.empty()) out.warnings.push_back("not cached: " + out.world.cache_note);
  for (const std::string& warning : out.warnings) print_warning(warning);
  return out;
}

std::vector<render::Surface> model_faces(CompiledMap& compiled, bool strict) {
  std::vector<Error> faults;
  std::vector<render::Surface> faces = run::model_faces(compiled.document, models_folder(compiled), faults);
  warn_of_models(compiled, faults, strict);
  return faces;
}

fs::path models_folder(const CompiledMap& compiled) {
  return fs::absolute(compiled.document.file).parent_path();
}

void warn_of_models(CompiledMap& compiled, const std::vector<Error>& faults, bool strict) {
  for (const Error& fault : faults) {
    if (strict) throw fault;
    print_warning(compiled.warnings, std::string(fault.what()) + "; left out");
  }
}

pvs::Level level_named(const std::string& name) {
  return name == "full" ? pvs::Level::kFull : pvs::Level::kFast;
}

Json place_json(const Vec3& place) {
  return {place.x(), place.y(), place.z()};
}

Vec3 parse_place(const std::string& what, const std::string& text) {
  const auto parts = split(text, ',');
  Vec3 place = Vec3::Zero();
  bool good = parts.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const auto number = parse_double(trim(parts[i]));
    good = number.has_value();
    if (good) place[static_cast<Eigen::Index>(i)] = *number;
  }
  if (!good) {
    refuse("{} takes X,Y,Z in metres, not \"{}\"", what, printable(text));
  }
  return place;
}

}  // namespace hallway::cli
