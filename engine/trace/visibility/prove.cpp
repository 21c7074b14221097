#include "trace/visibility/prove.h"

#include <algorithm>
#include <optional>

namespace peregrine::trace::visibility {
namespace {

// What may be in the way: a node of the tree, or one of its triangles.
struct Candidate {
    static constexpr uint32_t kTriangle = 0x80000000u;
    uint32_t bits;

    static Candidate node(uint32_t index) { return {index}; }
    static Candidate triangle(uint32_t index) { return {index | kTriangle}; }
    bool is_triangle() const { return (bits & kTriangle) != 0; }
    uint32_t index() const { return bits & ~kTriangle; }
};

// A part of the list that candidates are pushed to. Lists of parts of a receiver begin where that
// of the whole ends, and are forgotten after it.
struct List {
    uint32_t begin, end;
    uint32_t size() const { return end - begin; }
};

double half_perimeter(const math::Box& box) {
    const Vec3d size = Vec3d(box.upper) - Vec3d(box.lower);
    return size.x + size.y + size.z;
}

} // namespace

class Prover {
public:
    Prover(const TriangleTree& tree, const Setting& setting, const ProofOptions& options,
           base::Memory* memory)
        : tree_(tree), setting_(setting), options_(options), candidates_(memory), stays_(memory),
          out_(std::allocate_shared<PointVisibility>(
              std::pmr::polymorphic_allocator<PointVisibility>(memory),
              uint32_t(tree.triangles.size()), memory)) {
        if (tree_.nodes.empty()) return;
        candidates_.push_back(Candidate::node(0));
        enter(0, {0, 1});
    }

    bool step();
    const ProofReport& report() const { return report_; }
    std::shared_ptr<const PointVisibility> result() const { return out_; }

private:
    // The tree halves its triangles, of which there are less than 2^32, and a node on the way down
    // leaves one behind.
    static constexpr uint32_t kMaxDepth = 34;
    // Lists of more than this are not looked through triangle by triangle: quarters have shorter
    // ones.
    static constexpr uint32_t kLong = 24;
    // More than this in the way of a whole triangle do not just touch it at its border.
    static constexpr uint32_t kTouching = 8;

    struct Patch {
        uint32_t level, iu, iv, upper;
    };

    // A node of receivers on the way down: what its children may have in the way, and which of
    // them comes next.
    struct Stay {
        uint32_t node;
        List met;
        uint32_t next;
    };

    void enter(uint32_t node_index, List list);
    template <class AnyShaft>
    List meet(const AnyShaft& shaft, double size, List list);
    template <class AnyShaft, class Visit>
    void descend(const AnyShaft& shaft, uint32_t start, Visit&& visit) const;
    void prove_triangle(const TreeTriangle& triangle, List list);
    State prove_whole(const Receiver& receiver, float border, List list, List& left);
    bool is_within_reach(const math::Box& box) const;

    State prove_patch(const Shaft& shaft, double longest, List list, List& left);
    void prove_quarters(const Receiver& receiver, const Patch& patch, List list);
    void corners_of(const Receiver& receiver, float border, const Patch& patch,
                    Vec3d (&corners)[3]) const;
    void fill(const Patch& patch, State state);

    void forget(uint32_t end) { candidates_.resize(end, Candidate{0}); }
    uint32_t top() const { return uint32_t(candidates_.size()); }

    const TriangleTree& tree_;
    const Setting setting_;
    const ProofOptions options_;
    base::Vector<Candidate> candidates_;
    base::Vector<Stay> stays_;
    std::shared_ptr<PointVisibility> out_;
    ProofReport report_;
    std::optional<uint32_t> last_cover_; // what hid the patch before
    // Of the triangle that is being cut into patches:
    uint32_t level_ = 0, first_word_ = 0, border_ = 1;
};

bool Prover::is_within_reach(const math::Box& box) const {
    if (setting_.lamp.is_far) return true;
    const Vec3d nearest = glm::clamp(setting_.position, Vec3d(box.lower), Vec3d(box.upper));
    const Vec3d offset = setting_.position - nearest;
    const double reach = double(setting_.lamp.reach) * (1 + 0x1p-16) + 4 * setting_.lift;
    return glm::dot(offset, offset) <= reach * reach;
}

// The list's candidates that the shaft meets. Nodes are opened down to those of the size; triangles
// are judged later.
template <class AnyShaft>
List Prover::meet(const AnyShaft& shaft, double size, List list) {
    const uint32_t begin = top();
    for (uint32_t i = list.begin; i < list.end; ++i) {
        const Candidate candidate = candidates_[i];
        if (candidate.is_triangle()) {
            candidates_.push_back(candidate);
            continue;
        }
        descend(shaft, candidate.index(), [&](uint32_t index, const TriangleNode& node) {
            const bool is_small = node.is_leaf() || half_perimeter(node.box) <= size;
            if (is_small) candidates_.push_back(Candidate::node(index));
            return !is_small;
        });
    }
    return {begin, top()};
}

// Calls visit(index, node) for the nodes from `start` down that the shaft meets, as long as it
// returns true for those above.
template <class AnyShaft, class Visit>
void Prover::descend(const AnyShaft& shaft, uint32_t start, Visit&& visit) const {
    uint32_t pending[kMaxDepth];
    uint32_t depth = 0;
    pending[depth++] = start;
    while (depth > 0) {
        const uint32_t index = pending[--depth];
        const TriangleNode& node = tree_.nodes[index];
        if (!shaft.meets(node.box) || !visit(index, node)) continue;
        pending[depth++] = node.first + 1;
        pending[depth++] = node.first;
    }
}

void Prover::enter(uint32_t node_index, List list) {
    const TriangleNode& node = tree_.nodes[node_index];
    if (!is_within_reach(node.box)) return;
    const List met = meet(BoxShaft(setting_, node.box), half_perimeter(node.box), list);
    if (!node.is_leaf()) return stays_.push_back({node_index, met, 0});
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
        prove_triangle(tree_.ordered[i], met);
    forget(met.begin);
}

bool Prover::step() {
    if (stays_.empty()) return false;
    Stay& stay = stays_.back();
    if (stay.next == 2) {
        forget(stay.met.begin);
        stays_.pop_back();
    } else {
        const uint32_t child = tree_.nodes[stay.node].first + stay.next++;
        enter(child, List(stay.met)); // which may move `stay`
    }
    return !stays_.empty();
}

State Prover::prove_patch(const Shaft& shaft, double longest, List list, List& left) {
    ++report_.proofs;
    if (shaft.is_out_of_reach()) {
        left = {top(), top()};
        return State::hidden;
    }
    if (last_cover_ && shaft.judge(tree_.ordered[*last_cover_]) == Shaft::Verdict::covers) {
        left = {top(), top()};
        return State::hidden;
    }
    left = meet(shaft, longest, list);
    if (left.size() > kLong && longest > double(options_.patch_size)) return State::mixed;

    // Triangle by triangle.
    const uint32_t begin = top();
    bool is_hidden = false;
    const auto judge = [&](uint32_t triangle) {
        const Shaft::Verdict verdict = shaft.judge(tree_.ordered[triangle]);
        if (verdict != Shaft::Verdict::apart) candidates_.push_back(Candidate::triangle(triangle));
        is_hidden = verdict == Shaft::Verdict::covers;
        if (is_hidden) last_cover_ = triangle;
    };
    for (uint32_t i = left.begin; i < left.end && !is_hidden; ++i) {
        const Candidate candidate = candidates_[i];
        if (candidate.is_triangle()) {
            judge(candidate.index());
            continue;
        }
        descend(shaft, candidate.index(), [&](uint32_t, const TriangleNode& node) {
            if (!node.is_leaf()) return !is_hidden;
            for (uint32_t j = node.first; j < node.first + node.count && !is_hidden; ++j) judge(j);
            return false;
        });
    }
    if (is_hidden) return State::hidden;
    left = {begin, top()};
    return left.size() == 0 ? State::lit : State::mixed;
}

void Prover::corners_of(const Receiver& receiver, float border, const Patch& patch,
                        Vec3d (&corners)[3]) const {
    const double step = 1.0 / double(1u << patch.level);
    const double iu = double(patch.iu), iv = double(patch.iv);
    const double places[2][3][2] = {{{iu, iv}, {iu + 1, iv}, {iu, iv + 1}},
                                    {{iu + 1, iv + 1}, {iu, iv + 1}, {iu + 1, iv}}};
    const double inner = 1 - 3 * double(border);
    for (int k = 0; k < 3; ++k) {
        const double u = double(border) + inner * places[patch.upper][k][0] * step;
        const double v = double(border) + inner * places[patch.upper][k][1] * step;
        corners[k] = receiver.v[0] * (1 - u - v) + receiver.v[1] * u + receiver.v[2] * v;
    }
}

State Prover::prove_whole(const Receiver& receiver, float border, List list, List& left) {
    Vec3d corners[3];
    corners_of(receiver, border, {0, 0, 0, 0}, corners);
    return prove_patch(Shaft(setting_, receiver, corners), receiver.longest, list, left);
}

void Prover::fill(const Patch& patch, State state) {
    if (patch.level == level_) {
        const uint32_t index = Grid::index(1u << level_, patch.iu, patch.iv, patch.upper);
        out_->words()[first_word_ + index / 16] |= uint32_t(state) << index % 16 * 2;
        return;
    }
    const uint32_t u = 2 * patch.iu, v = 2 * patch.iv, level = patch.level + 1;
    if (patch.upper) {
        fill({level, u + 1, v + 1, 1}, state);
        fill({level, u, v + 1, 1}, state);
        fill({level, u + 1, v, 1}, state);
        fill({level, u + 1, v + 1, 0}, state);
    } else {
        fill({level, u, v, 0}, state);
        fill({level, u + 1, v, 0}, state);
        fill({level, u, v + 1, 0}, state);
        fill({level, u, v, 1}, state);
    }
}

// Of a mixed patch.
void Prover::prove_quarters(const Receiver& receiver, const Patch& patch, List list) {
    const uint32_t u = 2 * patch.iu, v = 2 * patch.iv, level = patch.level + 1;
    const Patch lower[4] = {
        {level, u, v, 0}, {level, u + 1, v, 0}, {level, u, v + 1, 0}, {level, u, v, 1}};
    const Patch upper[4] = {{level, u + 1, v + 1, 1},
                            {level, u, v + 1, 1},
                            {level, u + 1, v, 1},
                            {level, u + 1, v + 1, 0}};
    const double longest = receiver.longest / double(1u << level);
    for (const Patch& quarter : patch.upper ? upper : lower) {
        Vec3d corners[3];
        corners_of(receiver, Grid::kBorder[border_], quarter, corners);
        const uint32_t end = top();
        List left;
        const State state = prove_patch(Shaft(setting_, receiver, corners), longest, list, left);
        if (state == State::mixed && level < level_)
            prove_quarters(receiver, quarter, left);
        else
            fill(quarter, state);
        forget(end);
    }
}

void Prover::prove_triangle(const TreeTriangle& triangle, List list) {
    const Corners& corners = tree_.triangles[triangle.index];
    const math::Box box = {glm::min(glm::min(corners.v[0], corners.v[1]), corners.v[2]),
                           glm::max(glm::max(corners.v[0], corners.v[1]), corners.v[2])};
    if (!is_within_reach(box)) return;
    const Receiver receiver = make_receiver(setting_, corners, triangle);
    const uint32_t end = top();
    State state = State::mixed;
    uint32_t border = 0;
    if (!receiver.is_seen) {
        state = State::hidden;
    } else if (receiver.is_usable) {
        uint32_t level = 0;
        while (level < Grid::kMaxLevel
               && receiver.longest > double(options_.patch_size) * double(1u << level))
            ++level;
        List left;
        state = prove_whole(receiver, 0, list, left);
        while (state == State::mixed && left.size() <= kTouching
               && border < (level > 0 ? 1u : 2u)) {
            list = left;
            state = prove_whole(receiver, Grid::kBorder[++border], list, left);
        }
        const uint32_t words = ((1u << 2 * level) + 15) / 16;
        if (state == State::mixed && level > 0
            && out_->words().size() + words <= options_.most_words) {
            level_ = level;
            border_ = 1;
            first_word_ = uint32_t(out_->words().size());
            out_->words().resize(first_word_ + words, 0);
            prove_quarters(receiver, {0, 0, 0, 0}, left);
            out_->set(triangle.index, TriangleView(State::patches, border_, level_, first_word_));
            state = State::patches;
        }
    }
    forget(end);
    ++report_.triangles[uint32_t(state)];
    if (state == State::mixed) out_->set(triangle.index, TriangleView(State::mixed, 0));
    if (state == State::lit || (state == State::hidden && border > 0))
        out_->set(triangle.index, TriangleView(state, border));
}

LampProof::LampProof(const TriangleTree& tree, const Setting& setting, const ProofOptions& options,
                     base::Memory* memory)
    : prover_(std::allocate_shared<Prover>(std::pmr::polymorphic_allocator<Prover>(memory), tree,
                                           setting, options, memory)) {}

bool LampProof::step() {
    return prover_->step();
}
const ProofReport& LampProof::report() const {
    return prover_->report();
}
std::shared_ptr<const PointVisibility> LampProof::result() const {
    return prover_->result();
}

std::shared_ptr<const PointVisibility> prove(const TriangleTree& tree, const Setting& setting,
                                             const ProofOptions& options, base::Memory* memory,
                                             ProofReport& report) {
    LampProof proof(tree, setting, options, memory);
    while (proof.step()) {
    }
    report = proof.report();
    return proof.result();
}

} // namespace peregrine::trace::visibility
