// SPDX-License-Identifier: MIT
#include "world/compiled_world.hpp"

#include <chrono>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "map/writer.hpp"
#include "world/cache.hpp"

namespace hallway::world {
namespace {

namespace fs = std::filesystem;

/// Changes whenever the same map would give another result.
constexpr std::string_view kCompilerVersion = "4";

/// Measures stages.
class Clock {
 public:
  explicit Clock(std::vector<Stage>& stages) : stages_(stages) {}
  void end(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({name, std::chrono::duration<double>(now - begin_).count()});
    begin_ = now;
  }

 private:
  std::vector<Stage>& stages_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// What the result depends on, as text.
std::string key_of(const map::Document& document, const Settings& settings) {
  const bsp::BuildOptions& build = settings.partition.build;
  std::string key = "hallway " + std::string(kCompilerVersion);
  for (const double value : {static_cast<double>(static_cast<int>(build.rule)), build.split_cost,
                             build.balance_cost, build.on_gain, build.oblique_cost,
                             static_cast<double>(build.candidates), settings.partition.narrowest_m}) {
    key += " " + format_double(value);
  }
  return content_hash(key + "\n" + map::print(document));
}

const char* level_name(const std::optional<pvs::Level>& level) {
  if (!level) return "none";
  return *level == pvs::Level::kFull ? "full" : "fast";
}

/// Files of the cache that would do, the best first.
std::vector<fs::path> candidates(const fs::path& folder, const std::string& key,
                                 const std::optional<pvs::Level>& level) {
  std::vector<fs::path> files{folder / (key + "-full.world")};
  if (level != pvs::Level::kFull) files.push_back(folder / (key + "-fast.world"));
  if (!level) files.push_back(folder / (key + "-none.world"));
  return files;
}

bool read_cached(const fs::path& folder, const std::string& key, const std::optional<pvs::Level>& level,
                 CompiledWorld& world) {
  for (const fs::path& file : candidates(folder, key, level)) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) continue;
    try {
      auto cached = decode(read_file(file));
      if (!cached) continue;
      world.partition = std::move(cached->partition);
      if (level) world.visible = std::move(cached->visible);
      if (file.filename().string().ends_with("-fast.world")) world.level = pvs::Level::kFast;
      return true;
    } catch (const Error&) {
      continue;  // cannot be read: as if it were not there
    }
  }
  return false;
}

void write_cached(const fs::path& folder, const std::string& key, const Settings& settings,
                  CompiledWorld& world) {
  try {
    make_folder(folder);
    write_file_atomically(folder / (key + "-" + level_name(settings.level) + ".world"),
                          encode(world.partition, world.visible));
  } catch (const Error& error) {
    world.cache_note = error.what();
  }
}

std::vector<Vec3> places_of(const std::vector<map::Occupant>& occupants) {
  std::vector<Vec3> places;
  places.reserve(occupants.size());
  for (const map::Occupant& occupant : occupants) places.push_back(occupant.position_m);
  return places;
}

}  // namespace

fs::path cache_folder(const fs::path& map_file) {
  return map_file.parent_path() / ".hallway";
}

CompiledWorld compile(const map::Document& document, const Settings& settings) {
  CompiledWorld world;
  Clock clock(world.stages);
  world.brushes = map::build_world(document);
  world.occupants = map::occupants(document);
  clock.end("brushes");
  std::string key;
  if (!settings.cache.empty()) {
    key = key_of(document, settings);
    world.from_cache = read_cached(settings.cache, key, settings.level, world);
    clock.end("cache");
    if (world.from_cache) return world;
  }
  world.partition = bsp::compile(world.brushes, places_of(world.occupants), settings.partition);
  clock.end("partition");
  if (settings.level && world.sealed()) {
    pvs::Options options;
    options.level = *settings.level;
    options.threads = settings.threads;
    options.progress = settings.progress;
    pvs::Statistics statistics;
    world.visible = pvs::compute(world.partition.portals, options, &statistics);
    world.level = statistics.too_large ? pvs::Level::kFast : *settings.level;
    clock.end("visibility");
  }
  if (!settings.cache.empty() && settings.write_cache) {
    write_cached(settings.cache, key, settings, world);
    clock.end("cache");
  }
  return world;
}

}  // namespace hallway::world
