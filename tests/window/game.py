#!/usr/bin/env python3
"""Plays a minute of the game in a window on a virtual display, by synthetic keys.

Passes if the title, the round, the grenade's arc, the pause and the options can each be seen to
come and go, if walking changes the picture and pausing stops it, if a screenshot and a record of
the round are written, and if the record played again goes the same way.
"""

import argparse
import pathlib
import subprocess
import time

from display import Display
from host import Host, contrast, difference


def changed(host, before, threshold, what):
    return host.wait_for(
        lambda: (p := host.screen()) and difference(p, before) > threshold and p, 90, what
    )


def play(host, out):
    def save(picture, name):
        picture.save(out / f"game_{name}.png")
        return picture

    host.wait_for(lambda: contrast(host.screen()) > 10, 180, "the title")
    host.xdotool("windowfocus", host.window)
    time.sleep(3)
    title = save(host.screen(), "1_title")

    host.press("Return")
    changed(host, title, 6, "Enter to begin a round")
    time.sleep(1.5)
    start = save(host.screen(), "2_play")

    host.key_down("shift")
    host.hold("w", 1.2)
    host.key_up("shift")
    walked = save(changed(host, start, 3, "W to walk"), "3_walked")

    host.key_down("g")
    time.sleep(0.8)
    save(host.screen(), "4_preview")
    host.key_up("g")
    time.sleep(0.5)
    save(host.screen(), "5_thrown")
    time.sleep(2.5)
    save(host.screen(), "6_after")

    host.press("F12")
    shot = pathlib.Path(host.folder.name) / "screenshot_0000.png"
    host.wait_for(shot.exists, 60, "F12 to write a screenshot")

    host.press("Escape")
    changed(host, walked, 3, "Escape to pause")
    time.sleep(7)  # toasts go
    paused = save(host.settled_screen(), "7_pause")
    for _ in range(2):
        host.press("Down")
        time.sleep(0.6)
    save(host.settled_screen(), "8_selected")
    return paused


def open_options_and_quit(host, paused, out):
    """The entries of the pause: resume, restart, options, title. The last of the title: quit."""
    host.press("Return")
    options = changed(host, paused, 3, "the options")
    options = host.settled_screen()
    options.save(out / "game_9_options.png")
    host.press("Escape")
    changed(host, options, 3, "Escape to leave the options")
    time.sleep(0.6)
    host.press("Down")
    time.sleep(0.6)
    host.press("Return")
    time.sleep(3)
    host.screen().save(out / "game_a_title_again.png")
    host.press("Up")  # around the top: the last entry
    time.sleep(0.6)
    host.press("Return")
    host.process.wait(60)
    assert host.process.returncode == 0, f"exit status {host.process.returncode}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for screenshots")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    record = (arguments.out / "round.replay").absolute()
    record.unlink(missing_ok=True)
    with Display() as display:
        with Host(display, arguments.program, "--mute", "--seed", "7", "--record", str(record)) as host:
            paused = play(host, arguments.out)
            open_options_and_quit(host, paused, arguments.out)
    again = subprocess.run(
        [arguments.program, "--headless", "--quiet", "--replay", str(record)],
        capture_output=True,
        text=True,
    )
    assert again.returncode == 3, again
    assert again.stdout.startswith("UNFINISHED "), again
    print("played; screenshots are in", arguments.out)


if __name__ == "__main__":
    main()
