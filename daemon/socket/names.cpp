#include "daemon/socket/names.h"

#include <fmt/format.h>

namespace locus {
namespace {

std::string name_or_address(const std::map<Address, std::string>& names, Address address) {
    const auto found = names.find(address);
    return found == names.end() || found->second.empty() ? address_text(address) : found->second;
}

} // namespace

std::string address_text(Address address) { return fmt::format("{:#x}", number(address)); }

Names::Names(const EngineSettings& settings) {
    for (const auto& target : settings.targets) targets_.emplace(target.address, target.name);
    for (const auto& anchor : settings.site.anchors) anchors_.emplace(anchor.address, anchor.name);
}

std::string Names::target(Address address) const { return name_or_address(targets_, address); }

std::string Names::source(SourceKind kind, Address address) const {
    return kind == SourceKind::anchor ? name_or_address(anchors_, address) : address_text(address);
}

} // namespace locus
