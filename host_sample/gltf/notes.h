#pragma once

#include <set>
#include <string>
#include <vector>

namespace host::gltf {

// Collects each remark once.
class Notes {
  public:
    void add(const std::string& sentence) {
        if (m_sentences.size() < max_sentences && m_known.insert(sentence).second)
            m_sentences.push_back(sentence);
    }

    std::vector<std::string> take() { return std::move(m_sentences); }

  private:
    static constexpr size_t max_sentences = 64;
    std::set<std::string> m_known;
    std::vector<std::string> m_sentences;
};

} // namespace host::gltf
