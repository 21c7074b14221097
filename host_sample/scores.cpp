#include "scores.h"

#include <array>
#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

#include "user_file.h"
#include "user_folders.h"

namespace host {

namespace {

using nlohmann::json;
using three_cores::Difficulty;

constexpr const char* what = "best times";
constexpr std::array<const char*, 3> keys = {"easy", "normal", "hard"};

std::optional<BestResult> parse_result(const json& value) {
    if (!value.is_object()) return {};
    const auto seconds = value.find("seconds"), score = value.find("score");
    if (seconds == value.end() || !seconds->is_number() || score == value.end()
        || !score->is_number_unsigned() || score->get<uint64_t>() > UINT32_MAX)
        return {};
    const BestResult result{seconds->get<double>(), score->get<uint32_t>()};
    if (!std::isfinite(result.seconds) || result.seconds < 0.0) return {};
    return result;
}

} // namespace

const char* difficulty_name(Difficulty difficulty) {
    constexpr std::array<const char*, 3> names = {"Easy", "Normal", "Hard"};
    return names.at(static_cast<size_t>(difficulty));
}

std::filesystem::path scores_path() {
    const auto folder = data_folder();
    return folder.empty() ? folder : folder / "three_cores_scores.json";
}

Scores Scores::read(const std::filesystem::path& path, std::string& note) {
    Scores scores;
    const json content = read_user_file(path, what, note);
    bool skipped = false;
    for (const auto& [level, results] : content.items()) {
        for (size_t i = 0; i < keys.size(); ++i) {
            const auto found = results.is_object() ? results.find(keys[i]) : results.end();
            if (found == results.end()) continue;
            if (const auto result = parse_result(*found))
                scores.best_[{level, static_cast<Difficulty>(i)}] = *result;
            else
                skipped = true;
        }
        skipped = skipped || !results.is_object();
    }
    if (skipped) note = "Some of the best times in " + path.string() + " are damaged and left out.";
    return scores;
}

std::optional<BestResult> Scores::best(const std::string& level, Difficulty difficulty) const {
    const auto found = best_.find({level, difficulty});
    if (found == best_.end()) return {};
    return found->second;
}

Scores::Improved Scores::add(const std::string& level, Difficulty difficulty,
                             const BestResult& result) {
    const auto [place, first] = best_.try_emplace({level, difficulty}, result);
    if (first) return {true, true};
    BestResult& best = place->second;
    const Improved improved{result.seconds<best.seconds, result.score> best.score};
    if (improved.time) best.seconds = result.seconds;
    if (improved.score) best.score = result.score;
    return improved;
}

std::string Scores::write(const std::filesystem::path& path) const {
    json content = json::object();
    for (const auto& [key, result] : best_)
        content[key.first][keys.at(static_cast<size_t>(key.second))] = {{"seconds", result.seconds},
                                                                        {"score", result.score}};
    return write_user_file(path, content, what);
}

} // namespace host
