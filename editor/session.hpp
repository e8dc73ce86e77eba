// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "editor/command.hpp"
#include "editor/journal.hpp"
#include "editor/patch.hpp"
#include "editor/state.hpp"

namespace hallway::editor {

/// One entry of the history.
struct Step {
  std::string line{};        ///< the command as it would be typed
  std::string checkpoint{};  ///< its name, where it only marks a place
  Patch patch{};
  std::vector<std::string> lines{};  ///< those of a script, which is one step; empty for a command

  /// The command, or the checkpoint as it was set.
  std::string text() const { return checkpoint.empty() ? line : "checkpoint " + checkpoint; }
};

/// The line of a step that another program made.
inline constexpr std::string_view kOutsideChange = "(changed by another program)";

/// A line of a script, and where it stands.
struct ScriptLine {
  std::string text{};  ///< as typed, or one JSON object
  std::string file{};
  int line = 0;
};

/// The lines of a script; what `source FILE` names stands in its place (paths are relative to the script). Throws Error{kUsage} where
/// scripts call each other without end.
std::vector<ScriptLine> read_script(const std::filesystem::path& file);
std::vector<ScriptLine> script_lines(const std::string& text, const std::filesystem::path& file);

/// A map under edit, with its history.
///
/// The journal beside the map has every change before it is acknowledged. save() brings the map's file up to date. After a crash
/// the next session of the same map continues where the last acknowledged command left it.
class Session {
 public:
  /// Opens a map that exists, or will (`new` makes it). Takes over unsaved changes of a session that ended without saving, and says
  /// so in notes(). A map that another program has changed since the last save is taken as it is now, that change being a step
  /// that can be undone; where there are unsaved changes too, that is Error{kBadInput}, with both kept (see recover()).
  explicit Session(std::filesystem::path map);

  const State& state() const { return state_; }
  /// What the map's file holds.
  const State& saved() const { return saved_; }
  const std::filesystem::path& file() const { return file_; }
  bool unsaved() const { return unsaved_; }
  /// What happened while it was opened, for the user.
  const std::vector<std::string>& notes() const { return notes_; }

  /// The file in which `copy` leaves things for `paste`, which may be another session's. Without one both refuse.
  void set_clipboard(std::string file) { clipboard_ = std::move(file); }

  /// What draws the pictures that commands write. It is no part of the history.
  void set_renderer(render::Renderer renderer) { renderer_ = renderer; }

  /// Runs a command and, if it changed anything, writes it to the journal. An exception means that nothing has changed.
  Report run(const Call& call);
  /// Runs lines as one step named `name`: all of them or, if one throws, none; the error then names the line. `save` counts for the
  /// end; other commands about the session are refused. Blank lines are passed over.
  std::vector<Report> run_script(const std::vector<ScriptLine>& lines, const std::string& name);

  /// Takes back, or does again, up to `count` steps; returns their lines, in the order in which that happened.
  std::vector<std::string> undo(std::size_t count);
  std::vector<std::string> redo(std::size_t count);
  /// Steps in their order, undone ones included.
  const std::vector<Step>& steps() const { return steps_; }
  /// How many of them count; the others can be redone.
  std::size_t done() const { return done_; }
  void checkpoint(const std::string& name);

  /// Writes the map's file if it does not hold the state.
  void save();
  /// The map's text as save() writes it.
  std::string text() const;

  /// How lengths are read that are typed in map units.
  Units units() const;

 private:
  struct Save {
    std::size_t record = 0;  ///< index of the record; the state is that before it
    std::string hash{};      ///< of the file's text
    bool acknowledged = false;
  };

  void begin_history(const std::string* text);
  void begin_journal();
  void continue_history(const std::string* text);
  std::vector<Save> saves() const;
  bool restore_from_file(const std::string& text, std::size_t record);
  void restore_from_journal();
  void take_outside_change(const std::string& text);
  void commit(const std::string& line, State next, std::vector<std::string> lines = {});
  /// Goes to the place in the history where `place` steps are done; a record of that name has how many. Returns their texts.
  std::vector<std::string> go_to(std::size_t place, const char* record);
  void update_unsaved();

  std::filesystem::path file_;
  Journal journal_;
  State state_;
  State saved_;            ///< what the map's file holds
  std::string base_text_;  ///< of the file, until the journal begins
  std::vector<Step> steps_;
  std::size_t done_ = 0;
  bool unsaved_ = false;
  std::vector<std::string> notes_;
  std::string clipboard_;
  render::Renderer renderer_ = render::Renderer::kAuto;
};

/// Where the journal of a map stands.
std::filesystem::path journal_path(const std::filesystem::path& map);

/// The text of the map that records end with. Throws Error{kBadInput} for records that make no history.
std::string last_text(const Journal::Reading& reading, const std::string& file);

/// What the readable part of a map's journal ends with, whatever stands in the map's file; the text of a map. Throws Error{kIo,
/// kBadInput} where there is no journal, or none with a beginning.
std::string recover(const std::filesystem::path& map);

}  // namespace hallway::editor
