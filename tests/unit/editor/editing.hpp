// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "editor/selection.hpp"
#include "editor/session.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {

/// A map in a folder of its own, under edit.
class Editing {
 public:
  Editing() : session(std::make_unique<editor::Session>(folder / "map.map")) {}

  /// Runs a line as if it were typed.
  editor::Report run(const std::string& line) {
    return session->run(editor::parse_line(line, session->units()));
  }
  void run_all(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) run(line);
  }
  /// Ends the session and begins the next one, as another shell would.
  void reopen() {
    session.reset();
    session = std::make_unique<editor::Session>(folder / "map.map");
  }
  std::string text() const { return session->text(); }

  TempFolder folder;
  std::unique_ptr<editor::Session> session;
};

}  // namespace hallway::test
