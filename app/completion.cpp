// SPDX-License-Identifier: MIT
#include "completion.hpp"

#include <algorithm>
#include <set>

#include "base/text.hpp"
#include "host/load/search.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

/// What stands for a value in help texts, and the files that it may be.
struct ValueWord {
  const char* word;
  std::vector<std::string> endings;
  bool folders;
};

const std::vector<ValueWord>& value_words() {
  static const std::vector<ValueWord> kWords{{"MAP", {"map"}, false},
                                             {"SCENARIO", {"toml"}, false},
                                             {"CONFIG", {"toml"}, false},
                                             {"PLAN", {"toml"}, false},
                                             {"LOG", {"mcap", "csv"}, true},
                                             {"RUN", {}, true},
                                             {"DIR", {}, true},
                                             {"CLOUD", {"ply", "pcd", "csv", "obj", "png"}, false},
                                             {"LIBRARY", {"so"}, false},
                                             {"LIBRARY[:ID]", {"so"}, false},
                                             {"PROFILE", {"toml"}, false},
                                             {"SCRIPT", {"hwe"}, false},
                                             {"MODEL", {}, false},
                                             {"FILE", {}, false}};
  return kWords;
}

void add_plugins(Completion& completion, std::span<const fs::path> folders) {
  std::set<std::string> names;
  for (const fs::path& file : host::library_files(folders)) names.insert(file.stem().string());
  for (const std::string& name : names) completion.words.push_back({name, "plugin"});
  completion.files = true;
  completion.endings.emplace_back("so");
}

/// Adds what the value of an option may be.
void add_values(Completion& completion, const Option& option, std::span<const fs::path> plugin_folders) {
  for (const std::string& word : option.words()) completion.words.push_back({word, ""});
  if (option.value_name().starts_with("NAME|FILE")) {
    add_plugins(completion, plugin_folders);
    return;
  }
  bool every_file = false;
  for (const std::string_view part : split(option.value_name(), '|')) {
    for (const ValueWord& known : value_words()) {
      if (part != known.word) continue;
      completion.folders |= known.folders;
      completion.endings.insert(completion.endings.end(), known.endings.begin(), known.endings.end());
      every_file |= known.endings.empty() && !known.folders;
    }
  }
  completion.files = every_file || !completion.endings.empty();
  if (every_file) completion.endings.clear();
}

const Option* find_option(const Command& command, std::string_view name) {
  for (const auto& option : command.options()) {
    const auto names = option->name_list();
    if (!option->is_argument() && std::ranges::find(names, name) != names.end()) return option.get();
  }
  return nullptr;
}

/// What the words before the one that is typed lead to.
struct Place {
  const Command* command;
  const Option* waiting = nullptr;       ///< for its value
  std::set<const Option*> given{};       ///< options that are there
  std::vector<std::string> arguments{};  ///< words that are no options
};

Place place_of(const Command& program, std::span<const std::string> words) {
  Place place{.command = &program};
  bool plain = false;  // behind "--", or among the words of rest()
  for (const std::string& word : words) {
    if (place.waiting != nullptr) {
      place.waiting = nullptr;
      continue;
    }
    if (!plain && word == "--") {
      plain = true;
    } else if (!plain && word.starts_with("-")) {
      const Option* option = find_option(*place.command, std::string_view(word).substr(0, word.find('=')));
      if (option == nullptr) continue;
      place.given.insert(option);
      if (!option->is_flag() && word.find('=') == std::string::npos) place.waiting = option;
    } else if (const Command* below = place.command->find(word)) {
      place = {.command = below};
    } else {
      place.arguments.push_back(word);
      const bool all_taken = place.arguments.size() > place.command->arguments().size();
      plain |= all_taken && place.command->rest() != nullptr;
    }
  }
  return place;
}

void add_options(Completion& completion, const Place& place) {
  for (const auto& option : place.command->options()) {
    if (option->is_argument() || (place.given.contains(option.get()) && !option->is_repeatable())) continue;
    completion.words.push_back({option->name_list().back(), option->help()});
  }
  completion.words.push_back({"--help", "Print this help message and exit"});
  if (!place.command->version().empty())
    completion.words.push_back({"--version", "Print the version and exit"});
}

void add_words_of_rest(Completion& completion, const Place& place, const std::string& current) {
  std::vector<std::string> words = place.arguments;
  words.push_back(current);
  for (std::string& word : place.command->rest_completer()(words))
    completion.words.push_back({std::move(word), ""});
}

Completion candidates(const Place& place, const std::string& current,
                      std::span<const fs::path> plugin_folders) {
  Completion completion;
  const auto arguments = place.command->arguments();
  if (place.waiting != nullptr) {
    add_values(completion, *place.waiting, plugin_folders);
  } else if (place.arguments.size() >= arguments.size() && place.command->rest_completer()) {
    add_words_of_rest(completion, place, current);
  } else if (current.starts_with("-")) {
    add_options(completion, place);
  } else if (!place.command->commands().empty()) {
    for (const auto& command : place.command->commands())
      completion.words.push_back({command->name(), command->about()});
  } else if (place.arguments.size() < arguments.size()) {
    add_values(completion, *arguments[place.arguments.size()], plugin_folders);
  } else {
    add_options(completion, place);
  }
  return completion;
}

}  // namespace

Completion complete(const Command& program, std::span<const std::string> words,
                    std::span<const fs::path> plugin_folders) {
  if (words.empty()) return {};
  const std::string& current = words.back();
  Place place = place_of(program, words.first(words.size() - 1));
  std::string prefix;  // "--plugin=" of "--plugin=slam"
  if (const std::size_t equals = current.find('=');
      current.starts_with("--") && equals != std::string::npos) {
    const Option* option = find_option(*place.command, std::string_view(current).substr(0, equals));
    if (option != nullptr && place.waiting == nullptr) {
      place.waiting = option;
      prefix = current.substr(0, equals + 1);
    }
  }
  Completion completion = candidates(place, current, plugin_folders);
  for (Completion::Candidate& candidate : completion.words) candidate.word.insert(0, prefix);
  std::erase_if(completion.words,
                [&](const auto& candidate) { return !candidate.word.starts_with(current); });
  return completion;
}

std::string print_completion(const Completion& completion) {
  std::string text;
  for (const Completion::Candidate& candidate : completion.words) {
    text += candidate.word;
    if (!candidate.about.empty()) text += "\t" + candidate.about;
    text += '\n';
  }
  if (completion.folders) text += ":folders\n";
  if (!completion.files) return text;
  text += ":files\t";
  for (const std::string& ending : completion.endings) text += (text.back() == '\t' ? "" : " ") + ending;
  return text + "\n";
}

}  // namespace hallway::cli
