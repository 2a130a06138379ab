# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The same sources by several compilers."""

from markdown import fixed, head, ms, percent, plural, table


def page(measured):
    builds = measured["builds"]
    first = builds[0]
    labels = list(first["seconds"])

    def time_of(build):
        return (f"{build['name']} [ms]", lambda label: ms(build["seconds"][label]))

    def ratio_of(build):
        return (f"{build['name']} / {first['name']}",
                lambda label: fixed(build["seconds"][label] / first["seconds"][label], 2))

    def spread_of(label):
        return percent(max(build["spread"][label] for build in builds))

    return head("Compilers", measured, "python3 Testing/Benchmarks/compilers.py") + f"""
Medians of {plural(measured['rounds'], 'round')} in turns, CPU time of one thread; *spread*: the \
largest of any build.
""" + table(builds, [("build", lambda b: b["name"]), ("compiler", lambda b: b["compiler"])]
            ) + table(labels, [("what", str), *map(time_of, builds), *map(ratio_of, builds[1:]),
                               ("spread", spread_of)])
