// What a calibration found, into a settings file that people wrote: only the numbers change, comments and order stay.
#pragma once

#include "fusion/measurement.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::calibrate {

struct AnchorEdit {
    Address anchor = no_address;
    std::optional<Vec3> position_site_m;
    std::optional<double> range_bias_m;
};

/// The text with the edits in it, read again and compared. Throws std::runtime_error with a sentence when an anchor is
/// not there, is written in a form that cannot be edited, or the result does not say what it should.
std::string merged(const std::string& yaml, const std::vector<AnchorEdit>& edits);

/// The file with the edits, in one step: it is the old or the new one, whatever happens. Throws as merged() does, and
/// when the file cannot be read or written.
void merge_into(const std::string& path, const std::vector<AnchorEdit>& edits);

/// "[1.234, 0, 2.5]", to the millimetre.
std::string yaml_of(const Vec3& position_m);
/// To the millimetre.
std::string yaml_of(double length_m);

} // namespace locus::calibrate
