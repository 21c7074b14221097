#include "descriptor.h"

#include <algorithm>

namespace host::pads {

namespace {

constexpr size_t most_bytes = 4096; // as much as Linux takes
constexpr size_t deepest = 16, most_fields = 1024, most_usages = 1024;
constexpr uint32_t most_bits = 8 * 4096; // of a report

// A value as it is written and as a two's complement number: which one is meant depends on other
// items.
struct Value {
    uint32_t raw = 0;
    int32_t with_sign = 0;
};

struct Globals {
    uint16_t page = 0;
    Value lowest, highest;
    uint32_t size = 0, count = 0;
    uint8_t report = 0;
};

enum Kind : uint8_t { main_item = 0, global_item = 1, local_item = 2 };

class Parser {
public:
    explicit Parser(Bytes bytes) : bytes_(bytes) {}

    std::optional<ReportDescriptor> parse() {
        if (bytes_.empty() || bytes_.size() > most_bytes) return std::nullopt;
        size_t at = 0;
        while (at < bytes_.size())
            if (!item(at)) return std::nullopt;
        if (result_.applications.empty()) return std::nullopt;
        return std::move(result_);
    }

private:
    bool item(size_t& at) {
        const uint8_t prefix = bytes_[at];
        if (prefix == 0xfe) { // a long item; nobody defined any
            if (at + 2 >= bytes_.size()) return false;
            at += size_t{3} + bytes_[at + 1];
            return at <= bytes_.size();
        }
        const size_t size = (prefix & 3) == 3 ? 4 : prefix & 3;
        if (size > bytes_.size() - at - 1) return false;
        const Value value = read_value(at + 1, size);
        at += 1 + size;
        const uint8_t tag = prefix >> 4;
        switch (prefix >> 2 & 3) {
        case main_item:
            return main(tag, value.raw);
        case global_item:
            return global(tag, value);
        case local_item:
            return local(tag, value.raw, size);
        default:
            return true;
        }
    }

    Value read_value(size_t at, size_t size) const {
        uint32_t raw = 0;
        for (size_t i = 0; i < size; ++i) raw |= static_cast<uint32_t>(bytes_[at + i]) << 8 * i;
        switch (size) {
        case 1:
            return {raw, static_cast<int8_t>(raw)};
        case 2:
            return {raw, static_cast<int16_t>(raw)};
        default:
            return {raw, static_cast<int32_t>(raw)};
        }
    }

    bool main(uint8_t tag, uint32_t flags) {
        bool fine = true;
        switch (tag) {
        case 0x8:
            fine = input(flags);
            break;
        case 0x9:
            result_.output_ids.set(globals_.report);
            break;
        case 0xa:
            fine = open_collection(flags);
            break;
        case 0xc:
            fine = depth_-- > 0;
            break;
        default:
            break;
        }
        usages_.clear();
        first_usage_.reset();
        in_delimiter_ = false;
        return fine;
    }

    bool open_collection(uint32_t type) {
        if (++depth_ > deepest) return false;
        const bool application = type == 0x01;
        if (application && !usages_.empty() && result_.applications.size() < most_usages)
            result_.applications.push_back(named(usages_.front()));
        return true;
    }

    bool global(uint8_t tag, Value value) {
        switch (tag) {
        case 0x0:
            globals_.page = static_cast<uint16_t>(value.raw);
            return value.raw <= 0xffff;
        case 0x1:
            globals_.lowest = value;
            return true;
        case 0x2:
            globals_.highest = value;
            return true;
        case 0x7:
            globals_.size = value.raw;
            return value.raw <= most_bits;
        case 0x8:
            result_.has_ids = true;
            globals_.report = static_cast<uint8_t>(value.raw);
            return value.raw >= 1 && value.raw <= 255;
        case 0x9:
            globals_.count = value.raw;
            return value.raw <= most_bits;
        case 0xa:
            stack_.push_back(globals_);
            return stack_.size() <= deepest;
        case 0xb:
            if (stack_.empty()) return false;
            globals_ = stack_.back();
            stack_.pop_back();
            return true;
        default:
            return true; // physical values and units
        }
    }

    bool local(uint8_t tag, uint32_t value, size_t size) {
        const uint32_t usage = size == 4 ? value : value | page_follows;
        switch (tag) {
        case 0x0:
            return add_usages(usage, usage);
        case 0x1:
            first_usage_ = usage;
            return true;
        case 0x2: {
            const auto first = first_usage_;
            first_usage_.reset();
            return first && add_usages(*first, usage);
        }
        case 0xa: // of a set of alternatives the first counts
            in_delimiter_ = value == 1;
            delimited_ = 0;
            return true;
        default:
            return true;
        }
    }

    // Two bytes alone mean the page that is in force at the main item. The mark is no page.
    static constexpr uint32_t page_follows = 0xffff0000u;

    bool add_usages(uint32_t first, uint32_t last) {
        if (in_delimiter_ && delimited_++ > 0) return true;
        if (last < first || last - first >= most_usages) return false;
        for (uint32_t usage = first;; ++usage) {
            if (usages_.size() >= most_usages) return false;
            usages_.push_back(usage);
            if (usage == last) return true;
        }
    }

    Usage named(uint32_t usage) const {
        const auto page = static_cast<uint16_t>(usage >> 16);
        return {page == page_follows >> 16 ? globals_.page : page, static_cast<uint16_t>(usage)};
    }

    bool input(uint32_t flags) {
        uint32_t& end = result_.input_bits[globals_.report];
        const uint32_t start = end;
        const uint64_t total = uint64_t{globals_.size} * globals_.count;
        if (total > most_bits - start) return false;
        end += static_cast<uint32_t>(total);
        const bool constant = (flags & 1) != 0, relative = (flags & 4) != 0;
        if (constant || relative || usages_.empty()) return true;
        if (globals_.size == 0 || globals_.size > 32) return true;
        return add_fields(start, (flags & 2) == 0);
    }

    bool add_fields(uint32_t start, bool array) {
        InputField field;
        field.report = globals_.report;
        field.bits = static_cast<uint8_t>(globals_.size);
        field.array = array;
        field.lowest = globals_.lowest.with_sign;
        field.highest =
            field.lowest < 0 ? int64_t{globals_.highest.with_sign} : int64_t{globals_.highest.raw};
        if (field.highest < field.lowest) return true; // means nothing: no field
        if (array) field.usages = consecutive();
        // Values without a usage of their own repeat the last one and tell nothing new.
        const size_t count =
            array ? globals_.count : std::min<size_t>(globals_.count, usages_.size());
        for (size_t i = 0; i < count; ++i) {
            if (result_.inputs.size() >= most_fields) return false;
            field.bit = start + static_cast<uint32_t>(i) * globals_.size;
            field.usage = named(usages_[array ? 0 : i]);
            result_.inputs.push_back(field);
        }
        return true;
    }

    uint16_t consecutive() const {
        uint16_t count = 1;
        while (count < usages_.size() && usages_[count] == usages_[count - 1] + 1) ++count;
        return count;
    }

    Bytes bytes_;
    ReportDescriptor result_;
    Globals globals_;
    std::vector<Globals> stack_;
    std::vector<uint32_t> usages_; // of the next main item
    std::optional<uint32_t> first_usage_;
    bool in_delimiter_ = false;
    size_t delimited_ = 0;
    size_t depth_ = 0;
};

} // namespace

std::optional<int64_t> InputField::read(Bytes payload) const {
    uint64_t value = 0;
    for (uint32_t i = 0; i < bits; ++i) {
        const uint32_t at = bit + i;
        value |= static_cast<uint64_t>(payload[at / 8] >> at % 8 & 1) << i;
    }
    auto number = static_cast<int64_t>(value);
    if (lowest < 0 && (value >> (bits - 1) & 1) != 0) number -= int64_t{1} << bits;
    if (number < lowest || number > highest) return std::nullopt;
    return number;
}

bool ReportDescriptor::is(Usage application) const {
    return std::find(applications.begin(), applications.end(), application) != applications.end();
}

const InputField* ReportDescriptor::find(Usage usage) const {
    for (const InputField& field : inputs)
        if (!field.array && field.usage == usage) return &field;
    return nullptr;
}

std::optional<ReportDescriptor> parse_descriptor(Bytes bytes) {
    return Parser(bytes).parse();
}

} // namespace host::pads
