// SPDX-License-Identifier: MIT
#include "study/ground.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/origin.hpp"
#include "base/text.hpp"
#include "host/plugin_table.hpp"
#include "host/samples/point_kind.hpp"
#include "import/victoria_park.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"
#include "run/sources/simulated_source.hpp"
#include "sim/simulator.hpp"

namespace hallway::study {
namespace {

namespace fs = std::filesystem;

void change(map::Document& document, const MapEdit& edit) {
  bool found = false;
  for (map::Entity& entity : document.entities) {
    if (entity.classname() != edit.classname) continue;
    found = true;
    bool set = false;
    for (map::KeyValue& pair : entity.keys) {
      if (pair.key != edit.key) continue;
      pair.value = edit.value;
      set = true;
    }
    if (!set) entity.keys.push_back({.key = edit.key, .value = edit.value});
  }
  if (!found)
    throw Error(ErrorCode::kBadInput, "the map has no " + edit.classname + " to change",
                {printable(document.file), 0, {}});
}

/// The changed map, under a name made of its content.
fs::path write_changed_map(const fs::path& original, const std::vector<MapEdit>& edits, const fs::path& out) {
  map::Document document = map::load(original);
  for (const MapEdit& edit : edits) change(document, edit);
  const std::string text = map::print(document);
  make_folder(out / "maps");
  const fs::path file =
      out / "maps" / (original.stem().string() + "-" + content_hash(text).substr(0, 8) + ".map");
  write_file_atomically(file, text);
  return file;
}

std::vector<Override> overrides_of(const Drive& drive, const PluginChoice* plugin) {
  std::vector<Override> all = drive.settings;
  all.push_back({"seed", fmt::to_string(drive.seed)});
  all.push_back({"steps", fmt::to_string(drive.steps)});
  if (plugin == nullptr) return all;
  all.push_back({"plugin", plugin->plugin});
  for (const auto& [name, value] : plugin->parameters)
    all.push_back({host::short_plugin_name(plugin->plugin) + "." + name, value});
  return all;
}

class DrivenGround : public Ground {
 public:
  DrivenGround(const Drive& drive, const Folders& folders, unsigned threads)
      : drive_(drive),
        file_(folders.maps / (drive.scenario + ".toml")),
        simulator_(scenario(folders), threads, trace::Backend::kEmbree),
        source_(simulator_) {}

  run::Source& source() override { return source_; }
  std::vector<host::StageSpec> stages(const PluginChoice& plugin) const override {
    return sim::load_scenario(file_, overrides_of(drive_, &plugin)).pipeline;
  }

 private:
  sim::Scenario scenario(const Folders& folders) const {
    std::vector<Override> overrides = overrides_of(drive_, nullptr);
    if (!drive_.edits.empty()) {
      const fs::path map = sim::load_scenario(file_, overrides).map_file;
      overrides.push_back({"map", write_changed_map(map, drive_.edits, folders.out).string()});
    }
    return sim::load_scenario(file_, overrides);
  }

  Drive drive_;
  fs::path file_;
  sim::Simulator simulator_;
  run::SimulatedSource source_;
};

/// Some frames of a recording, numbered from 0.
class RecordingPart : public run::Source {
 public:
  RecordingPart(std::unique_ptr<import::Recording> recording, const ParkInterval& part)
      : recording_(std::move(recording)), part_(part) {
    if (part.last < part.first || part.last >= recording_->frames())
      throw Error(ErrorCode::kBadInput,
                  fmt::format("the recording has {} scans, not scan {}", recording_->frames(), part.last));
    facts_.sensors.push_back(host::point_sensor(recording_->sensor()));
  }

  std::uint32_t iterations() const override { return part_.last - part_.first + 1; }

 private:
  void fill(std::uint32_t iteration, run::SourceFrame& frame) override {
    recording_->read(part_.first + iteration, frame_);
    std::vector<hw_point3_t>& points =
        host::add_points(frame.begin(iteration, frame_.t_ns), facts_.sensors.front().id);
    for (const auto& [x, y, z] : frame_.points) points.push_back({x, y, z});
    frame.T_world_body = frame_.T_world_body;
    frame.orientation_known = frame_.orientation_known;
  }

  std::unique_ptr<import::Recording> recording_;
  ParkInterval part_;
  import::Frame frame_;
};

class ParkGround : public Ground {
 public:
  ParkGround(const ParkInterval& part, const fs::path& data)
      : source_(import::open_victoria_park(data / "victoria_park", {}), part) {}

  run::Source& source() override { return source_; }
  std::vector<host::StageSpec> stages(const PluginChoice& plugin) const override {
    host::StageSpec stage{plugin.plugin, {}};
    for (const auto& [name, value] : plugin.parameters)
      stage.parameters.push_back({name, value, {.file = kCommandLine}});
    return {stage};
  }

 private:
  RecordingPart source_;
};

}  // namespace

std::unique_ptr<Ground> make_ground(const RunSpec& spec, const Folders& folders, const fs::path& data,
                                    unsigned threads) {
  if (const auto* drive = std::get_if<Drive>(&spec.input))
    return std::make_unique<DrivenGround>(*drive, folders, threads);
  return std::make_unique<ParkGround>(std::get<ParkInterval>(spec.input), data);
}

std::string ground_key(const RunSpec& spec) {
  if (const auto* park = std::get_if<ParkInterval>(&spec.input))
    return fmt::format("scans {} {}", park->first, park->last);
  const auto& drive = std::get<Drive>(spec.input);
  std::string key = fmt::format("{} {} {}", drive.scenario, drive.seed, drive.steps);
  for (const MapEdit& edit : drive.edits)
    key += fmt::format("\n{} {} {}", edit.classname, edit.key, edit.value);
  for (const Override& setting : drive.settings) key += fmt::format("\n{}={}", setting.key, setting.value);
  return key;
}

}  // namespace hallway::study
