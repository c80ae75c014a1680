#include "tools/completion.h"
#include "tools/command.h"

#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

namespace locus {
namespace tools {
namespace {

/// What can be typed at one place of the command line, with what it is for.
struct Place {
    std::string path; ///< words of the subcommands that lead here, each with a blank in front
    std::vector<std::pair<std::string, std::string>> words;
};

std::vector<const CLI::App*> subcommands(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

void collect(const CLI::App& app, const std::string& path, std::vector<Place>& places) {
    Place place{path, {}};
    for (const auto* sub : subcommands(app)) place.words.emplace_back(sub->get_name(), sub->get_description());
    for (const auto* option : app.get_options())
        for (const auto& name : option->get_lnames()) place.words.emplace_back("--" + name, option->get_description());
    places.push_back(std::move(place));
    for (const auto* sub : subcommands(app)) collect(*sub, fmt::format("{} {}", path, sub->get_name()), places);
}

std::vector<Place> all_places(const CLI::App& root) {
    std::vector<Place> places;
    collect(root, "", places);
    return places;
}

/// One shell word whatever is in it.
std::string shell_word(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// Shell patterns of the paths that lead somewhere: the words before the cursor are walked along them.
std::string known_paths(const std::vector<Place>& places) {
    std::string patterns;
    for (const auto& place : places)
        if (!place.path.empty()) patterns += (patterns.empty() ? "" : "|") + shell_word(place.path);
    return patterns;
}

std::string bash_case(const Place& place) {
    std::string words;
    for (const auto& [word, about] : place.words) words += (words.empty() ? "" : " ") + word;
    return fmt::format("    {}) words={} ;;\n", shell_word(place.path), shell_word(words));
}

/// zsh's _describe takes "word:what it is for"; a colon in the word's own text is escaped.
std::string zsh_item(const std::string& word, const std::string& about) {
    std::string escaped;
    for (const char c : about) escaped += c == ':' ? std::string("\\:") : std::string(1, c == '\n' ? ' ' : c);
    return shell_word(fmt::format("{}:{}", word, escaped));
}

std::string zsh_case(const Place& place) {
    std::string items;
    for (const auto& [word, about] : place.words) items += fmt::format("\n      {}", zsh_item(word, about));
    return fmt::format("    {}) items=({}) ;;\n", shell_word(place.path), items);
}

} // namespace

std::string bash_completion(const CLI::App& root) {
    const auto places = all_places(root);
    std::string cases;
    for (const auto& place : places) cases += bash_case(place);
    return fmt::format(R"sh(# bash completion for locus: eval "$(locus completion bash)"
_locus() {{
  local path= word words=
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path $word" in
    {}) path="$path $word" ;;
    esac
  done
  case "$path" in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}"))
}}
complete -o default -F _locus locus
)sh",
                       known_paths(places), cases);
}

std::string zsh_completion(const CLI::App& root) {
    const auto places = all_places(root);
    std::string cases;
    for (const auto& place : places) cases += zsh_case(place);
    return fmt::format(R"sh(#compdef locus
# zsh completion for locus: eval "$(locus completion zsh)"
_locus() {{
  local place= word
  local -a items
  for word in "${{words[@]:1:$((CURRENT - 2))}}"; do
    case "$place $word" in
    ({}) place="$place $word" ;;
    esac
  done
  case "$place" in
{}  esac
  _describe 'locus' items || _files
}}
compdef _locus locus
)sh",
                       known_paths(places), cases);
}

} // namespace tools

void add_completion(CLI::App& root, int& exit_code) {
    auto shell = std::make_shared<std::string>();
    CLI::App& app = *root.add_subcommand("completion", "Prints a script that makes the shell complete locus's words");
    app.add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
    app.footer("Example:\n  locus completion bash | sudo tee /etc/bash_completion.d/locus\n"
               "Exit codes: 0 printed, 2 no such shell.");
    app.callback([shell, &root, &exit_code] {
        fmt::print("{}", *shell == "bash" ? tools::bash_completion(root) : tools::zsh_completion(root));
        exit_code = exit_yes;
    });
}

} // namespace locus
