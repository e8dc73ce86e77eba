// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "conformance/suite.hpp"
#include "support/temp_folder.hpp"

namespace hallway::conformance::test {

/// A fixture (`defective`, `defective_samples`) under the name of a defect, which it then has; under its own: none.
class DefectivePlugin {
 public:
  explicit DefectivePlugin(const std::string& defect, const std::string& fixture = "defective")
      : file_(folder_ / (defect + ".so")) {
    std::filesystem::create_symlink(FIXTURES "/defects/" + fixture + ".so", file_);
  }
  const std::filesystem::path& file() const { return file_; }
  /// A setup that runs tests of it, two at a time.
  SuiteSetup setup() const {
    SuiteSetup setup;
    setup.subject.file = file_;
    setup.jobs = 2;
    setup.timeout = std::chrono::seconds(120);
    setup.temporary = folder_.path();
    return setup;
  }
  /// How many files there are beside the plugin's own.
  std::size_t files_left() const {
    const auto files = std::filesystem::directory_iterator(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(files), end(files))) - 1;
  }

 private:
  hallway::test::TempFolder folder_;
  std::filesystem::path file_;
};

}  // namespace hallway::conformance::test
