# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Answers commands from standard input with the methods of an object (README.md)."""

import ctypes
import json
import sys


def answer_all(server):
    give_back()
    print("{}", flush=True)  # the scene is there
    for line in sys.stdin:
        command, _, value = line.strip().partition(" ")
        if command == "quit":
            break
        print(json.dumps(getattr(server, command)(value)), flush=True)


def give_back():
    """Hands free memory back to the system, so that what is resident is in use."""
    try:
        ctypes.CDLL(None).malloc_trim(0)
    except (AttributeError, OSError):
        pass  # not glibc
