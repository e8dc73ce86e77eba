// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "base/text.hpp"
#include "editor/command.hpp"
#include "editor/selection.hpp"
#include "image/png.hpp"

namespace hallway::test {

/// A picture of 4 x 4 grey values that rise towards the lower right.
inline std::string small_png() {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(30 * (x + y)));
    }
  }
  return encode_png({.width_px = 4, .height_px = 4, .channels = 3, .bytes = bytes}, PngEffort::kQuick);
}

/// Lines of commands with arguments of the right kinds, most of which work.
class RandomCommands {
 public:
  /// Which commands: those that change what is in the map, or all there are.
  enum class Which { kChanging, kAll };

  explicit RandomCommands(std::uint64_t seed, Which which = Which::kChanging)
      : which_(which), random_(seed, stream_id("commands")), tour_(static_cast<std::size_t>(seed) * 40) {}

  std::string next(const editor::State& state) {
    const auto all = editor::commands();
    if (!queue_.empty()) {
      std::string line = queue_.front();
      queue_.pop_front();
      return line;
    }
    // Of all commands each has its turn, too: chance alone would leave one out now and then.
    if (which_ == Which::kAll && number_of_lines_++ % 3 == 0) return example(all[tour_++ % all.size()]);
    for (;;) {
      const auto& command = all[pick(all.size())];
      if (which_ == Which::kChanging && !changes_things(command)) continue;
      // Maps stay small: what is copied in numbers is taken away again.
      std::size_t things = 0;
      for (const auto& entity : state.entities) things += 1 + entity->brushes.size();
      if (things > 400 && changes_things(command) && command.name != "delete") continue;
      return line(command, state);
    }
  }

 private:
  /// Not those that look at the whole map, end it, go about in its history or deal with files.
  static bool changes_things(const editor::CommandSpec& command) {
    for (const std::string_view name :
         {"new", "help", "source", "recover", "save", "render", "print", "export", "import", "leak",
          "compile", "validate", "fix", "undo", "redo", "log", "diff", "checkpoint", "history"}) {
      if (command.name == name) return false;
    }
    return true;
  }

  /// A file of the kind that a command wants; those it reads are there, the others are written.
  std::string file(std::string_view command) {
    if (command == "source") return "house.hwe";
    if (command == "import") return "kitchen.map";
    if (command == "render" || command == "leak") return std::array{"a.png", "b.png"}[pick(2)];
    if (command == "print") return std::array{"plan.svg", "plan.pdf"}[pick(2)];
    if (command == "history") return "history-" + std::to_string(pick(1000)) + ".hwe";
    if (command == "export") return std::array{"out.glb", "out.obj", "out.ply"}[pick(3)];
    if (command == "recover") return "recovered-" + std::to_string(pick(1000)) + ".map";
    return std::array{"heights.png", "model.obj"}[pick(2)];
  }

  std::size_t pick(std::size_t count) {
    return static_cast<std::size_t>(random_.bits(0, number_++)[0] % count);
  }
  double uniform(double low, double high) { return random_.uniform(0, number_++, low, high); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

  /// Some commands only make sense together: what the example needs, then the example.
  std::string example(const editor::CommandSpec& command) {
    if (!command.before.empty()) {
      for (const std::string_view line : split(command.before, '\n')) queue_.emplace_back(line);
    }
    queue_.emplace_back(command.example);
    std::string first = queue_.front();
    queue_.pop_front();
    return first;
  }

  std::string line(const editor::CommandSpec& command, const editor::State& state) {
    std::string text(command.name);
    if (chance(0.15)) return example(command);
    for (const editor::ArgSpec& spec : command.arguments) {
      if (!spec.required && !chance(0.35)) continue;
      if (spec.kind == editor::ArgKind::kKeys) {
        text += " k" + std::to_string(pick(3)) + "=" + std::to_string(pick(5));
      } else {
        text += " " + editor::quoted(std::string(spec.name) + "=" + value(command.name, spec, state));
      }
    }
    return text;
  }

  static std::string decimal(double x) { return format_double(std::round(x * 8.0) / 8.0); }

  double in(const editor::ArgSpec& spec, double low, double high) {
    return std::min(std::max(uniform(std::max(low, spec.low), std::min(high, spec.high)), spec.low),
                    spec.high);
  }

  std::string place() {
    const double x = uniform(-6, 6), y = uniform(-6, 6),
                 z = uniform(0, 3);  // in this order with every compiler
    return decimal(x) + "," + decimal(y) + "," + decimal(z);
  }

  std::string value(std::string_view command, const editor::ArgSpec& spec, const editor::State& state) {
    using editor::ArgKind;
    switch (spec.kind) {
      case ArgKind::kName:
        return "n" + std::to_string(pick(40));
      case ArgKind::kText:
        return std::array{"light", "hw_waypoint", "plain", "a text"}[pick(4)];
      case ArgKind::kNumber:
        return decimal(in(spec, -3.0, 3.0));
      case ArgKind::kWhole:
        return std::to_string(static_cast<int>(in(spec, 1.0, 6.0)));
      case ArgKind::kLength:
        return decimal(std::max(in(spec, 0.0, 3.0), 0.125));
      case ArgKind::kAngle:
        return std::to_string(15 * static_cast<int>(pick(24)));
      case ArgKind::kFactors:
        return decimal(uniform(0.5, 2.0));
      case ArgKind::kPlace:
      case ArgKind::kVector:
        return place();
      case ArgKind::kPlaces: {
        const double x = uniform(-5, 5), y = uniform(-5, 5), r = uniform(1, 3);
        return decimal(x) + "," + decimal(y) + ";" + decimal(x + r) + "," + decimal(y) + ";" +
               decimal(x + r) + "," + decimal(y + r);
      }
      case ArgKind::kWhat:
        return what(state);
      case ArgKind::kFile:
        return file(command);
      case ArgKind::kMaterial:
        return std::array{"wall", "floor", "brick", "wood"}[pick(4)];
      case ArgKind::kChoice: {
        const auto choices = split(spec.choices, ' ');
        return std::string(choices[pick(choices.size())]);
      }
      case ArgKind::kKeys:
        break;
    }
    return "";
  }

  std::string what(const editor::State& state) {
    std::vector<std::string> words;
    for (const auto& entity : state.entities) {
      if (entity->classname() != "worldspawn") words.push_back("#" + std::to_string(entity->id));
      if (std::string name = editor::name_of(*entity); !name.empty() && editor::quoted(name) == name)
        words.push_back(name);
      for (std::size_t b = 0; b < entity->brushes.size() && b < 3; ++b)
        words.push_back("#" + std::to_string(entity->brushes[b].id));
    }
    if (words.empty() || chance(0.05)) return "selected";
    return words[pick(words.size())];
  }

  Which which_;
  Random random_;
  std::uint64_t number_ = 0;
  std::size_t number_of_lines_ = 0;
  std::size_t tour_;  ///< the command whose turn it is; each sequence begins elsewhere
  std::deque<std::string> queue_;
};

}  // namespace hallway::test
