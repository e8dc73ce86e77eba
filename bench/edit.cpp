// SPDX-License-Identifier: MIT
//
// What the editor costs on a map of 20 000 brushes, beside parsing the same file: one command with opening, journal and saving, as a
// shell runs it, and commands in an open session. Everything is measured in turns within one run; the figures are medians.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/random.hpp"
#include "editor/session.hpp"
#include "editor/shapes.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using editor::Session;

constexpr std::uint32_t kBrushes = 20000;
constexpr int kRounds = 9;

std::string map_text(std::uint32_t count) {
  map::Document document;
  document.entities.emplace_back();
  document.entities[0].keys = {{"classname", "worldspawn"}, {"_scale", "0.01"}};
  const Random random(1, stream_id("crates"));
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto whole = [&](std::uint64_t n, double low, double high) {
      return std::round(random.uniform(i, n, low, high));
    };
    const Vec3 at(whole(0, -20000, 20000), whole(1, -20000, 20000), 0);
    document.entities[0].brushes.push_back(
        editor::box_brush(at, at + Vec3(whole(2, 25, 150), whole(3, 25, 150), whole(4, 25, 250)), "crate"));
  }
  return map::print(document);
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run_line(Session& session, const std::string& line) {
  session.run(editor::parse_line(line, session.units()));
}

/// Commands that touch one brush, many, and none.
const std::vector<std::string>& lines() {
  static const std::vector<std::string> all{"box from 0,0,10 to 1,1,11",
                                            "move 2500 by 0,0,1",
                                            "move box=-20,-20,-1,20,20,5 by 0,0,1",
                                            "select material=crate",
                                            "delete 3000..3010",
                                            "material 3500..3600 brick",
                                            "entity light at 1,1,1",
                                            "wall from 0,0 to 5,0 height 2.7 thickness 0.15"};
  return all;
}

void run(std::uint32_t count) {
  char pattern[] = "/tmp/hallway-bench-XXXXXX";
  const fs::path folder = ::mkdtemp(pattern);
  const fs::path map = folder / "map.map";
  const std::string text = map_text(count);
  std::vector<double> parse, one_shot, open;
  std::vector<std::vector<double>> command(lines().size());
  for (int round = 0; round < kRounds; ++round) {
    parse.push_back(seconds_of([&] { map::parse(text, "map"); }));
    fs::remove(editor::journal_path(map));
    write_file_atomically(map, text);
    {
      Session session(map);
      run_line(session, "entity light at 0,0,1");
      session.save();
    }
    one_shot.push_back(seconds_of([&] {
      Session session(map);
      run_line(session, "box from 0,0,10 to 1,1,11");
      session.save();
    }));
    std::unique_ptr<Session> session;
    open.push_back(seconds_of([&] { session = std::make_unique<Session>(map); }));
    for (std::size_t i = 0; i < lines().size(); ++i)
      command[i].push_back(seconds_of([&] { run_line(*session, lines()[i]); }));
  }
  fs::remove_all(folder);
  const double reference = median(parse);
  std::printf("%u brushes, %.1f MB; parsing the file: %.1f ms\n", count,
              1e-6 * static_cast<double>(text.size()), 1e3 * reference);
  const auto row = [&](const std::string& name, const std::vector<double>& seconds) {
    std::printf("%-60s %9.2f ms %9.3fx parsing\n", name.c_str(), 1e3 * median(seconds),
                median(seconds) / reference);
  };
  row("one command: open, box, journal, save", one_shot);
  row("open", open);
  for (std::size_t i = 0; i < lines().size(); ++i) row(lines()[i], command[i]);
}

}  // namespace
}  // namespace hallway

int main() {
  hallway::run(hallway::kBrushes / 4);
  hallway::run(hallway::kBrushes);
}
