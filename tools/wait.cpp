// locus wait: for scripts that go on once positions are good enough.
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/client/watching.h"
#include "tools/show/pose_panel.h"
#include "tools/show/words.h"

#include <fmt/format.h>

#include <memory>

namespace locus {

namespace {

using namespace locus::tools;
using nlohmann::json;

struct WaitOptions {
    WatchRequest request;
    double better_than_m = 0;
    double timeout_s = 30;
};

bool good_enough(const Message& message, double better_than_m) {
    const auto error_m = number(message.fields, "horizontal_error_95_m");
    return message.class_name == "POSE" && error_m && *error_m < better_than_m;
}

std::optional<Message> first_good(Client& client, const WaitOptions& options) {
    const Deadline end = deadline_in(options.timeout_s);
    while (auto message = client.receive(end))
        if (good_enough(*message, options.better_than_m)) return message;
    return std::nullopt;
}

bool asked_for(const json& target, const WatchRequest& request) {
    const auto& names = request.targets;
    return names.empty() || std::ranges::find(names, text(target, "name")) != names.end();
}

std::string state(const json& target) {
    if (!flag(target, "has_pose")) return text(target, "missing");
    return fmt::format("known to {} m", figure(number(target, "horizontal_error_95_m"), 2));
}

void explain(Client& client, const WaitOptions& options) {
    complain(fmt::format("no target known to better than {} m after {} s", options.better_than_m, options.timeout_s));
    const Message answer = client.ask("?WATCH={\"enable\":false};?TARGETS;\n", "TARGETS");
    for (const auto& target : list(answer.fields, "targets"))
        if (asked_for(target, options.request)) fmt::print(stderr, "  {}: {}\n", text(target, "name"), state(target));
}

int wait(Client& client, const WaitOptions& options, bool as_json) {
    start_watching(client, options.request);
    const auto good = first_good(client, options);
    if (good) fmt::print("{}\n", as_json ? good->line : pose_line(good->fields));
    if (!good) explain(client, options);
    return good ? exit_yes : exit_no;
}

} // namespace

void add_wait(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<WaitOptions>();
    CLI::App& app = add_client_command(
        root, exit_code,
        {"wait", "Waits until a target's position is good enough", "Print the POSE line that was good enough",
         "Example:\n  locus wait --better-than 0.3 --target forklift-1 --timeout 60 && start-the-job\n"
         "Exit codes: 0 there is such a pose, 1 none in time, 3 the daemon cannot be reached."},
        [options](Client& client, bool as_json) { return wait(client, *options, as_json); });
    app.add_option("--better-than", options->better_than_m, "95 % bound of the horizontal error to get below")
        ->required()
        ->type_name("M")
        ->check(CLI::PositiveNumber);
    app.add_option("--target", options->request.targets, "Only this target; can be given again, then any will do")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_option("--timeout", options->timeout_s, "How long to wait")
        ->type_name("S")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
}

} // namespace locus
