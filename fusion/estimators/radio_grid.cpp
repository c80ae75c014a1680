#include "fusion/estimators/radio_grid.h"

#include "fusion/geometry/vector.h"
#include "fusion/radio/gaussian_field.h"
#include "fusion/radio/path_loss.h"

#include <algorithm>

namespace locus {
namespace {

constexpr std::size_t most_radio_corners = 4096;
/// Of the cells over which a path loss is written down: it is smooth but for the first metre.
constexpr double path_loss_cell_m = 1;

radio::FloorCells cells_around(const Site& site, double reach_m) {
    Eigen::Vector2d low(0, 0), high(0, 0);
    if (!site.anchors.empty()) low = high = vector(site.anchors[0].position_site_m).head<2>();
    for (const Anchor& anchor : site.anchors) {
        low = low.cwiseMin(vector(anchor.position_site_m).head<2>());
        high = high.cwiseMax(vector(anchor.position_site_m).head<2>());
    }
    const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(reach_m);
    return radio::cells_over(low - margin_m, high + margin_m, path_loss_cell_m, most_radio_corners);
}

/// Every anchor is a beacon. Nothing is known of who cannot be heard: the floor is as low as radios go.
std::shared_ptr<const radio::StrengthGrid> path_loss_grid(const Site& site, const RadioParticlesSettings& settings) {
    const radio::PathLoss loss{settings.power_1m_dbm, settings.exponent, settings.shadowing_db};
    std::vector<Address> beacons;
    for (const Anchor& anchor : site.anchors) beacons.push_back(anchor.address);
    std::ranges::sort(beacons);
    auto grid =
        std::make_shared<radio::StrengthGrid>(cells_around(site, settings.reach_m), beacons, radio::weakest_dbm);
    for (const Anchor& anchor : site.anchors)
        for (std::size_t corner = 0; corner < grid->cells().count(); ++corner) {
            const Eigen::Vector2d place = grid->cells().place_site_m(corner);
            const Eigen::Vector3d tag(place.x(), place.y(), settings.height_m);
            const double distance_m = (vector(anchor.position_site_m) - tag).norm();
            grid->set(grid->index_of(anchor.address), corner,
                      {static_cast<float>(loss.expected_dbm(std::max(1.0, distance_m))),
                       static_cast<float>(settings.shadowing_db * settings.shadowing_db)});
        }
    grid->finish(settings.lost_share);
    return grid;
}

} // namespace

radio::GridInUse::Shared map_grid(const radio::RadioMap& map, double lost_share) {
    return std::make_shared<const radio::StrengthGrid>(radio::gaussian_field(map, {lost_share, most_radio_corners}));
}

std::shared_ptr<const radio::GridInUse> make_radio_grid(const Site& site, const RadioParticlesSettings& settings) {
    const auto in_use = settings.grid ? settings.grid : std::make_shared<radio::GridInUse>();
    if (in_use->is_empty())
        in_use->fill(settings.radio_map ? map_grid(*settings.radio_map, settings.lost_share)
                                        : path_loss_grid(site, settings));
    return in_use;
}

} // namespace locus
