#include "gameplay/replay.h"

#include "gameplay/state_hash.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>

namespace peregrine::gameplay {
namespace {

constexpr char kMagic[] = {'P', 'R', 'G', 'N', 'R', 'P', 'L', 'Y'};
constexpr uint32_t kVersion = 1;
constexpr uint32_t kMostTicksPerSecond = 1000;
constexpr size_t kHeaderSize = 40, kTickSize = 32, kHashSize = 8;

class Writer {
public:
    template <class T>
    void put(T value) {
        for (size_t i = 0; i < sizeof(T); ++i) bytes.push_back(uint8_t(value >> (8 * i)));
    }
    void put(float value) { put(std::bit_cast<uint32_t>(value)); }

    std::vector<uint8_t> bytes;
};

// Of a span that is known to be long enough.
class Reader {
public:
    explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    template <class T>
    T get() {
        uint64_t value = 0;
        for (size_t i = 0; i < sizeof(T); ++i) value |= uint64_t(bytes_[i]) << (8 * i);
        bytes_ = bytes_.subspan(sizeof(T));
        return T(value);
    }
    float get_float() { return std::bit_cast<float>(get<uint32_t>()); }

private:
    std::span<const uint8_t> bytes_;
};

uint64_t hash_of(std::span<const uint8_t> bytes) {
    StateHash hash;
    for (const uint8_t byte : bytes) hash.add(uint32_t(byte));
    return hash.value();
}

Tick read_tick(Reader& reader, size_t number) {
    Tick tick;
    for (float& x : tick.input.walk) x = reader.get_float();
    for (float& x : tick.input.view) x = reader.get_float();
    tick.input.buttons = reader.get<uint32_t>();
    tick.hash = reader.get<uint64_t>();
    for (const float x : {tick.input.walk[0], tick.input.walk[1], tick.input.view[0],
                          tick.input.view[1], tick.input.view[2]})
        if (!std::isfinite(x))
            throw ReplayError("the input of tick " + std::to_string(number) + " is not finite");
    return tick;
}

// The count of ticks; throws if the bytes are not a whole file of that many.
size_t check_frame(std::span<const uint8_t> bytes) {
    if (bytes.size() < sizeof kMagic
        || !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin()))
        throw ReplayError("this is no replay: it does not begin with PRGNRPLY");
    if (bytes.size() < kHeaderSize + kHashSize)
        throw ReplayError("the replay is cut off within its header: " + std::to_string(bytes.size())
                          + " bytes");
    const uint32_t version = Reader(bytes.subspan(8)).get<uint32_t>();
    if (version != kVersion)
        throw ReplayError("the replay is of version " + std::to_string(version)
                          + "; this program reads version " + std::to_string(kVersion));
    const uint64_t count = Reader(bytes.subspan(32)).get<uint64_t>();
    const size_t body = bytes.size() - kHeaderSize - kHashSize;
    if (body % kTickSize != 0 || count != body / kTickSize)
        throw ReplayError("the replay says that it has " + std::to_string(count)
                          + " ticks, but there is room for " + std::to_string(body / kTickSize)
                          + ": it is cut off, or the count is broken");
    if (Reader(bytes.last(kHashSize)).get<uint64_t>()
        != hash_of(bytes.first(bytes.size() - kHashSize)))
        throw ReplayError("the replay is damaged: its content does not agree with its hash");
    return size_t(count);
}

void check_rate(uint32_t ticks_per_second) {
    if (ticks_per_second < 1 || ticks_per_second > kMostTicksPerSecond)
        throw ReplayError("ticks_per_second is " + std::to_string(ticks_per_second) + "; 1 to "
                          + std::to_string(kMostTicksPerSecond) + " are possible");
}

} // namespace

size_t play(const Replay& replay, const std::function<uint64_t(const TickInput&)>& play_tick) {
    size_t astray = replay.ticks.size();
    for (size_t i = 0; i < replay.ticks.size(); ++i)
        if (play_tick(replay.ticks[i].input) != replay.ticks[i].hash) astray = std::min(astray, i);
    return astray;
}

std::vector<uint8_t> encode_replay(const Replay& replay) {
    check_rate(replay.ticks_per_second);
    Writer writer;
    writer.bytes.reserve(kHeaderSize + kTickSize * replay.ticks.size() + kHashSize);
    writer.bytes.assign(std::begin(kMagic), std::end(kMagic));
    writer.put(kVersion);
    writer.put(replay.ticks_per_second);
    writer.put(replay.seed);
    writer.put(replay.level);
    writer.put(uint64_t(replay.ticks.size()));
    for (const Tick& tick : replay.ticks) {
        for (const float x : tick.input.walk) writer.put(x);
        for (const float x : tick.input.view) writer.put(x);
        writer.put(tick.input.buttons);
        writer.put(tick.hash);
    }
    writer.put(hash_of(writer.bytes));
    return std::move(writer.bytes);
}

Replay decode_replay(std::span<const uint8_t> bytes) {
    const size_t count = check_frame(bytes);
    Reader reader(bytes.subspan(sizeof kMagic + sizeof kVersion));
    Replay replay;
    replay.ticks_per_second = reader.get<uint32_t>();
    check_rate(replay.ticks_per_second);
    replay.seed = reader.get<uint64_t>();
    replay.level = reader.get<uint64_t>();
    reader.get<uint64_t>(); // the count, which is known
    replay.ticks.reserve(count);
    for (size_t i = 0; i < count; ++i) replay.ticks.push_back(read_tick(reader, i));
    return replay;
}

void save_replay(const Replay& replay, const std::string& path) {
    const std::vector<uint8_t> bytes = encode_replay(replay);
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    file.close();
    if (!file) throw ReplayError("cannot write " + path);
}

Replay load_replay(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw ReplayError("cannot open " + path);
    const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    if (file.bad()) throw ReplayError("cannot read " + path);
    return decode_replay(bytes);
}

} // namespace peregrine::gameplay
