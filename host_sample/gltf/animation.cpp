#include "animation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "../error.h"

namespace host::gltf {

namespace {

std::optional<Property> to_property(const std::string& path) {
    if (path == "translation") return Property::translation;
    if (path == "rotation") return Property::rotation;
    if (path == "scale") return Property::scale;
    if (path == "weights") return Property::weights;
    return std::nullopt;
}

Interpolation to_interpolation(const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    if (name == "LINEAR") return Interpolation::linear;
    throw InputError("its interpolation " + name.substr(0, 40) + " is unknown");
}

std::vector<float> read_times(const Accessor& accessor, Budget& budget) {
    if (accessor.count() == 0 || accessor.components() != 1)
        throw InputError(accessor.name() + " holds no key times");
    budget.spend(accessor.count());
    std::vector<float> times(accessor.count());
    for (uint64_t i = 0; i < times.size(); ++i) {
        times[i] = accessor.read(i, 0);
        if (!(times[i] >= 0.0f) || !std::isfinite(times[i]) || (i > 0 && times[i] < times[i - 1]))
            throw InputError(accessor.name() + " holds times that do not ascend from 0");
    }
    return times;
}

std::vector<float> read_values(const Accessor& accessor, Budget& budget) {
    const auto components = static_cast<uint64_t>(accessor.components());
    budget.spend(accessor.count() * components);
    std::vector<float> values;
    values.reserve(accessor.count() * components);
    for (uint64_t i = 0; i < accessor.count(); ++i)
        for (int c = 0; c < accessor.components(); ++c) {
            values.push_back(accessor.read(i, c));
            if (!std::isfinite(values.back()))
                throw InputError(accessor.name() + " holds a value that is not finite");
        }
    return values;
}

uint32_t find_width(const Track& track, const Accessor& values) {
    const uint64_t parts = track.interpolation == Interpolation::cubic ? 3 : 1;
    const uint64_t keys = track.times.size() * parts;
    uint64_t width = track.property == Property::rotation ? 4 : 3;
    if (track.property == Property::weights) width = values.count() / keys;
    const bool scalars = track.property == Property::weights;
    const uint64_t expected = scalars ? width * keys : keys;
    if (width == 0 || values.count() != expected
        || static_cast<uint64_t>(values.components()) != (scalars ? 1 : width))
        throw InputError(values.name() + " does not hold a value for every key");
    return static_cast<uint32_t>(width);
}

// Exporters write keys for things that stand still, too.
bool holds_rest(const Track& track, const tinygltf::Node& node) {
    std::vector<double> rest = track.property == Property::translation ? node.translation
                               : track.property == Property::rotation  ? node.rotation
                                                                       : node.scale;
    if (track.property == Property::weights || track.interpolation == Interpolation::cubic)
        return false;
    if (rest.size() != track.width)
        rest = track.property == Property::rotation ? std::vector<double>{0.0, 0.0, 0.0, 1.0}
               : track.property == Property::scale  ? std::vector<double>(3, 1.0)
                                                    : std::vector<double>(3, 0.0);
    for (size_t i = 0; i < track.values.size(); ++i)
        if (track.values[i] != static_cast<float>(rest[i % track.width])) return false;
    return true;
}

class ClipReader {
public:
    ClipReader(const tinygltf::Model& model, Accessors& accessors, Budget& budget, Notes& notes)
        : model_(model), accessors_(accessors), budget_(budget), notes_(notes) {}

    Clip read(const tinygltf::Animation& animation) {
        Clip clip;
        clip.name = animation.name;
        for (const tinygltf::AnimationChannel& channel : animation.channels)
            add_channel(animation, channel, clip);
        return clip;
    }

private:
    void add_channel(const tinygltf::Animation& animation,
                     const tinygltf::AnimationChannel& channel, Clip& clip) {
        budget_.spend(0);
        try {
            Track track = read_track(animation, channel);
            if (!driven_.insert({track.node, track.property}).second) {
                notes_.add("several animations drive the same node: the first one does "
                           "(--animation chooses)");
                return;
            }
            clip.duration = std::max(clip.duration, static_cast<double>(track.times.back()));
            if (!holds_rest(track, model_.nodes[track.node]))
                clip.tracks.push_back(std::move(track));
        } catch (const InputError& error) {
            notes_.add("a part of the animation \"" + animation.name.substr(0, 80)
                       + "\" is left out: " + error.what());
        }
    }

    Track read_track(const tinygltf::Animation& animation,
                     const tinygltf::AnimationChannel& channel) {
        const auto property = to_property(channel.target_path);
        if (!property || channel.target_node < 0)
            throw InputError("it drives no node's translation, rotation, scale or weights");
        if (static_cast<size_t>(channel.target_node) >= model_.nodes.size())
            throw InputError("node " + std::to_string(channel.target_node)
                             + " is named but does not exist");
        if (channel.sampler < 0
            || static_cast<size_t>(channel.sampler) >= animation.samplers.size())
            throw InputError("its sampler does not exist");
        const auto& sampler = animation.samplers[static_cast<size_t>(channel.sampler)];
        Track track;
        track.node = static_cast<uint32_t>(channel.target_node);
        track.property = *property;
        if (*property != Property::weights && !model_.nodes[track.node].matrix.empty())
            throw InputError("node " + std::to_string(track.node) + " has a matrix");
        track.interpolation = to_interpolation(sampler.interpolation);
        track.times = read_times(accessors_.open(sampler.input), budget_);
        const Accessor& values = accessors_.open(sampler.output);
        track.width = find_width(track, values);
        track.values = read_values(values, budget_);
        return track;
    }

    const tinygltf::Model& model_;
    Accessors& accessors_;
    Budget& budget_;
    Notes& notes_;
    std::set<std::pair<uint32_t, Property>> driven_;
};

size_t find_clip(const std::vector<tinygltf::Animation>& animations, const std::string& choice) {
    for (size_t i = 0; i < animations.size(); ++i)
        if (animations[i].name == choice) return i;
    size_t index = 0;
    const char* last = choice.data() + choice.size();
    const auto [end, error] = std::from_chars(choice.data(), last, index);
    if (error == std::errc() && end == last && index < animations.size()) return index;
    std::string names;
    for (size_t i = 0; i < std::min<size_t>(animations.size(), 20); ++i)
        names +=
            (i == 0 ? ": " : ", ") + std::to_string(i) + " " + animations[i].name.substr(0, 80);
    throw InputError("it has no animation \"" + choice + "\"; it has "
                     + std::to_string(animations.size()) + names);
}

} // namespace

std::vector<Clip> import_clips(const tinygltf::Model& model, const std::string& choice,
                               Accessors& accessors, Budget& budget, Notes& notes) {
    std::vector<Clip> clips;
    if (choice == "none") return clips;
    const size_t chosen = choice.empty() ? 0 : find_clip(model.animations, choice);
    ClipReader reader(model, accessors, budget, notes);
    for (size_t i = 0; i < model.animations.size(); ++i)
        if (choice.empty() || i == chosen) clips.push_back(reader.read(model.animations[i]));
    std::erase_if(clips, [](const Clip& clip) { return clip.tracks.empty(); });
    return clips;
}

} // namespace host::gltf
