#include "settings.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "user_file.h"
#include "user_folders.h"

namespace host {

namespace {

using nlohmann::json;

constexpr const char* what = "settings";

// Reads the fields of an object and remembers the first that is of a wrong type.
class Fields {
public:
    explicit Fields(const json& object) : object_(object) {}

    void read(const char* name, bool& value) {
        if (const json* field = find(name)) {
            if (field->is_boolean())
                value = field->get<bool>();
            else
                refuse(name);
        }
    }

    void read(const char* name, double& value, double lower, double upper) {
        if (const json* field = find(name)) {
            if (field->is_number())
                value = std::clamp(field->get<double>(), lower, upper);
            else
                refuse(name);
        }
    }

    void read(const char* name, int& value, int lower, int upper) {
        double number = value;
        read(name, number, lower, upper);
        value = static_cast<int>(std::lround(number));
    }

    const std::string& refused() const { return refused_; }

private:
    const json* find(const char* name) const {
        const auto field = object_.find(name);
        return field == object_.end() ? nullptr : &*field;
    }

    void refuse(const char* name) {
        if (refused_.empty()) refused_ = name;
    }

    const json& object_;
    std::string refused_;
};

} // namespace

std::filesystem::path settings_path() {
    const auto folder = config_folder();
    return folder.empty() ? folder : folder / "three_cores.json";
}

PlayerSettings read_settings(const std::filesystem::path& path, std::string& note) {
    const json content = read_user_file(path, what, note);
    PlayerSettings settings;
    Fields fields(content);
    fields.read("width", settings.width, 320, 16384);
    fields.read("height", settings.height, 200, 16384);
    fields.read("fullscreen", settings.fullscreen);
    fields.read("render_scale", settings.render_scale, 0, 100);
    if (settings.render_scale > 0) settings.render_scale = std::max(settings.render_scale, 25);
    fields.read("field_of_view", settings.field_of_view, 45, 90);
    fields.read("sensitivity", settings.sensitivity, 0.2, 3.0);
    fields.read("invert_look", settings.invert_look);
    fields.read("volume", settings.volume, 0, 100);
    fields.read("vibration", settings.vibration);
    int effects = static_cast<int>(settings.effects);
    fields.read("effects", effects, 0, 2);
    settings.effects = static_cast<Effects>(effects);
    int difficulty = static_cast<int>(settings.difficulty);
    fields.read("difficulty", difficulty, 0, 2);
    settings.difficulty = static_cast<three_cores::Difficulty>(difficulty);
    if (!fields.refused().empty())
        note = "The setting \"" + fields.refused() + "\" in " + path.string()
               + " is of a wrong type and starts anew.";
    return settings;
}

std::string write_settings(const std::filesystem::path& path, const PlayerSettings& settings) {
    const json content = {{"width", settings.width},
                          {"height", settings.height},
                          {"fullscreen", settings.fullscreen},
                          {"render_scale", settings.render_scale},
                          {"effects", static_cast<int>(settings.effects)},
                          {"field_of_view", settings.field_of_view},
                          {"sensitivity", settings.sensitivity},
                          {"invert_look", settings.invert_look},
                          {"volume", settings.volume},
                          {"vibration", settings.vibration},
                          {"difficulty", static_cast<int>(settings.difficulty)}};
    return write_user_file(path, content, what);
}

} // namespace host
