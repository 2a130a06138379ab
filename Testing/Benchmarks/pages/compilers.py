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
The numbers are CPU times of one thread, medians of {plural(measured['rounds'], 'round')} in turns. \
*Spread* is the largest of all builds.
""" + table(builds, [("build", lambda b: b["name"]), ("compiler", lambda b: b["compiler"])]
            ) + table(labels, [("computation", str), *map(time_of, builds), *map(ratio_of, builds[1:]),
                               ("spread", spread_of)])
