#include "daemon/camera/viewfinder.h"

#include <utility>

namespace locus {

void Viewfinder::ask(camera::TrackNames names) {
    const std::lock_guard lock{mutex_};
    names_ = std::move(names);
    picture_.reset();
}

std::shared_ptr<const std::string> Viewfinder::picture() const {
    const std::lock_guard lock{mutex_};
    return picture_;
}

std::optional<camera::TrackNames> Viewfinder::asked() const {
    const std::lock_guard lock{mutex_};
    return names_;
}

void Viewfinder::show(std::string jpeg) {
    const std::lock_guard lock{mutex_};
    names_.reset();
    picture_ = std::make_shared<const std::string>(std::move(jpeg));
}

} // namespace locus
