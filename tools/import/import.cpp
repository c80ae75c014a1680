#include "tools/import/import.h"

#include "drivers/recording/measurement_json.h"
#include "tools/import/file_kind.h"
#include "tools/import/navigation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace locus::importing {
namespace {

/// A file, and what was read of it but not written yet.
struct Stream {
    std::unique_ptr<Source> source;
    std::uint16_t input;
    std::vector<Item> items{};
    std::size_t next = 0;
    std::uint32_t sequence = 0;
    bool ended = false;

    /// False at its end.
    bool fill() {
        while (next == items.size() && !ended) {
            items.clear();
            next = 0;
            ended = !source->read(items);
        }
        return next < items.size();
    }
    Timestamp time() const { return items[next].time; }
};

class Recording {
  public:
    Recording(const std::string& path, bool overwrite) : path_{path} {
        if (!path.ends_with(".jsonl"))
            throw std::runtime_error("'" + path + "': the recording's name must end in .jsonl");
        if (!overwrite && std::filesystem::exists(path))
            throw std::runtime_error("'" + path + "' is there already: choose another name, or add --force");
        file_.open(path, std::ios::trunc);
        check();
    }
    void write(const Measurement& measurement) { file_ << to_json_line(measurement) << '\n'; }
    void close() {
        file_.close();
        check();
    }

  private:
    std::string path_;
    std::ofstream file_;

    void check() const {
        if (!file_) throw std::runtime_error(fmt::format("'{}' cannot be written: {}", path_, std::strerror(errno)));
    }
};

class Import {
  public:
    explicit Import(const Request& request) {
        std::vector<FileKind> kinds;
        for (const auto& path : request.files) kinds.push_back(kind_of_file(path));
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] == FileKind::rinex_navigation) open_navigation(request.files[i], request.tag, i);
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] != FileKind::rinex_navigation) open_observed(kinds[i], request, i);
    }

    std::vector<FileReport> go(Recording& recording) {
        begin();
        while (Stream* stream = earliest()) write(*stream, recording);
        recording.close();
        return reports();
    }

  private:
    std::vector<NavigationFile*> navigation_; ///< owned by the streams
    std::vector<Stream> observed_, told_;

    void open_navigation(const std::string& path, Address tag, std::size_t i) {
        auto file = std::make_unique<NavigationFile>(path, tag);
        navigation_.push_back(file.get());
        add(told_, std::move(file), FileKind::rinex_navigation, path, i);
    }

    void open_observed(FileKind kind, const Request& request, std::size_t i) {
        const std::string& path = request.files[i];
        if (kind == FileKind::ubx) return add(observed_, open_ubx_log(path, request.tag), kind, path, i);
        if (kind == FileKind::nmea) return add(observed_, open_nmea_log(path, request.tag), kind, path, i);
        if (kind == FileKind::measurements) return add(observed_, open_measurements(path), kind, path, i);
        if (kind == FileKind::tum) return add(observed_, open_poses(path, request), kind, path, i);
        GlonassSlots slots;
        for (const NavigationFile* file : navigation_) slots.merge(file->glonass_slots());
        add(observed_, open_rinex_observations(path, request.tag, std::move(slots)), kind, path, i);
    }

    static std::unique_ptr<Source> open_poses(const std::string& path, const Request& request) {
        slam::TumSettings settings = request.poses;
        settings.tag = request.tag;
        return open_tum_poses(path, settings, request.poses_shift_s);
    }

    static void add(std::vector<Stream>& streams, std::unique_ptr<Source> source, FileKind kind,
                    const std::string& path, std::size_t i) {
        source->report().path = path;
        source->report().kind = kind_name(kind);
        streams.push_back({std::move(source), static_cast<std::uint16_t>(i)});
    }

    /// Navigation has to do with what was observed: it begins with that.
    void begin() {
        std::optional<Timestamp> first;
        for (Stream& stream : observed_)
            if (stream.fill()) first = std::min(first.value_or(stream.time()), stream.time());
        for (NavigationFile* file : navigation_)
            if (first) file->begin_at(*first);
    }

    /// What was observed at a time comes before what is told then: who reads it knows by then what time it is. After
    /// the last observation nothing more is told.
    Stream* earliest() {
        Stream* found = nullptr;
        const auto look = [&found](Stream& stream) {
            if (stream.fill() && (!found || stream.time() < found->time())) found = &stream;
        };
        for (Stream& stream : observed_) look(stream);
        if (!found && !observed_.empty()) return nullptr;
        for (Stream& stream : told_) look(stream);
        return found;
    }

    static void write(Stream& stream, Recording& recording) {
        const Item& item = stream.items[stream.next++];
        recording.write({item.time, stream.sequence++, stream.input, item.observation});
        FileReport& report = stream.source->report();
        ++report.given[observation_names.at(item.observation.index())];
        if (!report.first) report.first = report.last = item.time;
        report.first = std::min(*report.first, item.time);
        report.last = std::max(report.last, item.time);
    }

    std::vector<FileReport> reports() {
        std::vector<const Stream*> streams;
        for (auto* all : {&observed_, &told_})
            for (Stream& stream : *all) {
                const std::size_t left = stream.items.size() - stream.next;
                if (left > 0) stream.source->report().left_out["words after the last observation"] = left;
                streams.push_back(&stream);
            }
        std::ranges::sort(streams, {}, &Stream::input);
        std::vector<FileReport> reports;
        for (const Stream* stream : streams) reports.push_back(stream->source->report());
        return reports;
    }
};

} // namespace

std::vector<FileReport> import_files(const Request& request) {
    Import import{request};
    Recording recording{request.output, request.overwrite};
    return import.go(recording);
}

} // namespace locus::importing
