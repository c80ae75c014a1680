#include "daemon/socket/names.h"

#include "fusion/vision/anonymous.h"

#include <fmt/format.h>

namespace locus {
namespace {

std::string name_or_address(const std::map<Address, std::string>& names, Address address) {
    const auto found = names.find(address);
    if (found != names.end() && !found->second.empty()) return found->second;
    if (!vision::is_anonymous(address)) return address_text(address);
    std::string text;
    vision::write_anonymous_name(text, address);
    return text;
}

} // namespace

std::string address_text(Address address) { return fmt::format("{:#x}", number(address)); }

Names::Names(const Settings& settings) {
    for (const auto& target : settings.engine.targets) targets_.emplace(target.address, target.name);
    for (const auto& anchor : settings.engine.site.anchors) anchors_.emplace(anchor.address, anchor.name);
    for (std::size_t i = 0; i < settings.cameras.size(); ++i)
        cameras_.emplace(static_cast<Address>(i), settings.cameras[i].name);
}

std::string Names::target(Address address) const { return name_or_address(targets_, address); }

std::string Names::source(SourceKind kind, Address address) const {
    if (kind == SourceKind::anchor) return name_or_address(anchors_, address);
    return kind == SourceKind::camera ? name_or_address(cameras_, address) : address_text(address);
}

} // namespace locus
