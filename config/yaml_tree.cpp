#include "config/yaml_tree.h"
#include "config/plain_text.h"

#include <fmt/format.h>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>

namespace locus::config {
namespace {

Mark from_zero(const YAML::Mark& mark) { return {mark.line + 1, mark.column + 1}; }

/// Thrown through yaml-cpp's parser, which has no other way to be stopped.
struct Refused {
    Mark mark;
    std::string message;
};

class TreeBuilder : public YAML::EventHandler {
  public:
    explicit TreeBuilder(Problems& problems) : problems_(problems) {}

    YamlNode root;
    bool begun = false;

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (begun) throw Refused{from_zero(mark), "a second document begins here; a settings file is one document"};
        begun = true;
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(mark, "?", anchor, {}, true); }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& text) override {
        leaf(mark, tag, anchor, text, false);
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        throw Refused{from_zero(mark), "aliases (*name) are not understood here; write the value out"};
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        open(YamlNode::Kind::list, mark, tag, anchor);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        open(YamlNode::Kind::map, mark, tag, anchor);
    }
    void OnSequenceEnd() override { open_.pop_back(); }
    void OnMapEnd() override { open_.pop_back(); }

  private:
    /// A list or map whose end has not come yet.
    struct Open {
        YamlNode* node;
        bool has_key = false;
        std::string key;
        Mark key_mark;
    };

    void leaf(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& text,
              bool null) {
        refuse_extras(mark, tag, anchor);
        if (at_key()) return take_key(from_zero(mark), text, null);
        YamlNode& node = place(from_zero(mark));
        node.kind = null ? YamlNode::Kind::nothing : YamlNode::Kind::scalar;
        node.text = text;
        node.quoted = tag == "!";
        if (null && !node.key.empty()) node.mark = node.key_mark; // yaml-cpp marks what follows the gap
    }

    void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
        refuse_extras(mark, tag, anchor);
        if (open_.size() == max_depth) throw Refused{from_zero(mark), "lists and maps are nested too deeply here"};
        if (at_key()) throw Refused{from_zero(mark), "a key must be a plain word, not a list or a map"};
        YamlNode& node = place(from_zero(mark));
        node.kind = kind;
        open_.push_back({&node, false, {}, {}});
    }

    bool at_key() const {
        return !open_.empty() && open_.back().node->kind == YamlNode::Kind::map && !open_.back().has_key;
    }

    void take_key(Mark mark, const std::string& key, bool null) {
        if (null || key.empty()) throw Refused{mark, "a key is missing in front of the colon"};
        Open& map = open_.back();
        if (map.node->children.size() == max_keys) throw Refused{mark, "this map holds too many keys"};
        if (const YamlNode* first = map.node->find(key))
            problems_.add(mark, fmt::format("\"{}\" stands here a second time; first in line {}", shown(key),
                                            first->key_mark.line));
        map.has_key = true;
        map.key = key;
        map.key_mark = mark;
    }

    YamlNode& place(Mark mark) {
        if (++nodes_ > max_nodes) throw Refused{mark, "the file holds too many values"};
        YamlNode* node = &root;
        if (!open_.empty()) {
            Open& parent = open_.back();
            node = &parent.node->children.emplace_back();
            node->key = std::exchange(parent.key, {});
            node->key_mark = parent.key_mark;
            parent.has_key = false;
        }
        node->mark = mark;
        return *node;
    }

    static void refuse_extras(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
        if (anchor != 0)
            throw Refused{from_zero(mark), "anchors (&name) are not understood here; write each value out"};
        const bool core = tag.empty() || tag == "?" || tag == "!";
        if (!core) throw Refused{from_zero(mark), "tags such as !include are not understood; write the value out"};
    }

    Problems& problems_;
    std::vector<Open> open_;
    std::size_t nodes_ = 0;
};

bool read_events(std::string_view text, TreeBuilder& tree, Problems& problems) {
    try {
        std::istringstream stream{std::string(text)};
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(tree)) {
        }
        return true;
    } catch (const Refused& refused) {
        problems.add(refused.mark, refused.message);
    } catch (const YAML::Exception& error) {
        problems.add(from_zero(error.mark), "this is not YAML: " + error.msg);
    }
    return false;
}

} // namespace

const YamlNode* YamlNode::find(std::string_view wanted) const {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const YamlNode& child) { return child.key == wanted; });
    return found == children.end() ? nullptr : &*found;
}

std::optional<YamlNode> parse_yaml(std::string_view text, Problems& problems) {
    if (!is_plain_text(text, problems)) return std::nullopt;
    TreeBuilder tree(problems);
    if (!read_events(text, tree, problems)) return std::nullopt;
    return std::move(tree.root);
}

} // namespace locus::config
