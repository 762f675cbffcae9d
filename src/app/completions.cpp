// One script for each shell; each completes commands, options, files of the right kind and choices.
#include <spdlog/fmt/fmt.h>

#include "app/command_pages.hpp"
#include "base/error.hpp"
#include "base/names.hpp"

namespace dygita {

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

std::vector<std::string> command_names(const std::vector<CommandRow>& rows) {
  std::vector<std::string> names;
  for (size_t i = 1; i < rows.size(); ++i) names.push_back(rows[i].name);
  return names;
}

std::vector<std::string> option_names(const CommandRow& command) {
  std::vector<std::string> names;
  for (const OptionRow& option : command.options)
    if (!option.is_positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// bash

std::string bash_value(const std::string& value) {
  if (const std::vector<std::string> choices = choices_of(value); !choices.empty())
    return fmt::format("compgen -W '{}' -- \"$word\"", joined(choices, " "));
  if (value == "DIR") return "compgen -d -- \"$word\"";
  if (const std::string ending = ending_of(value); !ending.empty())
    return fmt::format("compgen -f -X '!*{}' -- \"$word\"; compgen -d -- \"$word\"", ending);
  return value == "FILE" ? "compgen -f -- \"$word\"" : ":";
}

std::string bash_script(const std::vector<CommandRow>& rows) {
  std::string values, arguments;
  for (const CommandRow& command : rows) {
    for (const OptionRow& option : command.options) {
      if (option.value.empty()) continue;
      if (option.is_positional) arguments += fmt::format("    {}) {} ;;\n", command.name, bash_value(option.value));
      for (const std::string& name : option.is_positional ? std::vector<std::string>{} : option.names)
        values += fmt::format("    '{} {}') {}; return ;;\n", command.name, name, bash_value(option.value));
    }
  }
  std::string options = fmt::format("    '') names='{} {}' ;;\n", joined(command_names(rows), " "),
                                    joined(option_names(rows.front()), " "));
  for (size_t i = 1; i < rows.size(); ++i)
    options += fmt::format("    {}) names='{}' ;;\n", rows[i].name, joined(option_names(rows[i]), " "));
  return fmt::format(R"(# bash completion of dygita, printed by dygita --completion bash
_dygita_words() {{
  local word="$1" before="$2" command="$3" names=''
  case "$command $before" in
{}  esac
  case "$command" in
{}  esac
  if [[ "$word" == -* || -z "$command" ]]; then
    compgen -W "$names" -- "$word"
    return
  fi
  case "$command" in
{}  esac
}}

_dygita() {{
  local command='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "${{COMP_WORDS[i]}}" in
    {}) command="${{COMP_WORDS[i]}}"; break ;;
    esac
  done
  mapfile -t COMPREPLY < <(_dygita_words "${{COMP_WORDS[COMP_CWORD]}}" "${{COMP_WORDS[COMP_CWORD - 1]}}" "$command")
}}

complete -o filenames -F _dygita dygita
)",
                     values, options, arguments, joined(command_names(rows), " | "));
}

// zsh

// Inside '...' in a specification of _arguments or _describe.
std::string zsh_text(std::string text) {
  for (const char* special : {"\\", "[", "]", ":"}) text = replaced(text, special, std::string("\\") + special);
  return replaced(text, "'", "'\\''");
}

std::string zsh_value(const std::string& value) {
  if (const std::vector<std::string> choices = choices_of(value); !choices.empty())
    return ":value:(" + joined(choices, " ") + ")";
  if (value == "DIR") return ":folder:_files -/";
  if (const std::string ending = ending_of(value); !ending.empty())
    return fmt::format(":file:_files -g \"*{}\"", ending);
  return value == "FILE" ? ":file:_files" : ":" + zsh_text(value) + ": ";
}

std::string zsh_arguments(const CommandRow& command) {
  std::string specifications;
  for (const OptionRow& option : command.options) {
    const std::string value = option.value.empty() ? "" : zsh_value(option.value);
    if (option.is_positional) specifications += fmt::format(" \\\n        '1{}'", value);
    for (const std::string& name : option.is_positional ? std::vector<std::string>{} : option.names)
      specifications +=
          fmt::format(" \\\n        '{}{}[{}]{}'", option.is_repeated ? "*" : "", name, zsh_text(option.doc), value);
  }
  return specifications;
}

std::string zsh_script(const std::vector<CommandRow>& rows) {
  std::string commands, cases;
  for (size_t i = 1; i < rows.size(); ++i) {
    commands += fmt::format("        '{}:{}'\n", rows[i].name, zsh_text(rows[i].doc));
    cases += fmt::format("      {})\n        _arguments{}\n        ;;\n", rows[i].name, zsh_arguments(rows[i]));
  }
  return fmt::format(R"(#compdef dygita
# zsh completion of dygita, printed by dygita --completion zsh
_dygita() {{
  local context state state_descr line
  typeset -A opt_args
  _arguments -C{} \
        '1:command:->command' '*::argument:->argument'
  case $state in
    command)
      local -a commands
      commands=(
{}      )
      _describe command commands
      ;;
    argument)
      case $words[1] in
{}      esac
      ;;
  esac
}}

if [[ "$funcstack[1]" == _dygita ]]; then _dygita "$@"; else compdef _dygita dygita; fi
)",
                     zsh_arguments(rows.front()), commands, cases);
}

// fish

std::string fish_text(const std::string& text) { return replaced(replaced(text, "\\", "\\\\"), "'", "\\'"); }

// The options of `complete` for a value, after -r.
std::string fish_value(const std::string& value) {
  if (const std::vector<std::string> choices = choices_of(value); !choices.empty())
    return fmt::format(" -x -a '{}'", joined(choices, " "));
  if (value == "DIR") return " -x -a '(__fish_complete_directories)'";
  if (const std::string ending = ending_of(value); !ending.empty())
    return fmt::format(" -k -x -a '(__fish_complete_suffix {})'", ending);
  return value == "FILE" ? " -r -F" : " -x";
}

std::string fish_option(const OptionRow& option, const std::string& when) {
  const std::string value = option.value.empty() ? "" : fish_value(option.value);
  if (option.is_positional) return fmt::format("complete -c dygita{}{}\n", when, value);
  std::string line = "complete -c dygita" + when;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return line + value + " -d '" + fish_text(option.doc) + "'\n";
}

std::string fish_script(const std::vector<CommandRow>& rows) {
  std::string script = "# fish completion of dygita, printed by dygita --completion fish\ncomplete -c dygita -f\n";
  for (const OptionRow& option : rows.front().options) script += fish_option(option, " -n __fish_use_subcommand");
  for (size_t i = 1; i < rows.size(); ++i) {
    script += fmt::format("complete -c dygita -n __fish_use_subcommand -a {} -d '{}'\n", rows[i].name,
                          fish_text(rows[i].doc));
    const std::string when = fmt::format(" -n '__fish_seen_subcommand_from {}'", rows[i].name);
    for (const OptionRow& option : rows[i].options) script += fish_option(option, when);
  }
  return script;
}

}  // namespace

const std::vector<std::string>& known_shells() {
  static const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  return shells;
}

std::string completion_script(const std::vector<CommandRow>& rows, const std::string& shell) {
  if (shell == "bash") return bash_script(rows);
  if (shell == "zsh") return zsh_script(rows);
  if (shell == "fish") return fish_script(rows);
  throw InputError(fmt::format("--completion {}: no such shell\n    {}", shell, did_you_mean(shell, known_shells())));
}

}  // namespace dygita
