// SPDX-License-Identifier: MIT
#include "help_commands.hpp"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "completion.hpp"
#include "console.hpp"
#include "man_page.hpp"
#include "program.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

Json option_json(const Option& option) {
  Json json{{"names", option.name_list()},
            {"kind", option.is_argument() ? "argument"
                     : option.is_flag()   ? "flag"
                                          : "option"},
            {"value", option.is_flag() ? Json() : Json(option.value_name())},
            {"about", option.about()},
            {"without", option.fallback_text().empty() ? Json() : Json(option.fallback_text())},
            {"required", option.is_required()},
            {"repeatable", option.is_repeatable()},
            {"shared", option.is_shared()}};
  if (!option.words().empty()) json["words"] = option.words();
  if (option.limits()) json["range"] = {option.limits()->first, option.limits()->second};
  return json;
}

/// The command that the words name. Throws Error{kUsage} with the nearest name.
const Command& find_command(const Command& program, const std::vector<std::string>& words) {
  const Command* command = &program;
  for (const std::string& word : words) command = &command_below(*command, word);
  return *command;
}

int print_help(const Command& program, const std::vector<std::string>& words, bool json) {
  find_command(program, words);
  if (json) {
    print_json(commands_json(program));
    return 0;
  }
  std::vector<std::string> arguments{program.name()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  arguments.emplace_back("--help");
  return run_program(program, arguments);
}

void add_help_command(Command& program) {
  struct Options {
    std::vector<std::string> words;
    bool json = false;
  };
  Command& command = program.command("help", "Explain a command, as its option --help does");
  const auto options = std::make_shared<Options>();
  command.argument("command", &options->words, "The command's words").value("COMMAND");
  add_shared(command, Shared::kJson, &options->json);
  command.footer("With --json: every command with its options, as data.\nExample: " + program.name() +
                 " help " + program.commands().front()->name());
  command.action([&program, options] { return print_help(program, options->words, options->json); });
}

void add_completion_command(Command& program) {
  Command& command =
      program.command(kCompletionCommand, "Print a script that makes a shell complete commands and options");
  const auto shell = std::make_shared<std::string>();
  command.argument("shell", shell.get(), "The shell")
      .required()
      .value("SHELL")
      .choices({"bash", "zsh", "fish"});
  const std::string& name = program.name();
  command.footer("Installed packages bring these scripts with them.\nExamples: source <(" + name +
                 " completion bash)\n          " + name + " completion fish > ~/.config/fish/completions/" +
                 name + ".fish");
  command.action([&program, shell] {
    print_result(completion_script(program.name(), *shell));
    return 0;
  });
}

int print_man_pages(const Command& program, const std::vector<std::string>& words, const fs::path& folder) {
  const Command& command = find_command(program, words);
  if (folder.empty()) {
    print_result(print_man_page(command));
    return 0;
  }
  make_folder(folder);
  for (const Command* each : with_commands_below(command))
    write_file_atomically(folder / man_page_name(*each), print_man_page(*each));
  return 0;
}

void add_man_command(Command& program) {
  struct Options {
    std::vector<std::string> words;
    std::string out;
  };
  Command& command = program.command("man", "Print the manual page of a command, for man -l");
  const auto options = std::make_shared<Options>();
  command.argument("command", &options->words, "The command's words").value("COMMAND");
  add_shared(command, Shared::kOutFolder, &options->out)
      .fallback(
          "one page on standard output; with DIR the command's page and those of all commands below it");
  command.footer("Example: " + program.name() + " man " + program.commands().front()->name() + " | man -l -");
  command.action([&program, options] { return print_man_pages(program, options->words, options->out); });
}

}  // namespace

void add_help_commands(Command& program) {
  add_help_command(program);
  add_completion_command(program);
  add_man_command(program);
}

Json commands_json(const Command& program) {
  Json commands = Json::array();
  for (const Command* command : with_commands_below(program)) {
    Json options = Json::array();
    for (const auto& option : command->options()) options.push_back(option_json(*option));
    commands.push_back({{"command", command->path()},
                        {"about", command->about()},
                        {"group", !command->commands().empty()},
                        {"footer", command->footer()},
                        {"options", std::move(options)}});
  }
  return {{"schema", "hallway.commands/1"},
          {"status", 0},
          {"program", program.name()},
          {"version", program.version()},
          {"commands", std::move(commands)}};
}

}  // namespace hallway::cli
