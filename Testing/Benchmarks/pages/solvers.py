# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Which extinction the solvers find, how fast, in how much memory; beside the paper's scheme."""

from markdown import arrow, deviation, fixed, head, mebibytes, ms, noise, percent, significant
from markdown import sizes, table

SCENE = ("scene", lambda s: s["scene"])


def checked(name, path):
    """Three columns of a score beside the march's."""
    def score(scene):
        for key in path:
            scene = scene[key]
        return scene

    return [(f"{name}, reported", lambda s: significant(score(s)["reported"], 6)),
            ("march", lambda s: significant(score(s)["march"], 6)),
            ("deviation", lambda s: deviation(score(s)["reported"], score(s)["march"]))]


def quality(scenes, options):
    def run(solver):
        return [("S (march)", lambda s: significant(s["quality"][solver]["S"]["march"], 5)),
                ("visible, before → after", lambda s: arrow(s["quality"]["base_fraction"],
                                                            s["quality"][solver]["fraction"])),
                ("iterations", lambda s: s["quality"][solver]["iterations"]),
                ("time [s]", lambda s: significant(s["quality"][solver]["seconds"]))]

    return f"""
## Policy against Adam

The march is that of Testing/Reference. It uses double precision, {options['march-rays']:g} rays per \
voxel and axis, four Gauss points in every piece of a cell, and no code of the solver.

### Are the reported scores true?

The table compares scores [length²] reported by the solver with those of the march.
""" + table(scenes, [SCENE, *checked("base S", ["quality", "base"]),
                     *checked("policy S", ["quality", "policy", "S"]),
                     *checked("Adam S", ["quality", "adam", "S"])]) + """\
### Which solver ends lower?

The table compares the policy with default settings and Adam with 32, 32 and 64 iterations on a \
quarter, half and full resolution. F is the energy of Eq. (21). The last column is negative where the \
policy has lower energy, which is better. S after one iteration is the reported one. Visible is the \
share of the important structures in the data whose light reaches the camera. Times are those of one \
run each, with setup.
""" + table(scenes, [
        SCENE, ("policy, 1 iteration: F", lambda s: fixed(s["quality"]["policy"]["first_F"])),
        ("S", lambda s: significant(s["quality"]["policy"]["first_S"], 5)),
        ("policy: F", lambda s: fixed(s["quality"]["policy"]["F"])), *run("policy"),
        ("Adam: F", lambda s: fixed(s["quality"]["adam"]["F"])),
        run("adam")[0], *run("adam")[2:],
        ("F, policy to Adam", lambda s: deviation(s["quality"]["policy"]["F"],
                                                  s["quality"]["adam"]["F"]))])


def off_and_on(parts, time=lambda scene: scene["time"]):
    """Three columns for each (name, key, format) of runs with skips and without."""
    columns = []
    for name, key, text in parts:
        for heading, skips in ((name + ": on", "skips on"), ("off", "skips off")):
            columns.append((heading, lambda s, skips=skips, key=key, text=text:
                            text(time(s)[skips]["seconds"][key])))
        columns.append(("off / on", lambda s, key=key: fixed(
            time(s)["skips off"]["seconds"][key] / time(s)["skips on"]["seconds"][key], 2)))
    return columns


def spread(time):
    """Of whole runs with skips."""
    return time["skips on"]["spread"]["whole"]


READY = ("setup + first pass [ms]", "ready", ms)
WHOLE = ("whole run [s]", "whole", significant)


def time_of_runs(scenes, measured):
    def on(name, key, text=ms):
        return name, lambda s: text(s["time"]["skips on"]["seconds"][key])

    return f"""
## Time

The policy runs with default settings, for camera and light, on \
{measured['machine']['threads']} threads. The numbers are wall times, medians of {measured['options']['repeats']:g} runs with skips on and off in \
turns, after a warm-up of each. Setup ends with score and energy of the base extinction. Spread is the \
slowest minus the fastest whole run, over the median. Much more than 10 % means that the machine was \
busy.
""" + table(scenes, [
        SCENE, ("voxels", lambda s: sizes(s["nodes"])), on("setup [ms]", "setup"),
        on("first pass [ms]", "first"), on("setup + first pass [ms]", "ready"),
        on("later iteration [ms]", "later"), ("iterations", lambda s: s["time"]["iterations"]),
        on("whole run [s]", "whole", significant),
        ("spread", lambda s: percent(spread(s["time"])))]) + noise(
            [spread(s["time"]) for s in scenes], 0.2) + """\
### With and without skipping
""" + table(scenes, [SCENE, *off_and_on([READY, ("later iteration [ms]", "later", ms), WHOLE])])


def against_paper(scenes, options):
    def of(who, key):
        return lambda s: s["paper"][who][key]

    def result(who, name):
        def own(scene):
            score = scene["paper"][who]["S"]
            return deviation(score["reported"], score["march"])

        return [(f"{name}: F", lambda s: fixed(s["paper"][who]["F"])),
                ("S, march", lambda s: significant(s["paper"][who]["S"]["march"], 5)),
                ("S, own", own)]

    def base(who):
        return lambda s: deviation(s["paper"][who]["base_score"], s["paper"]["base_march"])

    return f"""
## The paper's scheme

The table has an Adam iteration at full resolution, camera and light, in single precision. \
Perspective grids with {options['paper-samples']:g} samples per voxel and axis (Eqs. 13, 17–20, 26–28) \
and Limpid's sweeps with their defaults run in turns, after one iteration of each as warm-up. The \
numbers are medians.
""" + table(scenes, [
        SCENE, ("camera grid", lambda s: sizes(s["paper"]["camera_cells"])),
        ("light grid", lambda s: sizes(s["paper"]["light_cells"])),
        ("timed iterations", lambda s: of("paper", "time")(s)["repeats"]),
        ("paper's scheme [ms]", lambda s: ms(of("paper", "time")(s)["seconds"])),
        ("Limpid [ms]", lambda s: ms(of("limpid", "time")(s)["seconds"])),
        ("ratio", lambda s: fixed(of("paper", "time")(s)["seconds"]
                                  / of("limpid", "time")(s)["seconds"], 1))]) + """\
The next table has the scores that both report, as deviations from the march, and the results of the \
same number of Adam iterations from the base extinction. F is computed by Limpid's sweeps for both \
fields.
""" + table(scenes, [
        SCENE, ("base S, march", lambda s: significant(s["paper"]["base_march"], 5)),
        ("paper's scheme", base("paper")), ("Limpid", base("limpid")),
        ("iterations", lambda s: of("paper", "time")(s)["repeats"] + 1),
        *result("paper", "paper's scheme"), *result("limpid", "Limpid")])


def memory(scenes):
    def voxels(scene):
        return scene["nodes"][0] * scene["nodes"][1] * scene["nodes"][2]

    def per_voxel(kind):
        return lambda s: fixed(s["memory"][kind] / voxels(s), 1)

    return """
## Memory

The numbers are the peak resident memory of a run to the end, from the solver's constructor on, minus \
the memory that was resident before. The two arrays of the input are not included, the result is. Each \
run has a process of its own, forked before any threads are started. It reads the scene, returns free \
memory (malloc_trim) and resets the peak (/proc/self/clear_refs). At the end it reads VmHWM minus the \
earlier VmRSS from /proc/self/status. Stacks of threads and newly used pages of libraries count, which \
is visible in small scenes. The policy has default settings, Adam two iterations per level.
""" + table(scenes, [SCENE, ("voxels", voxels),
                     ("policy [MiB]", lambda s: mebibytes(s["memory"]["policy"])),
                     ("policy [byte/voxel]", per_voxel("policy")),
                     ("policy, separate [byte/voxel]", per_voxel("separate")),
                     ("Adam [byte/voxel]", per_voxel("adam"))])


def page(measured):
    def having(part):
        return [scene for scene in measured["scenes"] if scene.get(part)]

    options = measured["options"]
    parts = (("quality", lambda s: quality(s, options)),
             ("time", lambda s: time_of_runs(s, measured)),
             ("paper", lambda s: against_paper(s, options)), ("memory", memory))
    return head("Solvers", measured) + "".join(
        text(having(part)) for part, text in parts if having(part))
