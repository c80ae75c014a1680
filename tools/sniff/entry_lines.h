// The lines of a listing, for people or as JSON.
#pragma once

#include "tools/sniff/listing.h"

#include <optional>

namespace locus::sniff {

class EntryLines {
  public:
    explicit EntryLines(bool json) : json_{json} {}
    void print(const Entry& entry);
    void print_summary(const Listing& listing) const;

  private:
    bool json_;
    std::optional<Timestamp> first_; ///< times are told from there on
};

/// One entry, without the line's end.
std::string entry_text(const Entry& entry, double time_s);
std::string entry_json(const Entry& entry, double time_s);
std::vector<std::string> summary_lines(const Listing& listing);
std::string summary_json(const Listing& listing);

} // namespace locus::sniff
