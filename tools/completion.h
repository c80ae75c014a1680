// Shell completion from the command line's own tree: a new command or option is completed without another word.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace locus::tools {

/// Scripts to be sourced by the shell; after the last known word they fall back to file names.
std::string bash_completion(const CLI::App& root);
std::string zsh_completion(const CLI::App& root);

} // namespace locus::tools
