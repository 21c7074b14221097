#pragma once

#include "gameplay/three_cores/plan.h"

#include "../animation/player.h"
#include "../effects/ripples.h"
#include "../options.h"
#include "../plugin.h"
#include "../session.h"
#include "aliases.h"

namespace host::game {

// A level that is ready to be played in: imported, described to the engine and committed.
class Arena {
public:
    // `progress` gets a text and the fraction done. Throws InputError or EngineError.
    using Progress = std::function<void(const char* text, float fraction)>;
    Arena(const Options& options, const Progress& progress);

    Stage& stage() { return stage_; }
    LevelEffects& effects() { return effects_; }
    Ripples& ripples() { return ripples_; }
    const three_cores::Plan& plan() const { return plan_; }
    const rt_commit_desc& commit() const { return commit_; }
    std::string level_name() const; // as players read it

    Session session();

private:
    const Options& options_;
    Level level_;
    Ripples ripples_;
    Plugin plugin_;
    Stage stage_;
    Player player_;
    LevelEffects effects_;
    rt_commit_desc commit_;
    rt_commit_report report_;
    three_cores::Plan plan_;
};

} // namespace host::game
