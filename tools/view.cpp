// locus view: what a camera of the daemon sees, with the people, their names and the floor drawn in, as a file.
#include "drivers/camera/annotate.h"
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/interrupt.h"

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>

namespace locus {

namespace {

using namespace locus::tools;

struct ViewOptions {
    std::string camera;
    std::string out;
    int frames = 100;
};

bool is_film(const std::string& path) { return std::filesystem::path(path).extension() == ".mjpeg"; }

/// Throws DaemonError when these are no letters of base64.
std::string bytes_of(std::string_view base64) try {
    using namespace boost::archive::iterators;
    using Bytes = transform_width<binary_from_base64<std::string_view::const_iterator>, 8, 6>;
    while (base64.ends_with('=')) base64.remove_suffix(1);
    const std::size_t size = base64.size() * 6 / 8;
    std::string bytes;
    for (Bytes byte(base64.begin()); bytes.size() < size; ++byte) bytes += static_cast<char>(*byte);
    return bytes;
} catch (const boost::archive::iterators::dataflow_exception&) {
    throw DaemonError("the daemon sent a picture that cannot be read");
}

/// The daemon answered that there is none, in its own sentence.
class NoPicture : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string picture(Client& client, const std::string& camera) {
    const Message answer = client.ask("?VIEW=" + nlohmann::json{{"camera", camera}}.dump() + ";\n", "VIEW");
    if (answer.class_name != "VIEW") throw NoPicture(text(answer.fields, "message"));
    return bytes_of(text(answer.fields, "jpeg_base64"));
}

/// JPEG files one after the other, as ffplay, VLC and browsers read them.
bool write_film(Client& client, const ViewOptions& options, std::string& error) {
    std::ofstream file(options.out, std::ios::binary);
    for (int i = 0; i < options.frames && file; ++i) file << picture(client, options.camera) << std::flush;
    if (!file) error = fmt::format("'{}' cannot be written", options.out);
    return error.empty();
}

int view(Client& client, const ViewOptions& options) try {
    std::string error;
    const bool done = is_film(options.out) ? write_film(client, options, error)
                                           : camera::write_picture(options.out, picture(client, options.camera), error);
    if (!done) return complain(error), exit_usage;
    fmt::print("{}\n", options.out);
    return exit_yes;
} catch (const NoPicture& none) {
    complain(none.what());
    return exit_no;
}

} // namespace

void add_view(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App& app = add_client_command(
        root, exit_code,
        {"view", "Writes what a camera sees, with people, names and the floor drawn in", "",
         "Only for root and the daemon's own user: pictures of people are not for everybody.\n"
         "Example:\n  sudo locus view gate --out gate.png\n  sudo locus view gate --out gate.mjpeg --frames 200"},
        [options](Client& client, bool) { return view(client, *options); });
    app.add_option("camera", options->camera, "Name of the camera in the settings")->required();
    app.add_option("--out", options->out, "File to write: .png, .jpg, or .mjpeg for many pictures")
        ->required()
        ->check([](const std::string& path) {
            const auto ending = std::filesystem::path(path).extension();
            const bool known = ending == ".png" || ending == ".jpg" || ending == ".jpeg" || is_film(path);
            return known ? std::string{} : "its name must end with .png, .jpg or .mjpeg";
        });
    app.add_option("--frames", options->frames, "Pictures of a .mjpeg")->check(CLI::Range(1, 100000));
}

} // namespace locus
