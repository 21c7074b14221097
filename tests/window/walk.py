#!/usr/bin/env python3
"""Opens the viewer in a window on a virtual display, presses keys and looks at the screen.

Passes if the window shows a picture that is not flat, if walking (W), the next view (V) and the
next camera (C) each change it, if a resize is followed, and if Escape ends the program.
"""

import argparse
import pathlib
import time

from display import Display
from host import SIZE, Host, contrast, difference

LARGER = (720, 450)


def walk(host, out):
    host.wait_for(lambda: " ms" in host.title(), 120, "a frame time in the title")
    host.xdotool("windowfocus", host.window)
    first = host.screen()
    first.save(out / "1_start.png")
    assert contrast(first) > 10, "the window is flat"

    host.hold("w", 1.5)
    walked = host.wait_for(
        lambda: (p := host.screen()) and difference(p, first) > 3 and p, 60, "W to move the camera"
    )
    time.sleep(1)
    walked = host.screen()
    walked.save(out / "2_walked.png")

    host.press("v")
    host.wait_for(lambda: difference(host.screen(), walked) > 10, 60, "V to change the view")
    host.wait_for(lambda: "normals" in host.title(), 60, "the view in the title")
    host.screen().save(out / "3_normals.png")
    for view in ("depth", "steps", "light", "occlusion", "shaded"):
        host.press("v")
        host.wait_for(lambda: view in host.title(), 60, "the view " + view)
    host.press("c")
    host.wait_for(lambda: difference(host.screen(), walked) > 5, 60, "C to change the camera")

    host.xdotool("windowsize", host.window, *map(str, LARGER))
    host.wait_for(lambda: "%dx%d" % LARGER in host.title(), 60, "the new size in the title")
    larger = host.screen(LARGER)
    larger.save(out / "4_larger.png")
    corner = larger.crop((SIZE[0], SIZE[1], *LARGER))
    assert contrast(corner) > 1, "the grown part of the window is flat"

    host.press_until_it_ends("Escape", 60)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scene", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for screenshots")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with Display() as display:
        viewer = Host(display, arguments.program, "--view-only", "--scene", arguments.scene)
        with viewer as host:
            walk(host, arguments.out)
    print("walked; screenshots are in", arguments.out)


if __name__ == "__main__":
    main()
