#include "ui/menu.h"

#include <gtest/gtest.h>

using namespace host::ui;
using Kind = Choice::Kind;

namespace {

const std::vector<Entry> entries = {{.label = "Play"},
                                    {.label = "Sold out", .enabled = false},
                                    {.label = "Size", .value = "Big"},
                                    {.label = "Quit"}};

std::vector<EntryBoxes> boxes() {
    std::vector<EntryBoxes> all;
    for (int i = 0; i < 4; ++i) {
        const float top = 10.0f * static_cast<float>(i);
        all.push_back({{{0, top}, {100, top + 10}},
                       {{60, top}, {80, top + 10}},
                       {{80, top}, {100, top + 10}}});
    }
    return all;
}

Pointer at(float x, float y, bool pressed = false) {
    return {{x, y}, true, pressed, pressed, true};
}

TEST(Menu, KeysGoRoundAndSkipWhatIsDisabled) {
    Menu menu;
    const auto press = [&](const MenuInput& input) { return menu.update(entries, {}, input, {}); };
    EXPECT_TRUE(press({.down = true}).moved);
    EXPECT_EQ(menu.selected(), 2u);
    press({.down = true});
    press({.down = true});
    EXPECT_EQ(menu.selected(), 0u);
    press({.up = true});
    EXPECT_EQ(menu.selected(), 3u);
    press({.up = true});
    EXPECT_EQ(menu.selected(), 2u);
    EXPECT_FALSE(press({.up = true, .down = true}).moved);
    EXPECT_EQ(press({.left = true}).kind, Kind::less);
    EXPECT_EQ(press({.right = true}).kind, Kind::more);
    EXPECT_EQ(press({.accept = true}).kind, Kind::accept);
    EXPECT_EQ(press({.accept = true, .back = true}).kind, Kind::back);
    EXPECT_EQ(press({}).kind, Kind::none);
    press({.up = true});
    EXPECT_EQ(press({.left = true}).kind, Kind::none) << "a plain entry has no value to change";
}

TEST(Menu, ValuesEndWhereTheySaySo) {
    Menu menu;
    const std::vector<Entry> ended = {
        {.label = "Volume", .value = "0", .has_less = false, .has_more = false}};
    EXPECT_EQ(menu.update(ended, {}, {.left = true}, {}).kind, Kind::none);
    EXPECT_EQ(menu.update(ended, {}, {.right = true}, {}).kind, Kind::none);
}

TEST(Menu, TheMouseSelectsAndClicks) {
    Menu menu;
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(50, 35)).entry, 3u);
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(50, 5, true)).kind, Kind::accept);
    EXPECT_EQ(menu.selected(), 0u);
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(50, 15, true)).kind, Kind::none) << "disabled";
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(70, 25, true)).kind, Kind::less);
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(90, 25, true)).kind, Kind::more);
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(30, 25, true)).kind, Kind::none);
    EXPECT_EQ(menu.update(entries, boxes(), {}, at(500, 25, true)).kind, Kind::none);
}

//   [ Size   less |--slider--| more ]
TEST(Menu, ASliderIsDragged) {
    Menu menu;
    const std::vector<Entry> volume = {{.label = "Play"},
                                       {.label = "Volume", .value = "50 %", .level = 0.5f}};
    auto places = boxes();
    places.resize(2);
    places[1].slider = {{65, 10}, {95, 20}};
    const auto mouse = [&](float x, float y, bool pressed, bool held) {
        return menu.update(volume, places, {}, {{x, y}, true, pressed, held, true});
    };
    Choice choice = mouse(74, 15, true, true);
    EXPECT_EQ(choice.kind, Kind::set);
    EXPECT_EQ(choice.entry, 1u);
    EXPECT_FLOAT_EQ(choice.level, 0.3f);
    EXPECT_FALSE(choice.dragged);
    choice = mouse(80, 15, false, true);
    EXPECT_EQ(choice.kind, Kind::set);
    EXPECT_FLOAT_EQ(choice.level, 0.5f);
    EXPECT_TRUE(choice.dragged);
    choice = mouse(300, 2, false, true); // off the row, over another one
    EXPECT_EQ(choice.entry, 1u);
    EXPECT_EQ(choice.level, 1.0f);
    EXPECT_EQ(mouse(-50, 2, false, true).level, 0.0f);
    EXPECT_EQ(mouse(80, 15, false, false).kind, Kind::none); // let go
    EXPECT_EQ(mouse(80, 15, false, true).kind, Kind::none);
    EXPECT_EQ(mouse(62, 15, true, true).kind, Kind::less) << "the arrow before it";
    EXPECT_EQ(mouse(98, 15, true, true).kind, Kind::more);
    EXPECT_EQ(mouse(98, 15, false, true).kind, Kind::none) << "an arrow is not dragged";
}

TEST(Menu, AMouseAtRestLeavesTheKeysAlone) {
    Menu menu;
    Pointer resting = at(50, 35);
    resting.moved = false;
    menu.update(entries, boxes(), {.down = true}, resting);
    EXPECT_EQ(menu.selected(), 2u);
}

TEST(Menu, ASelectionThatIsGoneMovesToTheFirst) {
    Menu menu;
    menu.select(1);
    EXPECT_EQ(menu.update(entries, {}, {}, {}).entry, 0u);
    menu.select(99);
    EXPECT_EQ(menu.update(entries, {}, {}, {}).entry, 0u);
    EXPECT_EQ(menu.update({}, {}, {.accept = true}, {}).kind, Kind::none);
}

TEST(Repeater, HeldDirectionsRepeatAndButtonsDoNot) {
    Repeater repeater;
    const MenuInput held{.down = true, .accept = true};
    int downs = 0, accepts = 0;
    for (int i = 0; i < 100; ++i) { // a second
        const MenuInput pressed = repeater.update(held, 0.01);
        downs += pressed.down;
        accepts += pressed.accept;
        ASSERT_TRUE(i >= 39 || downs == 1) << "the pause is too short";
    }
    EXPECT_EQ(accepts, 1);
    EXPECT_GE(downs, 6);
    EXPECT_LE(downs, 9);
}

TEST(Repeater, LettingGoOfOneOfTwoIsNoPress) {
    Repeater repeater;
    repeater.update({.up = true, .left = true}, 0.01);
    const MenuInput pressed = repeater.update({.up = true}, 0.01);
    EXPECT_FALSE(pressed.up || pressed.left);
    repeater.update({}, 0.01);
    EXPECT_TRUE(repeater.update({.up = true}, 0.01).up);
}

} // namespace
