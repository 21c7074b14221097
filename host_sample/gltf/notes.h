#pragma once

#include <set>
#include <string>
#include <vector>

namespace host::gltf {

// Collects each remark once.
class Notes {
public:
    void add(const std::string& sentence) {
        if (sentences_.size() < max_sentences && known_.insert(sentence).second)
            sentences_.push_back(sentence);
    }

    std::vector<std::string> take() { return std::move(sentences_); }

private:
    static constexpr size_t max_sentences = 64;
    std::set<std::string> known_;
    std::vector<std::string> sentences_;
};

} // namespace host::gltf
