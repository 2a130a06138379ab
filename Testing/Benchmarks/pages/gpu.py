# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long the steps of the optimisation take on a GPU."""

from markdown import head, ms, plural, significant, table

GROUPS = {  # labels of launches by their line in the tables; others have their own
    "forward sweep": "forward sweeps", "derivative": "derivative of a term",
    "Adam": "Adam's step", "set to zero": "clearing and copying", "start rays": "clearing and copying",
    "copy": "clearing and copying", "upload": "to and from the host",
    "download": "to and from the host"}
STEPS = {
    "prepare": "scene: checks, importance of nodes, spans (host)",
    "upload": "scene: its fields to the GPU",
    "plan": "view: planning the rays (host)",
    "begin": "view: planning, tables and first iterate to the GPU",
    "run": "view: whole default run, including these",
    "download": "result to the host",
    "sphere": "scores of all directions",
    "picture": "picture of another extinction, with its shadows",
    "picture_at_rest": "picture of the same extinction",
    "frame": "frame of the display: all of these after the camera has moved",
    "processor": "policy iteration on the processor"}
ITERATIONS = {"policy": "policy iteration", "adam": "Adam iteration"}


def title(scene):
    return f"{scene['scene']}, {scene['nodes']}³"


def cell(key, text=lambda scene, figure: ms(figure["seconds"])):
    return lambda scene: text(scene, scene[key]) if "seconds" in scene[key] else "not measured"


def bars(scenes):
    def gigabytes(_, figure):
        return significant(1e-9 * figure["device_memory"])

    rows = [
        ("policy iteration [ms]", "256³ ≤ 1.2 (full: 2), 472³ ≤ 4 (full: 10)", cell("policy")),
        ("Adam iteration [ms]", "256³ ≤ 2, 472³ ≤ 12", cell("adam")),
        ("whole default run [ms]", "256³ ≤ 7", cell("run", lambda s, f: (
            f"{ms(f['seconds'])} ({plural(s['run_iterations'], 'iteration')})"))),
        ("picture with shadows [ms]", "1024² pixels ≤ 4", cell("picture")),
        ("frame of the display [ms]", "256³, 1024² pixels ≤ 12", cell("frame")),
        ("scores of all directions [ms]", "none", cell("sphere", lambda s, f: (
            f"{ms(f['seconds'])} ({plural(s['directions'], 'direction')})"))),
        ("device memory of a frame [GB]", "256³ ≤ 0.9, 472³ ≤ 5", cell("frame", gigabytes)),
        ("device memory, policy [GB]", "none", cell("policy", gigabytes)),
        ("device memory, Adam [GB]", "none", cell("adam", gigabytes))]
    return "\n## Against the bars\n" + table(rows, [
        ("quantity", lambda r: r[0]), ("bar (NVIDIA H200)", lambda r: r[1]),
        *((title(scene), lambda r, scene=scene: r[2](scene)) for scene in scenes)])


def iteration(scene, key, bandwidth):
    result = scene[key]
    if "seconds" not in result:
        return ""
    rows = {}
    for part in result["parts"]:
        name = GROUPS.get(part["label"], part["label"])
        row = rows.setdefault(name, {"name": name, "launches": 0, "seconds": 0, "bytes": 0})
        for figure in ("launches", "seconds", "bytes"):
            row[figure] += part[figure]
    total = {figure: sum(row[figure] for row in rows.values()) for figure in ("seconds", "bytes")}
    lines = [*rows.values(), {"name": "sum", **total},
             {**total, "name": "wall clock, undivided", "seconds": result["seconds"]}]

    def rate(row):
        known = row["bytes"] > 0 and row["seconds"] > 0 and bandwidth > 0
        return f"{significant(100 * row['bytes'] / row['seconds'] / bandwidth)} %" if known else "-"

    return table(lines, [
        (ITERATIONS[key], lambda r: r["name"]),
        ("launches", lambda r: significant(r["launches"]) if "launches" in r else ""),
        ("ms", lambda r: ms(r["seconds"])), ("MB", lambda r: significant(1e-6 * r["bytes"], 4)),
        ("of the copy rate", rate)])


def missing(measured):
    """What could not be measured, and why."""
    figures = [("copy rate", measured["copy"])]
    figures += [(f"{title(scene)}, {name}", scene[key]) for scene in measured["scenes"]
                for key, name in (*ITERATIONS.items(), *STEPS.items())]
    return "".join(f"* Not measured: {name}. {figure['missing']}\n"
                   for name, figure in figures if "missing" in figure)


def scene_section(scene, bandwidth):
    steps = [(name, scene[key]) for key, name in STEPS.items() if "seconds" in scene[key]]
    filled = significant(100 * scene["filled"])
    return (f"\n## {title(scene)}\n\n{filled} % of the voxels are swept.\n"
            + iteration(scene, "policy", bandwidth) + iteration(scene, "adam", bandwidth)
            + table(steps, [
                ("whole steps", lambda s: s[0]), ("ms", lambda s: ms(s[1]["seconds"])),
                ("spread", lambda s: f"{significant(100 * s[1]['spread'], 2)} %"),
                ("repetitions", lambda s: s[1]["repeats"])]))


def page(measured):
    text = head("Gpu", measured, "bash Testing/Gpu/one-shot.sh FOLDER")
    if measured["options"]["quick"] == "yes":
        text += "\n**A quick run with small pictures and few directions. Its figures are meaningless.**\n"
    text += f"\n* device: {measured['device']}\n"
    bandwidth = 0
    if "seconds" in measured["copy"]:
        bandwidth = measured["copy_bytes"] / measured["copy"]["seconds"]
        text += ("* copy rate within the device: "
                 f"{significant(1e-9 * bandwidth, 4)} GB/s, bytes read and bytes written\n")
    return text + bars(measured["scenes"]) + missing(measured) + "".join(
        scene_section(scene, bandwidth) for scene in measured["scenes"])
