# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the pages quote the defaults and figures that sources and measured numbers have."""

import json
import re
import sys
import unittest

import house

sys.path.append(str(house.ROOT / "Testing" / "Benchmarks" / "pages"))

from fronts import equal_errors  # pylint: disable=wrong-import-position

PARAMETERS = "Documentation/Parameters.md"
DEVIATIONS = "Documentation/Deviations.md"
TUTORIAL = "Documentation/Tutorial.md"
PROPERTIES = {"Clearing Threshold": "clearingThreshold", "Protect Importance": "protectImportance",
              "Emphasis": "emphasis", "Importance Smoothing": "importanceSmoothing",
              "Smoothness": "smoothness", "Temporal Coherence": "temporalCoherence",
              "View Weight": "view", "Light Weight": "light",
              "Regularization Weight": "regularization"}


def value_of(text):
    """A number, or the last word of an enumeration."""
    try:
        return float(text)
    except ValueError:
        return text.strip().split("::")[-1]


def presets():
    """The values of cuda/optimize/Presets.h by preset and property."""
    pattern = r'\{ "([^"]+)", \{ (\S+), (\S+), (\S+) \}' + 6 * r", (\S+)" + r" \}"
    order = ("Regularization Weight", "View Weight", "Light Weight", "Clearing Threshold",
             "Protect Importance", "Emphasis", "Importance Smoothing", "Smoothness",
             "Temporal Coherence")
    return {name: dict(zip(order, map(value_of, values)))
            for name, *values in re.findall(pattern, house.text("cuda/optimize/Presets.h"))}


def core_default(member):
    found = re.search(rf"\b{member} = ([\w.:-]+);", house.text("cuda/optimize/Settings.h"))
    return value_of(found.group(1))


def panel_default(name):
    """Of cuda/optimize/Settings.xml; an entry of an enumeration by its text."""
    xml = house.text("cuda/optimize/Settings.xml")
    found = re.search(rf'name="{name.replace(" ", "")}"[^>]*default_values="([^"]*)"[^>]*>(.*?)'
                      r"</\w*Property>", xml, re.DOTALL)
    entry = re.search(rf'<Entry value="{found.group(1)}" text="([^"]+)"', found.group(2))
    return entry.group(1) if entry else value_of(found.group(1))


def measured(page):
    return json.loads(house.text(f"Documentation/Benchmarks/{page}.json"))


def section(heading):
    return house.text(PARAMETERS).split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]


def paragraph(name):
    """An entry of Deviations.md, on one line."""
    return " ".join(re.search(rf"^{name} .*?(?=\n\n)", house.text(DEVIATIONS),
                              re.DOTALL | re.MULTILINE).group(0).split())


def figures(pattern, text):
    """The numbers of the first place that a pattern with groups finds."""
    found = re.search(pattern, text)
    assert found, f"nothing says {pattern}"
    return [float(number.replace("−", "-")) for number in found.groups()]


def columns(rows, *indices):
    """Of rows of a table by the first cell: numbers of some others, the first of each cell."""
    return {row[0]: [float(re.search(r"-?[\d.]+", row[index]).group(0)) for index in indices]
            for row in rows}


class Defaults(unittest.TestCase):
    def test_the_table_of_presets_is_that_of_the_core(self):
        head = [cell.strip() for cell in
                re.search(r"^\| preset \|(.*)\|$", house.text(PARAMETERS), re.MULTILINE)
                .group(1).split("|")]
        rows = {row[0]: dict(zip(head, map(value_of, row[1:])))
                for row in house.rows(PARAMETERS, "## Presets, and the slider")}

        self.assertEqual(rows, {name: {property: values[property] for property in head}
                                for name, values in presets().items()})

    def test_weights_of_all_presets_are_those_that_the_page_says(self):
        weights = figures(r"All have View Weight (\S+), Light Weight (\S+) and Regularization "
                          r"Weight ([\d.]+)\. ", " ".join(house.text(PARAMETERS).split()))
        for name, values in presets().items():
            found = [values[weight + " Weight"] for weight in ("View", "Light", "Regularization")]
            self.assertEqual(found, weights, name)

    def test_panels_start_with_the_default_preset_and_the_core_with_the_paper(self):
        for name, member in PROPERTIES.items():
            self.assertEqual(panel_default(name), presets()["Default"][name], name)
            self.assertEqual(core_default(member), presets()["Paper"][name], name)

    def test_the_default_that_a_section_names_is_the_panels(self):
        for name, pattern in (("Protect Importance", r"At (\S+), the default"),
                              ("Protect Importance", r"Why (\S+) is the default"),
                              ("Emphasis", r"At (\S+), the default"),
                              ("Emphasis", r"Why (\S+) is the default"),
                              ("Importance Smoothing", r"\*(\w+)\*, the default"),
                              ("Smoothness", r"At (\S+), the default"),
                              ("Temporal Coherence", r"At (\S+), the display's default"),
                              ("View Weight", r"from (\S+), the default")):
            said = re.search(pattern, " ".join(section(name).split()))
            self.assertTrue(said, f"{name}: nothing says {pattern}")
            self.assertEqual(value_of(said.group(1)), panel_default(name), name)

    def test_deviations_name_the_defaults_of_panels_and_paper(self):
        for entry, name in (("D16", "Protect Importance"), ("D18", "Smoothness")):
            paper, default = figures(r"The paper has (\S+), the default is ([\d.]+)\.",
                                     paragraph(entry))
            self.assertEqual(paper, presets()["Paper"][name], entry)
            self.assertEqual(default, panel_default(name), entry)
        median = panel_default("Importance Smoothing")
        self.assertIn(f"The paper has Off, the default is *{median}*", paragraph("D17"))
        self.assertEqual(figures(r"at most (\d+) iterations", paragraph("D4")),
                         [panel_default("Maximum Iterations")])
        self.assertEqual(core_default("maximumIterations"), panel_default("Maximum Iterations"))


class Results(unittest.TestCase):
    """Of pages that quote others, or numbers that were measured."""

    def test_energies_of_the_solvers_are_bounded_as_it_says(self):
        text = house.text("Testing/Core/TestSolverScenes.cxx").split("AtEveryWeight)", 1)[1]
        bound, = figures(r"least \+ ([\d.]+) \* std::abs\(least\)", text)
        weights = figures(r"weight : \{ ([\d.]+),.* ([\d.]+) \}\)", text)
        share, least, most = figures(r"([\d.]+) % above Adam's with 1/(\d+) to (\d+) times",
                                     paragraph("D4"))

        self.assertAlmostEqual(share, 100 * bound, delta=1e-12)  # a product and its rounding
        paper = core_default("view")
        self.assertEqual([least, most], [paper / weights[0], weights[1] / paper])
        self.assertNotRegex(paragraph("D4"), r"[\d.]+ % below")  # of the page it refers to

    def test_scores_are_as_near_to_the_march_as_it_says(self):
        bound, = figures(r"scores within ([\d.]+) % of the march", paragraph("D3"))
        for scene in measured("Solvers")["scenes"]:
            quality = scene["quality"]
            for score in (quality["base"], quality["policy"]["S"], quality["adam"]["S"]):
                self.assertLessEqual(abs(score["reported"] / score["march"] - 1), bound / 100,
                                     scene["scene"])

    def test_shares_of_an_orbit_are_those_of_their_page(self):
        shares = [100 * scene["joint"] / scene["single"]
                  for scene in measured("Orbits")["scenes"].values()]
        for text in (paragraph("D21"), " ".join(section("Views").split())):
            self.assertEqual(figures(r"(\d+) to (\d+) %", text),
                             [round(min(shares)), round(max(shares))])

    def test_frames_of_a_gpu_are_those_of_their_page(self):
        frames = [1e3 * scene["frame"]["seconds"] for scene in measured("Gpu")["scenes"]
                  if scene["nodes"] == 256]
        said = figures(r"a frame of 256³ after the camera has moved takes (\d+) to (\d+) ms",
                       " ".join(house.text("Documentation/Limits.md").split()))

        self.assertEqual(said, [round(min(frames)), round(max(frames))])

    def test_the_lines_of_plots_are_where_the_page_says(self):
        page = " ".join(house.text("Documentation/Benchmarks/README.md").split())
        for plot, name, pattern in (
                ("errors", "BAR", r"dashed line is (\d+) times"),
                ("scaling", "LEAST_EFFICIENCY", r"dashed line is at ([\d.]+)\.")):
            drawn = re.search(rf"^{name} = (\S+)", house.text(
                f"Testing/Benchmarks/pages/plot_{plot}.py"), re.MULTILINE)
            self.assertEqual(figures(pattern, page), [float(drawn.group(1))])

    def test_the_papers_grids_take_as_long_as_the_page_says(self):
        finest, at_five = [], []
        for scene in measured("Errors")["scenes"]:
            rows = equal_errors(scene)
            finest.append(max((row for row in rows if row["samples_per_voxel"]),
                              key=lambda row: row["samples_per_voxel"]))
            at_five += [row["grid_seconds"] / row["policy"][0] for row in rows
                        if not row["samples_per_voxel"] and row["error"] == 0.05
                        and scene["voxels"] > 1e6]
        page = " ".join(house.text("Documentation/Benchmarks/README.md").split())

        ratios = [row["grid_seconds"] / row["policy"][0] for row in finest]
        self.assertEqual(figures(r"take (\d+) to (\d+) times as long", page),
                         [round(min(ratios)), round(max(ratios))])
        errors = [100 * row["error"] for row in finest]
        self.assertEqual(figures(r"whose S is ([\d.]+) to ([\d.]+) % off", page),
                         [round(min(errors), 1), round(max(errors), 1)])
        self.assertEqual(figures(r"at 5 % it is (\d+) to (\d+) times", page),
                         [round(min(at_five)), round(max(at_five))])

    def test_all_figures_take_as_long_as_their_pages_say(self):
        folder = "Documentation/Examples/figures/"
        seconds = {name: found["seconds"] for name, found in json.loads(house.text(
            "Documentation/Pictures/figures/figures.json")).items()}
        study = seconds.pop("table_methods")
        wanted = [round(sum(seconds.values()) / 60), round(study / 60)]
        pages = [" ".join(house.text(folder + name).replace("#", "").split())
                 for name in ("README.md", "all.sh")]

        self.assertEqual([figures(r"(\d+) minutes on two cores", pages[0])[0],
                          figures(r"Ament 2017: (\d+) minutes", pages[0])[0]], wanted)
        self.assertEqual(figures(r"Takes (\d+) minutes on two cores.*another (\d+) minutes",
                                 pages[1]), wanted)

    def test_the_best_view_is_sought_on_as_many_sides_as_the_tutorial_says(self):
        said = figures(r"(\d+) sides are scored", house.text(TUTORIAL))

        self.assertEqual(said, figures(r"const int DIRECTIONS = (\d+);",
                                       house.text("Plugin/Gui/LimpidBestView.cxx")))

    def test_the_tutorial_begins_with_the_shares_of_its_table(self):
        said = figures(r"([\d.]+) % of the bone can be seen, ([\d.]+) % without",
                       " ".join(house.text(TUTORIAL).split()))

        self.assertEqual(said, columns(house.rows(TUTORIAL, "## Other data"), 1, 2)["visible_male"])

    def test_large_volumes_fit_into_the_memory_that_the_page_asks_for(self):
        rows = house.rows("Documentation/Benchmarks/LargeVolumes.md", "# Large volumes")
        peak = max(float(row[9]) for row in rows)
        asked, = figures(r"limpid_large [\d ]+`, with (\d+) GB of free memory",
                         house.text("Documentation/Benchmarks/README.md"))

        self.assertLessEqual(peak, asked)
        self.assertLess(asked, 1.1 * peak + 1)  # and not much more than it takes

    def test_tables_of_the_same_runs_agree(self):
        """The display's defaults, in three tables: by the display in two, by the filter in one."""
        rows = house.rows(PARAMETERS, "## Protect Importance")
        kept, removed = columns(rows, 4), columns(rows, 2)
        smooth = section("Smoothness").split("With *Protect Importance* 0:")
        last = re.compile(r"^\| (\w+) \|.*\| [\d.]+, ([\d.]+), [\d.]+, \d+ \|$", re.MULTILINE)
        tables = [last.findall(text) for text in smooth]
        for shares, table in zip((kept, removed), tables):
            self.assertEqual(set(shares), {name for name, _ in table})
            for name, share in table:
                # Each is rounded by up to 0.05. The display has a function of opacities where the
                # filter has an array of extinctions: S of skull_phantom differs by 0.7 %.
                self.assertAlmostEqual(shares[name][0], float(share),
                                       delta=0.1 + 0.01 * float(share), msg=name)
        for name, (share,) in columns(house.rows(PARAMETERS, "## Emphasis"), 5).items():
            self.assertEqual(kept[name][0], share, name)

    def test_the_price_of_protection_is_quoted_as_its_table_has_it(self):
        rows = house.rows(PARAMETERS, "## Protect Importance")
        cells = [[list(map(float, row[index].split(" / "))) for index in (2, 4)] for row in rows]
        costs = [free[0] - kept[0] for free, kept in cells]
        shares = [100 * (1 - kept[1] / free[1]) for free, kept in cells]
        text = " ".join(section("Protect Importance").split())
        said = (figures(r"costs between ([\d.]+) and ([\d.]+) points", text)
                + figures(r"keeps between (\d+) and (\d+) %", text))

        self.assertEqual(said, [round(min(costs), 1), round(max(costs), 1),
                                round(min(shares)), round(max(shares))])

    def test_the_corner_is_quoted_with_the_share_of_the_table(self):
        visible, most, base = figures(
            r"Visible ([\d.]+) % of at most ([\d.]+) % from here \(was ([\d.]+) %",
            " ".join(house.text(PARAMETERS).split()))
        rows = columns(house.rows(PARAMETERS, "## Protect Importance"), 4, 1)

        self.assertEqual([visible, base], rows["visible_male"])
        self.assertLess(visible, most)

    def test_emphasis_is_quoted_as_its_table_has_it(self):
        rows = columns(house.rows(PARAMETERS, "## Emphasis"), 2, 3, 4, 5)
        ratios = [without / with_all for with_all, without, *_ in rows.values()]
        gains = [without - with_all for *_, with_all, without in rows.values()]
        self.assertEqual(figures(r"\(carotid_mra ([\d.]+) → ([\d.]+) %\)", paragraph("D22")),
                         rows["carotid_mra"][:2])
        self.assertEqual(figures(r"own functions ([\d.]+) to ([\d.]+) points", paragraph("D22")),
                         [round(min(gains), 1), round(max(gains), 1)])
        for text in (paragraph("D22"), " ".join(section("Emphasis").split())):
            self.assertEqual(figures(r"([\d.]+) to ([\d.]+) times", text),
                             [round(min(ratios), 1), round(max(ratios), 1)])


if __name__ == "__main__":
    unittest.main()
