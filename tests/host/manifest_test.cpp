#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "error.h"
#include "manifest.h"
#include "plugin.h"

// The file beside a plugin that says what it is.
namespace host::test {
namespace {

namespace fs = std::filesystem;

class ManifestTest : public testing::Test {
protected:
    ManifestTest()
        : folder(fs::temp_directory_path() / ("peregrine_manifest_" + std::to_string(getpid()))) {
        fs::create_directories(folder);
    }
    ~ManifestTest() override { fs::remove_all(folder); }

    std::string write(const std::string& text) const {
        const fs::path path = folder / manifest_name;
        std::ofstream(path) << text;
        return path.string();
    }
    std::string cause_of(const std::string& text) const {
        try {
            const Plugin plugin(write(text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    static std::string manifest(const std::string& library, const std::string& version = "1",
                                const std::string& entry = "rt_get_api") {
        return R"({"name": "Peregrine", "library": ")" + library + R"(", "api_version": )" + version
               + R"(, "entry": ")" + entry + "\"}";
    }
    void expect_cause(const std::string& text, const char* words) const {
        EXPECT_NE(cause_of(text).find(words), std::string::npos) << text << ": " << cause_of(text);
    }

    fs::path folder;
};

TEST_F(ManifestTest, NamesALibraryBesideIt) {
    fs::copy_file(FAKE_ENGINE, folder / "engine.so");
    const Plugin plugin(write(manifest("engine.so")));
    EXPECT_EQ(plugin.api().version, RT_API_VERSION);
    EXPECT_EQ(plugin.path(), (folder / "engine.so").string());
}

TEST_F(ManifestTest, OrOneThatIsElsewhere) {
    EXPECT_EQ(cause_of(manifest(FAKE_ENGINE)), "");
}

TEST_F(ManifestTest, SaysWhatToDo) {
    expect_cause("", "is no JSON object");
    expect_cause("[1]", "is no JSON object");
    expect_cause("{}", "needs a text \"name\"");
    expect_cause(R"({"name": "a", "library": 3})", "needs a text \"library\"");
    expect_cause(R"({"name": "a", "library": "b", "api_version": "1"})",
                 "needs a whole number \"api_version\"");
    expect_cause(R"({"name": "a", "library": "b", "api_version": -1})",
                 "needs a whole number \"api_version\"");
    expect_cause(R"({"name": "a", "library": "b", "api_version": 1})", "needs a text \"entry\"");
    expect_cause(manifest(FAKE_ENGINE, "2"), "install the plugin that was made for it");
    expect_cause(manifest("gone.so"), "put it there or correct");
    expect_cause(manifest(FOREIGN_LIBRARY), "does not export rt_get_api");
    expect_cause(manifest(MUTE_ENGINE), "does not speak version");
    expect_cause(manifest(FAKE_ENGINE, "1", "start_here"), "does not export start_here");
    EXPECT_THROW(read_manifest(folder / "none.json"), InputError);
}

} // namespace
} // namespace host::test
