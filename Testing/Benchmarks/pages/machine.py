# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a Python program measures with and on, and its file of numbers."""

import json
import os
import shlex
import sys
import time


def facts():
    """Absolute paths are a matter of one machine: of those only the file name is shown."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(": ", 1)[1].strip() for line in file if line.startswith("model name")]
    words = (os.path.basename(word) if os.path.isabs(word) else word for word in sys.argv)
    return {"command": shlex.join(["python3", *words]), "processor": (models + ["unknown"])[0],
            "cores": len(os.sched_getaffinity(0)), "date": time.strftime("%Y-%m-%d"),
            "load_before": os.getloadavg()[0]}


def save(measured, path):
    """Into a file, or to standard output."""
    text = json.dumps(measured, indent=1, ensure_ascii=False) + "\n"
    if path:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        sys.stdout.write(text)
