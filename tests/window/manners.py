#!/usr/bin/env python3
"""The game in a window where things go wrong or nobody looks, on a virtual display.

Passes if a screen takes no input in its first moments, if a screenshot that cannot be written and a
record that cannot be kept end nothing, if a pause and a hidden window cost little, if --difficulty
leaves the saved one alone, and if a request to terminate writes what was asked for.
"""

import argparse
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time

from display import Display
from host import Host, contrast, difference


def used_seconds(process):
    """Of processor time: by the threads that trace and play, and by all."""
    tracing = everything = 0
    for thread in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
        name, fields = (thread / "stat").read_text().split("(", 1)[1].rsplit(")", 1)
        ticks = sum(map(int, fields.split()[11:13]))
        everything += ticks
        if name == "peregrine_play" and int(thread.name) != process.pid:  # OpenGL's have other names
            tracing += ticks
    return tracing / os.sysconf("SC_CLK_TCK"), everything / os.sysconf("SC_CLK_TCK")


def is_baking(process):
    return any((thread / "comm").read_text().strip() == "light_baker"
               for thread in pathlib.Path(f"/proc/{process.pid}/task").iterdir())


def load(process, seconds=3):
    """Processors that are kept busy, by the same two."""
    before, start = used_seconds(process), time.monotonic()
    time.sleep(seconds)
    passed = time.monotonic() - start
    return [(after - was) / passed for after, was in zip(used_seconds(process), before)]


def begin(host):
    host.wait_for(lambda: contrast(host.screen()) > 10, 180, "the title")
    host.wait_for(lambda: is_baking(host.process), 180, "the title to bake light")
    host.wait_for(lambda: not is_baking(host.process), 300, "the light between surfaces")
    host.xdotool("windowfocus", host.window)
    time.sleep(3)
    title = host.screen()
    host.press("Return")
    return host.wait_for(lambda: (p := host.screen()) and difference(p, title) > 6 and p, 90, "the round")


def play(host, out):
    assert host.title() == "Three Cores", host.title()
    begin(host)
    time.sleep(1)
    host.press("F12")  # into a folder that takes no files
    time.sleep(2)
    host.screen().save(out / "manners_1_toast.png")
    assert host.process.poll() is None, "F12 ended the game"
    playing = load(host.process)

    host.key_down("w")
    host.xdotool("key", "--window", host.window, "Escape", "key", "--window", host.window, "Return")
    time.sleep(1.5)
    paused = host.screen()
    paused.save(out / "manners_2_paused.png")
    time.sleep(8)  # toasts go
    still = host.screen()
    time.sleep(1)
    assert difference(host.screen(), still) < 0.5, "the pause was left by a key of its first moments"
    host.key_up("w")
    resting = load(host.process)
    host.xdotool("windowunmap", host.window)
    time.sleep(1)
    hidden = load(host.process)
    for name, (tracing, everything) in dict(playing=playing, paused=resting, hidden=hidden).items():
        print(f"{name}: {tracing:.3f} processors busy with frames, {everything:.3f} at all")
    assert resting[0] < 0.1 * playing[0], "the pause goes on tracing frames"
    assert hidden[1] < 0.1, "a window that nobody sees costs something"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for screenshots")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    arguments.program = str(pathlib.Path(arguments.program).absolute())
    with tempfile.TemporaryDirectory() as folder, Display() as display:
        stats, record = pathlib.Path(folder) / "stats.json", pathlib.Path(folder) / "made" / "a.replay"
        record.parent.mkdir()
        wishes = ["--mute", "--threads", "2", "--difficulty", "hard", "--stats", str(stats), "--record", str(record)]
        with Host(display, arguments.program, *wishes, folder="/proc") as host:
            settings = pathlib.Path(host.folder.name) / "config/peregrine/three_cores.json"
            settings.parent.mkdir(parents=True)
            play(host, arguments.out)
            saved = json.loads(settings.read_text())["difficulty"]
            assert saved == 1, f"--difficulty was saved as {saved}"
            record.parent.rmdir()  # there is no place for the record any more
            host.process.send_signal(signal.SIGTERM)
            status = host.process.wait(60)
        assert status == 2, f"exit status {status}: the lost record was to be told of"
        assert json.loads(stats.read_text())["frames"] > 0
        refused = subprocess.run(
            [arguments.program, "--record", "/dev/full"], capture_output=True, text=True,
            env=display.environment(), timeout=60,
        )
        assert refused.returncode == 2 and "/dev/full" in refused.stderr, refused
    print("screenshots are in", arguments.out)


if __name__ == "__main__":
    main()
