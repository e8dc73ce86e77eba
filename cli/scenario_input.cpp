// SPDX-License-Identifier: MIT
#include "scenario_input.hpp"

#include <filesystem>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "console.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

std::vector<std::string> take_warnings(const sim::Simulator& simulator, bool strict) {
  std::vector<std::string> warnings;
  for (const Error& problem : simulator.problems()) {
    if (strict) throw problem;
    warnings.emplace_back(problem.what());
    print_warning(warnings.back());
  }
  return warnings;
}

std::vector<run::Attachment> model_files(const sim::Simulator& simulator) {
  const fs::path folder = simulator.scenario().map_file.parent_path();
  std::vector<run::Attachment> files;
  for (const fs::path& file : simulator.models().files) {
    files.push_back(
        {file.lexically_relative(folder.empty() ? fs::path(".") : folder).generic_string(), read_file(file)});
  }
  return files;
}

}  // namespace hallway::cli
