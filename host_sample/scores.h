#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "gameplay/three_cores/rules.h"

namespace host {

namespace three_cores = peregrine::three_cores;

const char* difficulty_name(three_cores::Difficulty difficulty); // "Easy"

// Of the rounds that were won; they need not be of one round.
struct BestResult {
    double seconds = 0.0;
    uint32_t score = 0;

    bool operator==(const BestResult&) const = default;
};

// The best results of every level and difficulty.
class Scores {
public:
    // `note` becomes a sentence for the player if the file was broken; nothing throws.
    static Scores read(const std::filesystem::path& path, std::string& note);

    std::optional<BestResult> best(const std::string& level,
                                   three_cores::Difficulty difficulty) const;

    struct Improved {
        bool time = false, score = false;
    };
    // A round that was won.
    Improved add(const std::string& level, three_cores::Difficulty difficulty,
                 const BestResult& result);

    // Returns a sentence if it cannot be written, else nothing.
    std::string write(const std::filesystem::path& path) const;

private:
    std::map<std::pair<std::string, three_cores::Difficulty>, BestResult> best_;
};

std::filesystem::path scores_path(); // empty: there is no home

} // namespace host
