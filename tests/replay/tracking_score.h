// How good a tracker is, by the field's own measures, so that figures can be compared with those of papers.
//  CLEAR (Bernardin and Stiefelhagen 2008): in each frame, pairs of the frame before that still overlap by IoU >= 0.5
//  are kept, the rest is assigned with the largest number of pairs, then the largest overlap. A switch: a person's pair
//  has another track than his last pair had. MOTA = 1 - (missed + false + switches) / persons. IDF1 (Ristani et al.
//  2016): persons and tracks are assigned one to one over the whole video so that most boxes agree; IDF1 = 2 agreed /
//  (persons + boxes).
#pragma once

#include "fusion/vision/assignment.h"
#include "fusion/vision/box_geometry.h"

#include <cstdint>
#include <map>
#include <vector>

namespace locus::test {

struct NamedBox {
    std::uint32_t id = 0;
    vision::BoxPx box;
};
using BoxesOfFrame = std::vector<NamedBox>;

struct TrackingScore {
    std::size_t persons = 0, boxes = 0, matched = 0, switches = 0, agreed = 0;

    double recall() const { return share(matched, persons); }
    double precision() const { return share(matched, boxes); }
    double idf1() const { return share(2 * agreed, persons + boxes); }
    double mota() const {
        const std::size_t wrong = (persons - matched) + (boxes - matched) + switches;
        return 1 - share(wrong, persons);
    }

  private:
    static double share(std::size_t part, std::size_t whole) {
        return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
    }
};

/// Call `add` for each frame in order, `score` at the end.
class TrackingScorer {
  public:
    static constexpr float least_iou = 0.5F;

    /// The pairs of this frame: index of the person, index of the box.
    vision::Pairing add(const BoxesOfFrame& persons, const BoxesOfFrame& boxes) {
        vision::Costs costs(persons.size(), boxes.size());
        for (std::size_t i = 0; i < persons.size(); ++i)
            for (std::size_t j = 0; j < boxes.size(); ++j) {
                const float overlap = vision::iou(persons[i].box, boxes[j].box);
                if (overlap < least_iou) continue;
                ++together_[{persons[i].id, boxes[j].id}];
                // A pair that is kept is worth more than the two that it may stand in the way of, and any two pairs
                // more than one that overlaps better: of 1, a new pair is worth 0.1 and a tenth of its overlap of 0.1.
                costs.at(i, j) = (was_pair(persons[i].id, boxes[j].id) ? 0 : 0.9) - 0.01 * overlap;
            }
        const auto pairs = vision::assign(costs, 1);
        score_.persons += persons.size();
        score_.boxes += boxes.size();
        score_.matched += pairs.size();
        for (const auto& [i, j] : pairs) note(persons[i].id, boxes[j].id);
        end_frame(persons, boxes, pairs);
        return pairs;
    }

    TrackingScore score() const {
        TrackingScore score = score_;
        std::vector<std::uint32_t> persons, tracks;
        for (const auto& [pair, count] : together_) {
            if (persons.empty() || persons.back() != pair.first) persons.push_back(pair.first);
            tracks.push_back(pair.second);
        }
        std::sort(tracks.begin(), tracks.end());
        tracks.erase(std::unique(tracks.begin(), tracks.end()), tracks.end());
        vision::Costs costs(persons.size(), tracks.size());
        constexpr double most = 1e6; // frames; the assignment sees whole frames then
        for (std::size_t i = 0; i < persons.size(); ++i)
            for (std::size_t j = 0; j < tracks.size(); ++j)
                if (const auto found = together_.find({persons[i], tracks[j]}); found != together_.end())
                    costs.at(i, j) = most - static_cast<double>(found->second);
        for (const auto& [i, j] : vision::assign(costs, most)) score.agreed += together_.at({persons[i], tracks[j]});
        return score;
    }

  private:
    TrackingScore score_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> together_; ///< frames in which they overlap
    std::map<std::uint32_t, std::uint32_t> last_;                             ///< a person's last track
    std::map<std::uint32_t, std::uint32_t> before_;                           ///< pairs of the frame before

    bool was_pair(std::uint32_t person, std::uint32_t track) const {
        const auto found = before_.find(person);
        return found != before_.end() && found->second == track;
    }
    void note(std::uint32_t person, std::uint32_t track) {
        const auto [place, is_new] = last_.try_emplace(person, track);
        score_.switches += !is_new && place->second != track;
        place->second = track;
    }
    void end_frame(const BoxesOfFrame& persons, const BoxesOfFrame& boxes, const vision::Pairing& pairs) {
        before_.clear();
        for (const auto& [i, j] : pairs) before_[persons[i].id] = boxes[j].id;
    }
};

} // namespace locus::test
