// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "leak_report.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct CompileOptions {
  std::string map;
  std::string level = "full";
  unsigned threads = hardware_threads();
  bool no_cache = false;
  bool strict = false;
  bool json = false;
};

/// What the stages made, as numbers.
struct Counts {
  std::size_t brushes = 0;
  std::size_t polygons = 0;
  std::size_t inside_polygons = 0;
  std::size_t leaves = 0;
  std::size_t empty_leaves = 0;
};

Counts count(const world::CompiledWorld& world) {
  Counts counts;
  counts.brushes = world.brushes.solids.size();
  for (std::size_t i = 0; i < world.partition.surface.polygons.size(); ++i) {
    if (world.partition.surface.polygons[i].vertices.empty()) continue;
    ++counts.polygons;
    if (world.partition.inside[i]) ++counts.inside_polygons;
  }
  counts.leaves = world.partition.tree.leaves.size();
  for (const bsp::Leaf& leaf : world.partition.tree.leaves) {
    if (leaf.content == bsp::Content::kEmpty) ++counts.empty_leaves;
  }
  return counts;
}

/// Most memory that the program has held at once.
std::uint64_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string size_text(std::uint64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value < 1024.0) return fmt::format("{} B", bytes);
  if (value < 1024.0 * 1024.0) return fmt::format("{:.1f} KiB", value / 1024.0);
  return fmt::format("{:.1f} MiB", value / (1024.0 * 1024.0));
}

std::size_t bad_brushes(const map::World& brushes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(brushes.problems, [](const map::Problem& problem) { return problem.left_out; }));
}

std::string left_out_text(const map::World& brushes) {
  std::string text;
  for (const map::LeftOutCount& entry : brushes.left_out) {
    text += fmt::format("{}{} {}", text.empty() ? "left out: " : ", ", entry.brushes,
                        map::to_string(entry.reason));
  }
  if (const std::size_t bad = bad_brushes(brushes); bad > 0) {
    text += fmt::format("{}{} no solids", text.empty() ? "left out: " : ", ", bad);
  }
  return text;
}

const char* level_text(pvs::Level level) {
  return level == pvs::Level::kFull ? "full" : "fast";
}

/// Builds lines of a label, a number and a note.
class StageTable {
 public:
  void row(const char* label, const std::string& value, const std::string& note = {}) {
    text_ += fmt::format("  {:<12} {:>10}{}{}\n", label, value, note.empty() ? "" : "   ", note);
  }
  void row(const char* label, std::size_t value, const std::string& note = {}) {
    row(label, fmt::to_string(value), note);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string times_text(const world::CompiledWorld& world) {
  std::string text = "  time        ";
  double total = 0.0;
  for (const world::Stage& stage : world.stages) {
    text += fmt::format(" {} {:.3f} s,", stage.name, stage.seconds);
    total += stage.seconds;
  }
  return text + fmt::format(" in all {:.3f} s\n", total);
}

std::string verdict(const world::CompiledWorld& world) {
  if (world.sealed()) return "sealed";
  return world.partition.enclosure.leak ? "leaks" : "encloses nothing";
}

std::string table_of(const std::string& map, const world::CompiledWorld& world, const std::string& way_file) {
  const Counts counts = count(world);
  StageTable table;
  table.row("brushes", counts.brushes, left_out_text(world.brushes));
  table.row("polygons", counts.polygons,
            world.sealed() ? fmt::format("{} of them inside", counts.inside_polygons) : std::string());
  table.row("nodes", world.partition.tree.nodes.size());
  table.row("leaves", counts.leaves, fmt::format("{} of them empty", counts.empty_leaves));
  table.row("clusters", world.partition.portals.clusters);
  table.row("portals", world.partition.portals.portals.size());
  if (world.visible) {
    table.row("visible", fmt::format("{:.1f} %", 100.0 * world.visible->mean_share()),
              fmt::format("mean share of the clusters that one may see, level {}; {}",
                          level_text(world.level), size_text(world.visible->bytes())));
  }
  table.row("memory", size_text(peak_memory_bytes()), "at most");
  std::string text = fmt::format("{}: {}{}\n", printable(fs::path(map).filename().string()), verdict(world),
                                 world.from_cache ? ", from the cache" : "");
  text += table.text() + times_text(world);
  if (world.partition.enclosure.leak) text += leak_text(world, way_file);
  return text;
}

Json document_of(const CompiledMap& compiled, const std::string& way_file, int status) {
  const world::CompiledWorld& world = compiled.world;
  const Counts counts = count(world);
  Json left_out = Json::object();
  for (const map::LeftOutCount& entry : world.brushes.left_out)
    left_out[std::string(map::to_string(entry.reason))] = entry.brushes;
  Json stages = Json::array();
  for (const world::Stage& stage : world.stages)
    stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  Json visible = nullptr;
  if (world.visible) {
    visible = {{"level", level_text(world.level)},
               {"mean_share", world.visible->mean_share()},
               {"bytes", world.visible->bytes()}};
  }
  return {{"schema", "hallway.compile/1"},
          {"status", status},
          {"map", path_text(compiled.document.file)},
          {"sealed", world.sealed()},
          {"brushes",
           {{"used", counts.brushes}, {"left_out", left_out}, {"no_solids", bad_brushes(world.brushes)}}},
          {"polygons", counts.polygons},
          {"polygons_inside", counts.inside_polygons},
          {"nodes", world.partition.tree.nodes.size()},
          {"leaves", counts.leaves},
          {"leaves_empty", counts.empty_leaves},
          {"clusters", world.partition.portals.clusters},
          {"portals", world.partition.portals.portals.size()},
          {"visible", visible},
          {"memory_peak_bytes", peak_memory_bytes()},
          {"from_cache", world.from_cache},
          {"stages", stages},
          {"leak", leak_json(world)},
          {"points_file", way_file.empty() ? Json(nullptr) : Json(path_text(way_file))},
          {"warnings", compiled.warnings}};
}

/// Whether a file holds points, a line each, and nothing else: what Quake's compilers, and this one, write as the way out of a leak.
bool is_way_file(const fs::path& file) {
  constexpr std::uint64_t kMostBytes = 64u << 20;
  try {
    const std::string text = read_file(file, kMostBytes);
    std::string_view rest = text;
    while (!rest.empty()) {
      std::string_view line = trim(rest.substr(0, rest.find('\n')));
      rest = rest.substr(std::min(
          rest.size(), rest.find('\n') == std::string_view::npos ? rest.size() : rest.find('\n') + 1));
      std::size_t numbers = 0;
      for (; !line.empty(); ++numbers) {
        const std::string_view word = line.substr(0, line.find_first_of(" \t"));
        if (!parse_double(word)) return false;
        line = trim(line.substr(word.size()));
      }
      if (numbers != 0 && numbers != 3) return false;
    }
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Writes the way out beside the map, or takes away that of an earlier leak, as Quake's compilers do.
/// @return the file that was written, if any
std::string keep_way_file(const std::string& map, CompiledMap& compiled) {
  const fs::path file = fs::path(map).replace_extension(".pts");
  const auto& leak = compiled.world.partition.enclosure.leak;
  std::error_code code;
  if (fs::exists(file, code) && !is_way_file(file)) {
    if (leak) {
      print_warning(compiled.warnings,
                    fmt::format("the leak path is not kept: {} holds something else", path_text(file)));
    }
    return {};
  }
  if (!leak) {
    if (fs::is_regular_file(file, code)) fs::remove(file, code);
    return {};
  }
  try {
    write_file_atomically(file, way_points(*leak, compiled.world.brushes.metres_per_unit));
    return file.string();
  } catch (const Error& error) {
    print_warning(compiled.warnings, fmt::format("the leak path is not kept: {}", error.what()));
    return {};
  }
}

int compile(const CompileOptions& options) {
  CompiledMap compiled = compile_map({.file = options.map,
                                      .level = level_named(options.level),
                                      .threads = options.threads,
                                      .use_cache = !options.no_cache,
                                      .strict = options.strict});
  const std::string way_file = keep_way_file(options.map, compiled);
  const int status = compiled.world.sealed() ? 0 : 1;
  if (options.json) {
    print_json(document_of(compiled, way_file, status));
  } else {
    print_result(table_of(options.map, compiled.world, way_file));
  }
  return status;
}

}  // namespace

void add_compile_command(Command& app) {
  Command& command = app.command(
      "compile", "Compile a map: its surface, its clusters and potentially visible sets; find leaks");
  CompileOptions& options = command.runs(&compile);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kLevel, &options.level);
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  command.flag("--no-cache", &options.no_cache, "Neither read nor write the folder .hallway beside the map");
  add_shared(command, Shared::kStrict, &options.strict);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Status 1: the map leaks; the leak path is then written beside it, in a file with the ending .pts.\n"
      "Example: hallway compile maps/office.map --level full --threads 2");
}

}  // namespace hallway::cli
