// SPDX-License-Identifier: MIT
//
// Whether what Hallway needs is there and works, for the first minute on a new machine.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/isolate/isolated_list.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/machine/machine_profile.hpp"
#include "isolation_options.hpp"
#include "output_file.hpp"
#include "record/version.hpp"
#include "render/draw.hpp"
#include "render/gl_context.hpp"
#include "render/png.hpp"
#include "renderer_option.hpp"
#include "run/feed/manifest.hpp"
#include "shared_options.hpp"
#include "trace/scene.hpp"

namespace hallway::cli {
namespace {

struct DoctorOptions {
  std::vector<std::string> plugin_path;
  std::string picture;
  std::optional<std::string> renderer;
  bool json = false;
};

enum class Health { kGood, kLacking, kBroken };

/// One thing that was looked at.
struct Check {
  std::string name;
  Health health = Health::kGood;
  std::string text;
};

const char* word(Health health) {
  constexpr std::array kWords{"ok", "lacking", "BROKEN"};
  return kWords[static_cast<std::size_t>(health)];
}

/// What `look` says; an Error means that the thing is broken.
template <typename Look>
Check check(const char* name, Look&& look) {
  Check result{name, Health::kGood, {}};
  try {
    look(result);
  } catch (const Error& error) {
    result.health = Health::kBroken;
    result.text = error.what();
  }
  return result;
}

void look_at_machine(Check& result) {
  const host::MachineProfile machine = host::this_machine();
  result.text = fmt::format("{}, {} threads, glibc {}, libstdc++ {}", machine.machine,
                            std::thread::hardware_concurrency(), machine.glibc,
                            machine.glibcxx.empty() ? "unknown" : machine.glibcxx);
}

/// The renderer's own words for itself.
std::string gl_text(const render::GlContext& context, unsigned name) {
  using GetString = const unsigned char* (*)(unsigned);
  const auto get = reinterpret_cast<GetString>(context.function("glGetString"));
  const unsigned char* text = get != nullptr ? get(name) : nullptr;
  return text != nullptr ? printable(reinterpret_cast<const char*>(text)) : "unknown";
}

/// A red square in the middle of the picture, seen from above.
render::Picture test_picture() {
  render::Picture picture;
  picture.title = "hallway doctor";
  render::Surface square;
  square.polygon.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.polygon.plane = {Vec3::UnitZ(), 0.0};
  square.colour = {200, 30, 30};
  picture.surfaces.push_back(square);
  return picture;
}

render::Image draw_test_picture(render::Renderer renderer) {
  constexpr int kWidth = 320, kHeight = 240;
  const render::Picture picture = test_picture();
  const render::View view{.crop = render::Crop{{0.5, 0.5}, 2.0}, .renderer = renderer};
  render::Image image = render::draw(picture, view, kWidth, kHeight);
  const render::PixelRect area = render::map_area(picture, kWidth, kHeight);
  const render::Rgb middle = image.at((area.left + area.right) / 2, (area.top + area.bottom) / 2);
  const render::Rgb corner = image.at(area.left + 4, area.top + 4);
  const bool red = middle.r > 100 && middle.r > 2 * middle.g && middle.r > 2 * middle.b;
  if (!red || corner.g < 100) {
    throw Error(ErrorCode::kInternal,
                fmt::format("a red square came out as ({}, {}, {}) on ({}, {}, {})", middle.r, middle.g,
                            middle.b, corner.r, corner.g, corner.b));
  }
  return image;
}

/// One renderer, by what it calls itself and what it draws.
void look_at_renderer(Check& result, render::Renderer renderer) {
  constexpr unsigned kRenderer = 0x1F01, kVersion = 0x1F02;  // GL_RENDERER, GL_VERSION
  try {
    {
      const auto context = render::make_offscreen_context(renderer);
      result.text = gl_text(*context, kRenderer) + ", " + gl_text(*context, kVersion);
    }
    draw_test_picture(renderer);
  } catch (const render::NoRenderer& missing) {
    result.health = Health::kLacking;
    result.text = missing.cause();
  }
}

/// Everything but pictures works without a renderer; one that is asked for by name is broken if it is not there.
void look_at_picture(Check& result, render::Renderer renderer, const std::string& file) {
  try {
    const render::Image image = draw_test_picture(renderer);
    result.text = fmt::format("a red square is where it should be, drawn by {}",
                              renderer == render::Renderer::kAuto
                                  ? "the first renderer that is ok"
                                  : render::kRendererNames[static_cast<std::size_t>(renderer)]);
    if (file.empty()) return;
    write_file_atomically(file, render::encode_png(image));
    result.text += ", " + path_text(file);
  } catch (const render::NoRenderer&) {
    if (renderer != render::Renderer::kAuto) throw;
    result.health = Health::kLacking;
    result.text = "maps are not drawn, everything else works: no renderer is there";
  }
}

void look_at_helpers(Check& result) {
  for (const char* name : {"hallway-plugin", "hallway-mesh-loader"}) {
    result.text += (result.text.empty() ? "" : ", ") + path_text(find_helper(name));
  }
  try {
    result.text += ", " + path_text(find_helper("hallway-bag"));
  } catch (const Error&) {
    result.text += "; built without ROS 1: bags are not read";
  }
}

void look_at_plugins(Check& result, const std::vector<fs::path>& folders) {
  std::size_t loadable = 0;
  std::string found;
  for (const host::Listed& listed : host::list_plugins_isolated(folders, listing_isolation())) {
    for (const host::PluginInfo& info : listed.plugins) {
      ++loadable;
      found += fmt::format("{}{} {}", found.empty() ? "" : ", ", info.id, info.version);
    }
    if (listed.problem.empty()) continue;
    result.health = Health::kLacking;
    found += fmt::format("{}{}", found.empty() ? "" : ", ", listed.problem);
  }
  if (loadable == 0) result.health = Health::kLacking;
  result.text = fmt::format("{} in {}", found.empty() ? "none" : found, fmt::join(path_texts(folders), ", "));
}

void look_at_isolation(Check& result, const std::vector<fs::path>& folders) {
  host::IsolatedPlugin plugin("slam_point", folders, *isolation_of({}, {}));
  result.text = "slam_point runs in a process of its own";
  for (const std::string& missing : plugin.missing()) {
    result.health = Health::kLacking;
    result.text += "; " + missing;
  }
  plugin.close();
}

std::vector<Check> examine(const DoctorOptions& options) {
  const std::vector<fs::path> folders = plugin_folders(options.plugin_path);
  const render::Renderer renderer = chosen_renderer(options.renderer);
  return {
      check("machine", look_at_machine),
      check("rays", [](Check& result) { result.text = trace::backend_description(trace::Backend::kEmbree); }),
      check("osmesa", [](Check& result) { look_at_renderer(result, render::Renderer::kOsmesa); }),
      check("egl", [](Check& result) { look_at_renderer(result, render::Renderer::kEgl); }),
      check("picture", [&](Check& result) { look_at_picture(result, renderer, options.picture); }),
      check("helpers", look_at_helpers),
      check("plugins", [&](Check& result) { look_at_plugins(result, folders); }),
      check("isolation", [&](Check& result) { look_at_isolation(result, folders); })};
}

int doctor(const DoctorOptions& options) {
  if (!options.picture.empty()) check_picture_file(options.picture);
  const std::vector<Check> checks = examine(options);
  bool good = true;
  std::string text =
      fmt::format("hallway {}, plugin ABI {}.{}\n", record::version(), HW_ABI_MAJOR, HW_ABI_MINOR);
  Json entries = Json::array();
  for (const Check& one : checks) {
    good = good && one.health != Health::kBroken;
    text += fmt::format("{:<8} {:<10} {}\n", word(one.health), one.name, one.text);
    entries.push_back({{"name", one.name}, {"health", word(one.health)}, {"text", one.text}});
  }
  if (options.json) {
    print_json({{"schema", "hallway.doctor/1"},
                {"hallway", record::version()},
                {"abi", fmt::format("{}.{}", HW_ABI_MAJOR, HW_ABI_MINOR)},
                {"good", good},
                {"checks", entries}});
  } else {
    print_result(text);
  }
  return good ? 0 : 1;
}

}  // namespace

void add_doctor_command(Command& app) {
  Command& command = app.command("doctor", "Check the installation");
  DoctorOptions& options = command.runs(&doctor);
  add_plugin_path_option(command, options.plugin_path);
  add_shared(command, Shared::kPicture, &options.picture);
  add_renderer_option(command, options.renderer);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Draws a small picture with each renderer, starts a plugin in a process of its own, and says what the "
      "kernel does not "
      "provide to confine it.\n"
      "Exit status: 0 all works, or something is lacking that not everyone needs, such as a renderer; 1 "
      "something is "
      "broken.\n"
      "Example: hallway doctor --picture test.png");
}

}  // namespace hallway::cli
