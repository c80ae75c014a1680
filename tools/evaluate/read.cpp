#include "tools/evaluate/read.h"

#include "tools/client/fields.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <istream>
#include <optional>
#include <string_view>
#include <vector>

namespace locus::evaluate {

namespace {

// Beyond these no sum of squares is safe, and no site or clock is there.
constexpr double largest_m = 1e9, largest_s = 1e11;

constexpr std::string_view white = " \t\r\v\f";

std::string_view trimmed(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(white);
    if (begin == std::string_view::npos) return {};
    return line.substr(begin, line.find_last_not_of(white) - begin + 1);
}

class Lines {
  public:
    Lines(std::istream& stream, const std::string& name) : stream_(stream), name_(name) {}

    /// The next line that says something, without white space at its ends; false at the end.
    bool next(std::string_view& line) {
        while (std::getline(stream_, text_)) {
            ++number_;
            line = trimmed(text_);
            if (!line.empty() && line.front() != '#') return true;
        }
        return false;
    }

    [[noreturn]] void fail(const std::string& sentence) const {
        throw FileError(fmt::format("{}:{}: {}", name_, number_, sentence));
    }

  private:
    std::istream& stream_;
    const std::string& name_;
    std::string text_;
    std::size_t number_ = 0;
};

double parse(std::string_view word, const Lines& lines) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
        lines.fail(fmt::format("\"{}\" is not a number", tools::printable(word.substr(0, 40))));
    if (!std::isfinite(value)) lines.fail(fmt::format("\"{}\" is not a finite number", word));
    return value;
}

std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> result;
    for (std::size_t begin = 0; (begin = line.find_first_not_of(white, begin)) != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(white, begin), line.size());
        result.push_back(line.substr(begin, end - begin));
        begin = end;
    }
    return result;
}

void append(Track& track, const TrackPoint& point, const Lines& lines) {
    if (!(std::abs(point.time_s) < largest_s)) lines.fail(fmt::format("a time of {} s cannot be", point.time_s));
    if (!(point.position_m.cwiseAbs().maxCoeff() < largest_m))
        lines.fail(fmt::format("a coordinate beyond {} m cannot be", largest_m));
    if (!track.empty() && point.time_s <= track.back().time_s)
        lines.fail(fmt::format("times must increase: {:.9f} follows {:.9f}", point.time_s, track.back().time_s));
    track.push_back(point);
}

TrackPoint tum_point(std::string_view line, const Lines& lines) {
    const auto columns = words(line);
    if (columns.size() != 8 && columns.size() != 4)
        lines.fail(fmt::format("{} columns, but a TUM line has 8: t x y z qx qy qz qw", columns.size()));
    std::vector<double> values;
    for (const auto column : columns) values.push_back(parse(column, lines));
    return {values[0], {values[1], values[2], values[3]}};
}

// A target's pose, or nothing when the line is of another class.
std::optional<nlohmann::json> pose(std::string_view line, const Lines& lines) {
    auto fields = nlohmann::json::parse(line, nullptr, false);
    if (!fields.is_object()) lines.fail("not a JSON object");
    const std::string class_name = tools::text(fields, "class");
    if (class_name.empty()) lines.fail("a JSON line without a class: POSE lines are expected");
    return class_name == "POSE" ? std::optional{std::move(fields)} : std::nullopt;
}

TrackPoint pose_point(const nlohmann::json& pose, const Lines& lines) {
    const auto time_s = tools::number(pose, "time");
    const auto position_m = tools::vector3(pose, "position_site_m");
    if (!time_s) lines.fail("a POSE without a time");
    if (!position_m) lines.fail("a POSE without a position_site_m of three numbers");
    return {*time_s, Eigen::Vector3d(position_m->data()),
            tools::number(pose, "horizontal_error_95_m").value_or(no_bound),
            tools::number(pose, "vertical_error_95_m").value_or(no_bound)};
}

std::ifstream open(const std::string& path) {
    std::ifstream stream(path);
    if (!stream) throw FileError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
    return stream;
}

Track checked(Track track, const std::istream& stream, const std::string& path, const std::string& target) {
    if (stream.bad()) throw FileError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    if (track.empty() && target.empty()) throw FileError(fmt::format("{}: holds no pose", path));
    if (track.empty()) throw FileError(fmt::format("{}: holds no pose of \"{}\"", path, target));
    return track;
}

} // namespace

Track read_tum(std::istream& stream, const std::string& name, RepeatedTime repeated) {
    Track track;
    Lines lines(stream, name);
    for (std::string_view line; lines.next(line);) {
        const TrackPoint point = tum_point(line, lines);
        const bool again = !track.empty() && point.time_s == track.back().time_s;
        if (!again || repeated == RepeatedTime::refused) append(track, point, lines);
    }
    return track;
}

Track read_pose_lines(std::istream& stream, const std::string& name, const std::string& target) {
    Track track;
    Lines lines(stream, name);
    std::string wanted = target;
    for (std::string_view line; lines.next(line);) {
        const auto fields = pose(line, lines);
        if (!fields) continue;
        const std::string found = tools::text(*fields, "target");
        if (track.empty() && target.empty()) wanted = found;
        if (found != wanted && target.empty())
            lines.fail(fmt::format(R"(poses of two targets, "{}" and "{}": choose one with --target)", wanted, found));
        if (found == wanted) append(track, pose_point(*fields, lines), lines);
    }
    return track;
}

Track read_truth(const std::string& path) {
    std::ifstream stream = open(path);
    return checked(read_tum(stream, path, RepeatedTime::passed_over), stream, path, "");
}

Track read_estimate(const std::string& path, const std::string& target) {
    std::ifstream stream = open(path);
    const bool json = (stream >> std::ws).peek() == '{';
    stream.clear();
    stream.seekg(0);
    Track track = json ? read_pose_lines(stream, path, target) : read_tum(stream, path);
    return checked(std::move(track), stream, path, target);
}

} // namespace locus::evaluate
