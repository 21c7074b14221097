#!/usr/bin/env python3
"""Runs a program that draws in windows, on a virtual display: on_display.py PROGRAM ARGUMENTS..."""

import subprocess
import sys

from display import Display

with Display() as display:
    sys.exit(subprocess.run(sys.argv[1:], env=display.environment()).returncode)
