// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/file.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {

/// One line that the fake driver wrote down.
struct Note {
  std::int64_t t_ns = 0;
  std::string what;  ///< "frame", "answer", "closed"
  std::uint64_t sequence = 0;
  std::uint32_t status = 0;
  double linear = 0.0;
  double angular = 0.0;
  std::uint64_t landmarks = 0;
  std::string message;

  bool is_answer(std::uint32_t of_status) const { return what == "answer" && status == of_status; }
  bool stops() const { return linear == 0.0 && angular == 0.0; }
};

/// A configuration with the fake driver, a plugin, and where things go.
class RobotWorld {
 public:
  /// @param driver  lines of the [driver] table
  /// @param plugin  lines of a [[plugin]] table
  /// @param rest    further tables
  RobotWorld(const std::string& driver, const std::string& plugin, const std::string& rest = "") {
    config_ = folder_.write("robot.toml", "[driver]\nname = \"" FAKE_DRIVER "\"\nlog = \"" +
                                              (folder_ / "notes").string() + "\"\n" + driver +
                                              "\n[[plugin]]\n" + plugin + "\n" + rest + "\n");
  }

  const TempFolder& folder() const { return folder_; }
  std::string config() const { return config_; }
  std::string out() const { return folder_ / "out"; }

  std::vector<std::string> arguments() const { return {"run", config(), "--out", out()}; }
  Ended run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = arguments();
    all.insert(all.end(), more.begin(), more.end());
    return hallway_robot(all);
  }

  nlohmann::ordered_json manifest() const {
    return nlohmann::ordered_json::parse(read_file(folder_ / "out/run.json"));
  }

  std::vector<Note> notes() const {
    std::vector<Note> notes;
    std::error_code none;
    if (!std::filesystem::exists(folder_ / "notes", none)) return notes;
    std::istringstream lines(read_file(folder_ / "notes"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream fields(line);
      Note note;
      std::string linear, angular;
      fields >> note.t_ns >> note.what >> note.sequence >> note.status >> linear >> angular >> note.landmarks;
      note.linear = linear.empty() ? 0.0 : std::stod(linear);
      note.angular = angular.empty() ? 0.0 : std::stod(angular);
      std::getline(fields >> std::ws, note.message);
      notes.push_back(note);
    }
    return notes;
  }

  /// Waits until a note fulfils `wanted`. False if none does within two minutes.
  template <typename Wanted>
  bool wait_for_note(Wanted wanted) const {
    for (int i = 0; i < 12000; ++i) {
      for (const Note& note : notes()) {
        if (wanted(note)) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

 private:
  TempFolder folder_;
  std::filesystem::path config_;
};

/// Where the first note from `from` on stands that fulfils `wanted`; the number of notes where none does.
template <typename Wanted>
std::size_t find_note(const std::vector<Note>& notes, std::size_t from, Wanted wanted) {
  std::size_t i = from;
  while (i < notes.size() && !wanted(notes[i])) ++i;
  return i;
}

/// The [[plugin]] lines of the fixtures.
inline std::string drives(const std::string& params = "") {
  return "name = \"" FIXTURES "/drives.so\"\nparams = {" + params + "}";
}
inline std::string breaks(const std::string& how, int at) {
  return "name = \"" FIXTURES "/breaks.so\"\nparams = {how = \"" + how + "\", at = " + std::to_string(at) +
         "}";
}

}  // namespace hallway::test
