// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "map/writer.hpp"
#include "mesh/import.hpp"
#include "mesh/load.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct ImportCommand {
  std::string model;
  std::string out;
  std::optional<double> units;
  double margin_m = 2.0;
  bool copy = false;
  std::string root;
  bool force = false;
  bool json = false;
};

/// The folder that the model may read from: the map's, or where --copy takes files from.
fs::path read_folder(const ImportCommand& command, const fs::path& map_folder) {
  if (!command.copy) return map_folder;
  return command.root.empty() ? fs::path(command.model).parent_path() : fs::path(command.root);
}

void check_options(const ImportCommand& command) {
  if (!command.root.empty() && !command.copy) refuse("--root belongs to --copy");
  check_new_file(command.out, command.force);
}

void print_summary(const ImportCommand& command, const mesh::Model& model, const std::string& name) {
  const Box bounds = mesh::bounds_of(model);
  const double scale = command.units ? *command.units / model.metres_per_unit : 1.0;
  const Vec3 size = scale * bounds.sizes();
  if (!command.json) {
    print_result("{}: {} triangles, {} materials, {} images, {:.2f} x {:.2f} x {:.2f} m, as {}\n",
                 path_text(command.out), model.triangles.size(), model.materials.size(), model.images.size(),
                 size.x(), size.y(), size.z(), path_text(name));
    return;
  }
  Json warnings = Json::array();
  for (const std::string& warning : model.warnings) warnings.push_back(warning);
  print_json({{"schema", "hallway.import/1"},
              {"map", path_text(command.out)},
              {"model", path_text(name)},
              {"triangles", model.triangles.size()},
              {"vertices", model.vertices.size()},
              {"materials", model.materials.size()},
              {"images", model.images.size()},
              {"size_m", {size.x(), size.y(), size.z()}},
              {"warnings", warnings}});
}

int import_model(const ImportCommand& command) {
  check_options(command);
  const fs::path map_folder = fs::path(command.out).parent_path();
  mesh::ImportOptions options;
  options.units = command.units;
  options.margin_m = command.margin_m;
  const fs::path root = read_folder(command, map_folder);
  options.model = mesh::path_in_map_folder(command.model, root);
  const mesh::Model model = mesh::load_model(command.model, root);
  for (const std::string& warning : model.warnings) print_warning(printable(command.model) + ": " + warning);
  const std::string text = map::print(mesh::import_document(model, options));
  if (command.copy) mesh::copy_model_files(model.files, root, map_folder, command.force);
  write_file_atomically(command.out, text);
  print_summary(command, model, options.model);
  return 0;
}

}  // namespace

void add_import_command(Command& app) {
  Command& command =
      app.command("import", "Make a map around a model: glTF, COLLADA, OBJ, STL, PLY, FBX, ...");
  ImportCommand& options = command.runs(&import_model);
  command.argument("model", &options.model, "Model file, in the folder of the map or below it")
      .required()
      .value("MODEL");
  add_shared(command, Shared::kOutFile, &options.out).required();
  command.option("--units", &options.units, "Metres in one unit of the file [what the file says, else 1]")
      .range(1e-6, 1e6)
      .value("M");
  command.option("--margin", &options.margin_m, "Metres between the model and the walls around it")
      .range(1.0, 1e4)
      .value("M")
      .show_default();
  command.flag("--copy", &options.copy,
               "Copy the model, and the files that it names, into the folder of the map");
  command
      .option("--root", &options.root,
              "With --copy: folder that the model may name files in; they keep their paths below it "
              "[the model's folder]")
      .value("DIR");
  add_shared(command, Shared::kForce, &options.force);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "The map is closed by six blocks outside the model, which is detail geometry: it is seen and blocks "
      "sight.\n"
      "Example: hallway import models/willowgarage.dae --out garage.map && hallway render garage.map --out "
      "garage.png");
}

}  // namespace hallway::cli
