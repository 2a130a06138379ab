# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether all files state the same version, the list of changes has its form, and the files for GitHub,
GitLab and pre-commit can be read and run the same jobs."""

import re
import shutil
import subprocess
import unittest

import house

try:
    import yaml
except ImportError:
    yaml = None

KINDS = ["Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"]
WORKFLOW = ".github/workflows/ci.yml"
GITLAB = ".gitlab-ci.yml"


def version():
    """The version in CMakeLists.txt."""
    return re.search(r"^project\(Limpid\n  VERSION (\d+\.\d+\.\d+)$", house.text("CMakeLists.txt"),
                     re.MULTILINE).group(1)


def parts(number):
    return tuple(int(part) for part in number.split("."))


def hosts_files():
    """All YAML files."""
    return house.files("*.yml", "*.yaml") + [
        path for path in house.top_files() if path.suffix in (".yml", ".yaml")]


def jobs():
    """The jobs of Testing/ci.sh, as its head lists them."""
    head = house.text("Testing/ci.sh").split("set -euo pipefail")[0]
    return re.findall(r"^# (\w+)  +\S", head, re.MULTILINE)


class TestVersion(unittest.TestCase):
    def test_the_citation_has_it(self):
        self.assertEqual(re.findall(r"^version: (.*)$", house.text("CITATION.cff"), re.MULTILINE),
                         [version()])

    def test_recipes_have_it(self):
        for path in house.files("*", under=["Plugin/Packaging"]):
            found = re.findall(r"^\s*version\s*[:=(]\s*\"?(\d+\.\d+\.\d+)", house.text(path),
                               re.MULTILINE)
            self.assertIn(version(), found or [version()], path)

    def test_the_python_package_reads_it(self):
        project = house.text("Plugin/Wheel/pyproject.toml")

        self.assertIn('dynamic = ["version"]', project)
        self.assertIn('input = "../../CMakeLists.txt"', project)

    def test_the_list_of_changes_has_it_first(self):
        released = re.findall(r"^## \[(\d\S*)\]", house.text("CHANGELOG.md"), re.MULTILINE)

        self.assertEqual(released[0], version())


class TestChanges(unittest.TestCase):
    def setUp(self):
        self.text = house.text("CHANGELOG.md")
        self.sections = re.split(r"^## ", self.text, flags=re.MULTILINE)[1:]

    def test_versions_go_down_and_have_dates(self):
        heads = [section.splitlines()[0] for section in self.sections]
        numbers = []
        for head in heads[1:]:
            match = re.fullmatch(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d|unreleased)", head)
            self.assertTrue(match, f'"## {head}" is not "## [1.2.3] - 2030-12-31".')
            numbers.append(parts(match.group(1)))

        self.assertEqual(heads[0], "[Unreleased]")
        self.assertEqual(numbers, sorted(set(numbers), reverse=True))
        self.assertFalse([head for head in heads[2:] if head.endswith("unreleased")])

    def test_kinds_are_known_and_in_order(self):
        for section in self.sections:
            kinds = re.findall(r"^### (.*)$", section, re.MULTILINE)
            self.assertEqual(kinds, [kind for kind in KINDS if kind in kinds])

    def test_no_heading_is_empty(self):
        lines = [line for line in self.text.splitlines() if line]
        for line, following in zip(lines, lines[1:] + [""]):
            if re.match(r"####? ", line):
                self.assertRegex(following, r"^(\* |#### )", f"Nothing is below {line}.")

    def test_each_line_is_an_entry(self):
        for section in self.sections:
            for _, text in [part.split("\n", 1) for part in re.split(r"^###+ ", section, flags=re.M)[1:]]:
                for line in text.splitlines():
                    self.assertRegex(line, r"^(|\* \S.*|  \S.*)$")

    def test_there_are_no_other_lists(self):
        self.assertFalse((house.ROOT / "Documentation/Changelog").exists(),
                         "Move its texts to Unreleased in CHANGELOG.md.")


class TestHosts(unittest.TestCase):
    def read(self, path):
        if yaml is None:
            self.skipTest("There is no PyYAML. Install python3-yaml.")
        return yaml.safe_load(house.text(path))

    def test_their_files_can_be_read(self):
        paths = hosts_files()
        self.assertGreater(len(paths), 5)
        for path in paths:
            self.assertTrue(self.read(path), path)

    def test_both_run_all_jobs(self):
        matrix = self.read(WORKFLOW)["jobs"]["ci"]["strategy"]["matrix"]
        gitlab = {name: job["script"] for name, job in self.read(GITLAB).items()
                  if isinstance(job, dict) and "script" in job}

        self.assertEqual(sorted(matrix["job"]), sorted(jobs()))
        self.assertEqual(gitlab, {job: f"bash Testing/ci.sh {job}" for job in jobs()})

    def test_both_test_the_same_releases_of_debian(self):
        matrix = self.read(WORKFLOW)["jobs"]["ci"]["strategy"]["matrix"]
        github = matrix["debian"] + [more["debian"] for more in matrix["include"]]

        self.assertEqual(github, self.read(GITLAB)["tests"]["parallel"]["matrix"][0]["DEBIAN"])

    def test_the_licence_for_reuse_is_the_licence(self):
        self.assertEqual(house.text("LICENSES/BSD-3-Clause.txt"), house.text("LICENSE"))

    def test_commits_that_blame_ignores_exist(self):
        if not shutil.which("git") or not (house.ROOT / ".git").exists():
            self.skipTest("This is no clone, or there is no git.")
        git = ["git", "-c", f"safe.directory={house.ROOT}", "-C", str(house.ROOT)]
        shallow = subprocess.run([*git, "rev-parse", "--is-shallow-repository"], check=True,
                                 capture_output=True, text=True).stdout.strip()
        if shallow == "true":
            self.skipTest("The clone has no history.")
        hashes = [line for _, line in house.lines(".git-blame-ignore-revs")
                  if line and not line.startswith("#")]
        for commit in hashes:
            self.assertRegex(commit, "^[0-9a-f]{40}$")
            subprocess.run([*git, "merge-base", "--is-ancestor", commit, "HEAD"], check=True)


if __name__ == "__main__":
    unittest.main()
