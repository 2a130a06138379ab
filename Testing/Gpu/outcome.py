# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Reads what the one call (one-shot.sh) left in its folder, whenever it ended."""

import json

MOST_FILES = 8
MOST_BYTES = 16 << 20  # of a file
NOT_FINISHED = "began, not finished"


def text(out, name):
    path = out / name
    return path.read_text(errors="replace") if path.exists() else ""


def steps(out):
    """Name, result and second of the end (None: it did not end) of each, as they began."""
    found = {}
    for line in text(out, "summary.md").splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) == 6 and cells[4].isdigit():
            ended = cells[2] != NOT_FINISHED
            found[cells[1]] = (cells[2], int(cells[4]) if ended else None)
    return [(name, *rest) for name, rest in found.items()]


def unfinished(out):
    return [name for name, _, end in steps(out) if end is None]


def scenes(out):
    """Scenes of Gpu.json by the names of their steps."""
    written = text(out, "Gpu.json")
    found = {}
    for scene in json.loads(written)["scenes"] if written else []:
        name = scene["scene"].removesuffix(" along x")
        if name != scene["scene"]:
            found[f"bench_along-x-{scene['nodes']}"] = scene
        for step in (f"bench_{name}", f"bench_{name}-{scene['nodes']}"):
            found.setdefault(step, scene)
    return found


def faults(out):
    """What is absent or cannot be read: sentences."""
    wrong = []
    files = list(out.iterdir())
    if len(files) > MOST_FILES:
        wrong.append(f"There are {len(files)} files.")
    wrong += [f"{file.name} is too large." for file in files if file.stat().st_size > MOST_BYTES]
    try:
        measured = scenes(out)
    except (ValueError, KeyError) as error:
        return [*wrong, f"Gpu.json cannot be read: {error!r}."]
    logs = "".join(f"\n{text(out, file.name)}" for file in files if file.suffix == ".log")
    ended = [(name, result) for name, result, end in steps(out) if end is not None]
    for place, (name, result) in enumerate(ended):
        if result.startswith("not run"):
            continue
        if name.startswith("test_core_") and f"\n{name}: " not in logs:
            wrong.append(f"tests.log has nothing of {name}.")
        ran = result.startswith(("done", "FAILED, status", "STOPPED"))
        if ran and f"\n===== {name}: " not in logs:
            wrong.append(f"No log has what {name} printed.")
        if name.startswith("bench_") and result.startswith("done"):
            wrong += _faults_of_scene(out, name, measured.get(name), place + 1 < len(ended))
    return wrong


def _faults_of_scene(out, step, scene, has_page):
    if scene is None:
        return [f"Gpu.json has no scene of {step}."]
    wrong = [f"{step} is done, but has no {key}." for key, figure in scene.items()
             if "no time was left" in str(figure)]
    if "seconds" not in scene["policy"]:
        wrong.append(f"{step} has no policy iteration: {scene['policy']}.")
    if has_page and f"## {scene['scene']}, {scene['nodes']}" not in text(out, "Gpu.md"):
        wrong.append(f"Gpu.md has nothing of {step}.")
    return wrong
