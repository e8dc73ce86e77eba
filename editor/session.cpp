// SPDX-License-Identifier: MIT
#include "editor/session.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/item_text.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// How many brushes each entity has, from which the first state's ids follow.
Json shape_of(const State& state) {
  Json counts = Json::array();
  for (const auto& entity : state.entities) counts.push_back(entity->brushes.size());
  return counts;
}

/// A state of that shape without content: patches can be applied to it, as they look at numbers only.
State skeleton(const Json& shape) {
  constexpr std::size_t kMostThings = std::size_t{1} << 26;  // more than a map's file has room for
  State state;
  for (const Json& count : shape) {
    if (whole_number(count) > kMostThings || state.next_id > kMostThings)
      throw Error(ErrorCode::kBadInput, "the journal begins with a map of more things than a map can have");
    auto entity = std::make_shared<EntityItem>();
    entity->id = state.next_id++;
    for (auto brushes = whole_number(count); brushes > 0; --brushes)
      entity->brushes.push_back({state.next_id++, nullptr});
    state.entities.push_back(std::move(entity));
  }
  return state;
}

/// Gives a skeleton the content of a document. False if their shapes differ.
bool fill(State& state, const map::Document& document) {
  if (state.entities.size() != document.entities.size()) return false;
  const State content = state_of(document);
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    EntityItem& item = own(state, e);
    const EntityItem& from = *content.entities[e];
    if (item.brushes.size() != from.brushes.size()) return false;
    item.head = from.head;
    for (std::size_t b = 0; b < from.brushes.size(); ++b) item.brushes[b].brush = from.brushes[b].brush;
  }
  state.closing_comments = content.closing_comments;
  return true;
}

std::optional<std::string> content_of(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) return std::nullopt;
  return read_file(file, map::kMaxMapBytes);
}

std::string print(const State& state, const fs::path& file) {
  return map::print(document_of(state, file.string()));
}

[[noreturn]] void refuse_record(const Json::exception& fault, const std::string& file) {
  throw Error(ErrorCode::kBadInput, std::string("a record of the journal cannot be read: ") + fault.what(),
              {file, 0, {}});
}

/// A history as it is read from records.
struct History {
  State state;
  std::vector<Step> steps;
  std::size_t done = 0;

  void play(const Json& record) {
    if (record.contains("do")) {
      steps.resize(done);
      Step step{record.at("do").get<std::string>(),
                {},
                patch_from_json(record.at("patch")),
                record.value("lines", std::vector<std::string>{})};
      apply(state, step.patch);
      steps.push_back(std::move(step));
      ++done;
    } else if (record.contains("checkpoint")) {
      steps.resize(done);
      steps.push_back({{}, record["checkpoint"].get<std::string>(), {}, {}});
      ++done;
    } else if (record.contains("undo")) {
      for (auto n = whole_number(record["undo"]); n > 0 && done > 0; --n)
        apply(state, inverse(steps[--done].patch));
    } else if (record.contains("redo")) {
      for (auto n = whole_number(record["redo"]); n > 0 && done < steps.size(); --n)
        apply(state, steps[done++].patch);
    }
  }
};

}  // namespace

fs::path journal_path(const fs::path& map) {
  fs::path path = map;
  path += ".journal";
  return path;
}

Session::Session(fs::path map) : file_(std::move(map)), journal_(journal_path(file_)) {
  if (journal_.bytes_dropped() > 0) {
    notes_.push_back("the journal's last entry was cut off while it was written, and is dropped");
  }
  if (!journal_.writable()) {
    notes_.push_back("its folder cannot be written: the map can be looked at, and nothing in it changed");
  }
  const auto text = content_of(file_);
  try {
    if (journal_.records().empty()) {
      begin_history(text ? &*text : nullptr);
    } else {
      continue_history(text ? &*text : nullptr);
    }
  } catch (const Json::exception& fault) {
    refuse_record(fault, journal_.path().string());
  }
  update_unsaved();
}

/// The first state is written to the journal when the first step is.
void Session::begin_history(const std::string* text) {
  if (text != nullptr) state_ = state_of(map::parse(*text, file_.string()));
  saved_ = state_;
  base_text_ = text != nullptr ? *text : std::string();
}

std::vector<Session::Save> Session::saves() const {
  const auto& records = journal_.records();
  std::vector<Save> result;
  if (records[0].contains("hash")) result.push_back({1, records[0]["hash"].get<std::string>(), true});
  for (std::size_t i = 1; i < records.size(); ++i) {
    if (records[i].contains("save")) result.push_back({i, records[i]["save"].get<std::string>(), false});
    if (records[i].contains("saved") && !result.empty()) result.back().acknowledged = true;
  }
  return result;
}

void Session::continue_history(const std::string* text) {
  const std::vector<Save> all = saves();
  const bool ever_saved = std::ranges::any_of(all, [](const Save& save) { return save.acknowledged; });
  if (text == nullptr || (text->empty() && !ever_saved)) {  // an empty file is a map to be
    if (ever_saved) {
      throw Error(ErrorCode::kBadInput,
                  "the map's file is gone, its journal is there: `hallway edit MAP recover` restores the "
                  "map; remove the "
                  "journal to start anew",
                  {file_.string(), 0, {}});
    }
    return restore_from_journal();
  }
  // A save writes its record, then the file: the file is that of the last record, or of the one before if the save did not end.
  const std::string hash = content_hash(*text);
  if (!all.empty() && all.back().hash == hash && restore_from_file(*text, all.back().record)) return;
  if (all.size() > 1 && !all.back().acknowledged && all[all.size() - 2].hash == hash &&
      restore_from_file(*text, all[all.size() - 2].record))
    return;
  restore_from_journal();
  if (print(state_, file_) == *text) {
    saved_ = state_;
    return;
  }
  if (difference(saved_, state_).changes_map()) {
    throw Error(ErrorCode::kBadInput,
                "another program has changed the map, and its journal holds changes that were never saved: "
                "`hallway edit MAP "
                "recover to=FILE` writes the journal's version to a file; remove the journal to go on with "
                "the map as it is",
                {file_.string(), 0, {}});
  }
  take_outside_change(*text);
}

/// The state of a record is what the file holds; what follows it is applied. False if the two do not belong together.
bool Session::restore_from_file(const std::string& text, std::size_t record) {
  const auto& records = journal_.records();
  History history;
  history.state = skeleton(records[0].value("brushes", Json::array()));
  for (std::size_t i = 1; i < record; ++i) history.play(records[i]);
  if (!fill(history.state, map::parse(text, file_.string()))) return false;
  saved_ = history.state;
  for (std::size_t i = record; i < records.size(); ++i) history.play(records[i]);
  state_ = std::move(history.state);
  steps_ = std::move(history.steps);
  done_ = history.done;
  const Patch lost = difference(saved_, state_);
  if (lost.changes_map()) notes_.push_back("changes that were not saved are taken over from the journal");
  return true;
}

void Session::restore_from_journal() {
  const auto& records = journal_.records();
  History history;
  if (records[0].contains("hash")) history.state = state_of(map::parse(journal_.base(), file_.string()));
  State saved = history.state;
  const std::vector<Save> all = saves();
  auto next = all.begin();
  for (std::size_t i = 1; i < records.size(); ++i) {
    for (; next != all.end() && next->record == i; ++next) {
      if (next->acknowledged) saved = history.state;
    }
    history.play(records[i]);
  }
  saved_ = std::move(saved);
  state_ = std::move(history.state);
  steps_ = std::move(history.steps);
  done_ = history.done;
}

void Session::take_outside_change(const std::string& text) {
  State next = matched(state_, map::parse(text, file_.string()));
  next.desk = state_.desk;
  if (!journal_.writable()) {
    state_ = saved_ = std::move(next);
    steps_.clear();
    done_ = 0;
    return;
  }
  commit(std::string(kOutsideChange), std::move(next));
  journal_.append({{"save", content_hash(text)}});
  journal_.append({{"saved", content_hash(text)}});
  saved_ = state_;
  notes_.push_back(
      "another program has changed the map since it was saved; that is a step which can be undone");
}

Units Session::units() const {
  return units_of(state_);
}

Report Session::run(const Call& call) {
  Report report;
  if (call.command == nullptr) return report;
  if (const auto* about = std::get_if<SessionFunction>(&call.command->run)) {
    (*about)(*this, call.arguments, report);
    return report;
  }
  Edit edit{state_, file_.string(), {}, clipboard_, renderer_};
  std::get<EditFunction>(call.command->run)(edit, call.arguments);
  commit(call.line, std::move(edit.state));
  return std::move(edit.report);
}

std::vector<Report> Session::run_script(const std::vector<ScriptLine>& lines, const std::string& name) {
  std::vector<Report> reports;
  std::vector<std::string> run_lines;
  Edit edit{state_, file_.string(), {}, clipboard_, renderer_};
  for (const ScriptLine& line : lines) {
    try {
      const Call call = parse_script_line(line.text, units_of(edit.state));
      edit.report = {};
      if (call.command == nullptr || call.command->name == "save") continue;
      const auto* run = std::get_if<EditFunction>(&call.command->run);
      if (run == nullptr) {
        refuse("`" + std::string(call.command->name) + "` has no place in a script, which is one step");
      }
      (*run)(edit, call.arguments);
      run_lines.push_back(call.line);
    } catch (const Error& error) {
      throw Error(error.code(), error.what(), {line.file, line.line, {}});
    }
    reports.push_back(std::move(edit.report));
  }
  commit(name, std::move(edit.state), std::move(run_lines));
  return reports;
}

/// What is in the journal has happened; what is not has not.
void Session::commit(const std::string& line, State next, std::vector<std::string> lines) {
  Patch patch = difference(state_, next);
  if (patch.empty()) return;
  begin_journal();
  Json record = {{"do", line}, {"patch", to_json(patch)}};
  if (!lines.empty()) record["lines"] = lines;
  journal_.append(record);
  steps_.resize(done_);
  steps_.push_back({line, {}, std::move(patch), std::move(lines)});
  ++done_;
  state_ = std::move(next);
  update_unsaved();
}

void Session::begin_journal() {
  if (!journal_.records().empty()) return;
  Json first = {{"map", file_.filename().string()}, {"brushes", shape_of(saved_)}};
  const bool exists = !base_text_.empty();
  if (exists) first["hash"] = content_hash(base_text_);
  journal_.start(std::move(first), std::move(base_text_));
}

std::vector<std::string> Session::go_to(std::size_t place, const char* record) {
  std::vector<std::string> texts;
  State next = state_;
  for (std::size_t at = done_; at != place;) {
    const bool back = place < at;
    const Step& step = steps_[back ? --at : at++];
    apply(next, back ? inverse(step.patch) : step.patch);
    texts.push_back(step.text());
  }
  if (texts.empty()) return texts;
  journal_.append({{record, texts.size()}});
  done_ = place;
  state_ = std::move(next);
  update_unsaved();
  return texts;
}

std::vector<std::string> Session::undo(std::size_t count) {
  return go_to(done_ - std::min(count, done_), "undo");
}

std::vector<std::string> Session::redo(std::size_t count) {
  return go_to(done_ + std::min(count, steps_.size() - done_), "redo");
}

void Session::checkpoint(const std::string& name) {
  begin_journal();
  journal_.append({{"checkpoint", name}});
  steps_.resize(done_);
  steps_.push_back({{}, name, {}, {}});
  ++done_;
}

std::string Session::text() const {
  return print(state_, file_);
}

void Session::save() {
  if (!unsaved_) return;
  const std::string text = this->text();
  const std::string hash = content_hash(text);
  begin_journal();
  journal_.append({{"save", hash}});
  write_file_atomically(file_, text);
  journal_.append({{"saved", hash}});
  saved_ = state_;
  update_unsaved();
}

void Session::update_unsaved() {
  unsaved_ = difference(saved_, state_).changes_map();
}

std::string recover(const fs::path& map) {
  const fs::path path = journal_path(map);
  std::error_code none;
  if (!fs::exists(path, none)) throw Error(ErrorCode::kIo, "there is no journal", {path.string(), 0, {}});
  const Journal::Reading reading = Journal::read_text(read_file(path), path);
  if (reading.records.empty()) {
    throw Error(ErrorCode::kBadInput, "the journal's beginning cannot be read", {path.string(), 1, {}});
  }
  return last_text(reading, map.string());
}

std::string last_text(const Journal::Reading& reading, const std::string& file) {
  try {
    History history;
    if (!reading.records.empty() && reading.records[0].contains("hash"))
      history.state = state_of(map::parse(reading.base, file));
    for (const Json& record : reading.records) history.play(record);
    return print(history.state, file);
  } catch (const Json::exception& fault) {
    refuse_record(fault, file);
  }
}

}  // namespace hallway::editor
