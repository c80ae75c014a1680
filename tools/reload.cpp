// locus reload: the daemon reads its configuration again, or says what is wrong with it and goes on with the old one.
#include "tools/client/command.h"
#include "tools/client/fields.h"

#include <fmt/format.h>

namespace locus {

namespace {

using namespace locus::tools;

int reload(Client& client, bool as_json) {
    const Message answer = client.ask("?RELOAD;\n", "RELOAD");
    const bool done = answer.class_name == "RELOAD" && flag(answer.fields, "ok");
    if (as_json) {
        fmt::print("{}\n", answer.line);
    } else if (done) {
        fmt::print("configuration read again and in force\n");
    } else if (answer.class_name == "ERROR") {
        complain(text(answer.fields, "message"));
    } else {
        complain("the configuration has mistakes, the old one stays in force:");
        for (const auto& problem : list(answer.fields, "problems"))
            if (problem.is_string()) fmt::print(stderr, "  {}\n", printable(problem.get_ref<const std::string&>()));
    }
    return done ? exit_yes : exit_no;
}

} // namespace

void add_reload(CLI::App& root, int& exit_code) {
    add_client_command(
        root, exit_code,
        {"reload", "Has the daemon read its configuration again (root and the daemon's own user)",
         "Print the daemon's RELOAD line as it is",
         "Example:\n  sudo locus reload\n"
         "Exit codes: 0 the new configuration is in force, 1 refused and the old one stays, 3 the daemon "
         "cannot be reached."},
        reload);
}

} // namespace locus
