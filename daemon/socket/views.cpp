#include "daemon/socket/views.h"

#include "daemon/socket/answers.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace locus {
namespace {

constexpr Duration patience = std::chrono::seconds{3};

const InputEntry* camera_called(const Roster& roster, const std::string& name) {
    const auto found = std::ranges::find_if(
        roster.inputs, [&](const InputEntry& entry) { return entry.view != nullptr && entry.name == name; });
    return found == roster.inputs.end() ? nullptr : &*found;
}

std::string cameras_there_are(const Roster& roster) {
    std::vector<std::string> names;
    for (const InputEntry& entry : roster.inputs)
        if (entry.view) names.push_back(entry.name);
    return names.empty() ? "none is configured and enabled" : fmt::format("there are {}", fmt::join(names, ", "));
}

/// Of the camera's tracks, by the poses that say so.
camera::TrackNames names_of(const std::string& name, const Picture& picture, const Roster& roster) {
    camera::TrackNames names;
    for (const auto& [address, view] : picture.targets()) {
        const SeenAs& seen = view.pose.seen_as;
        if (seen.camera == no_address || roster.names.source(SourceKind::camera, seen.camera) != name) continue;
        names.emplace(seen.track, roster.names.target(address));
    }
    return names;
}

std::string base64(const std::string& bytes) {
    using namespace boost::archive::iterators;
    using Letters = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
    std::string text(Letters(bytes.begin()), Letters(bytes.end()));
    return text.append((3 - bytes.size() % 3) % 3, '=');
}

std::string nothing_came(const InputEntry& entry) {
    const std::string trouble = entry.status ? entry.status->trouble.get() : "";
    return fmt::format("camera \"{}\" gives no picture{}", entry.name, trouble.empty() ? "" : ": " + trouble);
}

} // namespace

std::string Views::ask(ClientId client, const std::string& camera, const Picture& picture, const Roster& roster,
                       Timestamp now) {
    const InputEntry* entry = camera_called(roster, camera);
    if (entry == nullptr) return fmt::format("there is no camera \"{}\"; {}", camera, cameras_there_are(roster));
    entry->view->ask(names_of(camera, picture, roster));
    waiting_.push_back({client, camera, now});
    return {};
}

void Views::serve(const Roster& roster, Timestamp now, const Answer& answer) {
    std::erase_if(waiting_, [&](const Waiting& one) {
        const InputEntry* entry = camera_called(roster, one.camera);
        if (entry == nullptr) return answer(one.client, error_line("the camera is gone from the settings")), true;
        if (const auto picture = entry->view->picture())
            return answer(one.client, view_line(one.camera, base64(*picture))), true;
        if (now - one.since < patience) return false;
        return answer(one.client, error_line(nothing_came(*entry))), true;
    });
}

} // namespace locus
