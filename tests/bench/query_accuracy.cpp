#include "query_accuracy.h"

#include "timing.h"

#include <algorithm>
#include <cmath>

namespace peregrine::bench {
namespace {

// Where a change of the shape by the band moves the contact further than this, it grazes: then any
// answer between the earliest and the latest is as good as another.
constexpr double kGraze = 10 * kBand;

class Judge {
public:
    void count(bool said, Truth truth) {
        missed_ += !said && truth == Truth::yes;
        false_ += said && truth == Truth::no;
        ++judged_;
    }

    // `metres`: the length of a time unit.
    void compare(double t, const Contact& contact, double metres, double graze) {
        const bool said = std::isfinite(t), none = std::isinf(contact.earliest);
        count(said, std::isfinite(contact.latest) ? Truth::yes : none ? Truth::no : Truth::open);
        if (said && !none) add_error(t, contact, metres, graze);
    }

    void compare(const float* t, uint32_t count_of, const std::vector<double>& crossings,
                 double metres) {
        const size_t expected = std::min(crossings.size(), kMaxCrossings);
        missed_ += count_of < expected;
        false_ += count_of > expected;
        ++judged_;
        if (count_of != expected) return;
        for (size_t i = 0; i < expected; ++i)
            errors_.push_back(std::fabs(double(t[i]) - crossings[i]) * metres);
    }

    Accuracy result(double scale) const {
        const double share = judged_ ? 1e6 / double(judged_) : 0;
        const double none = std::numeric_limits<double>::quiet_NaN(), mm = 1e3 / scale;
        return {share * double(missed_), share * double(false_),
                errors_.empty() ? none : mm * median(errors_),
                errors_.empty() ? none : mm * *std::max_element(errors_.begin(), errors_.end()),
                judged_};
    }

private:
    void add_error(double t, const Contact& contact, double metres, double graze) {
        const bool clear = (contact.latest - contact.earliest) * metres <= graze;
        const double error = clear ? std::fabs(t - contact.exact)
                                   : std::max({0.0, contact.earliest - t, t - contact.latest});
        errors_.push_back(error * metres);
    }

    size_t missed_ = 0, false_ = 0, judged_ = 0;
    std::vector<double> errors_; // metres
};

double length(const float* direction) {
    return glm::length(math::Vec3d(direction[0], direction[1], direction[2]));
}

double metres_of(const QuerySet& set, size_t i) {
    if (!set.rays.empty()) return length(set.rays[i].direction);
    return set.sweeps.empty() ? 1 : length(set.sweeps[i].direction);
}

} // namespace

ReferenceAnswers answer_by_reference(const Reference& reference, const QuerySet& set,
                                     size_t count) {
    ReferenceAnswers answers;
    for (size_t i = 0; i < std::min(count, set.size()); ++i) {
        switch (set.kind) {
        case QueryKind::any:
            answers.truths.push_back(reference.judge_sight(set.rays[i]));
            break;
        case QueryKind::closest:
        case QueryKind::stream:
            answers.contacts.push_back(reference.judge_hit(set.rays[i]));
            break;
        case QueryKind::all: {
            std::vector<double>& crossings = answers.crossings.emplace_back();
            const bool certain = reference.judge_crossings(set.rays[i], crossings);
            answers.truths.push_back(certain ? Truth::yes : Truth::open);
            break;
        }
        case QueryKind::sweep:
            answers.contacts.push_back(reference.judge_sweep(set.sweeps[i]));
            break;
        case QueryKind::overlap:
            answers.truths.push_back(reference.judge_overlap(set.shapes[i]));
            break;
        case QueryKind::nearest:
            answers.contacts.push_back(reference.judge_nearest(set.points[i]));
            break;
        }
    }
    return answers;
}

Accuracy judge(const QuerySet& set, const QueryAnswers& answers, const ReferenceAnswers& reference,
               double scale) {
    Judge judge;
    for (size_t i = 0; i < reference.size(); ++i) {
        if (set.kind == QueryKind::any || set.kind == QueryKind::overlap)
            judge.count(answers.yes[i], reference.truths[i]);
        else if (set.kind != QueryKind::all)
            judge.compare(double(answers.t[i]), reference.contacts[i], metres_of(set, i),
                          kGraze * scale);
        else if (reference.truths[i] == Truth::yes)
            judge.compare(&answers.crossings[i * kMaxCrossings], answers.counts[i],
                          reference.crossings[i], metres_of(set, i));
    }
    return judge.result(scale);
}

} // namespace peregrine::bench
