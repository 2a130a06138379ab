# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The public names of the package: listed, annotated, documented in the style of numpy, and typed for
# type checkers; and the metadata of the installed distribution.

import dataclasses
import importlib.metadata
import importlib.util
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import limpid

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "Documentation/Examples"
PACKAGE = pathlib.Path(limpid.__file__).parent
FUNCTIONS = [limpid.optimize, limpid.viewpoints, limpid.render, limpid.load, limpid.png]
CLASSES = [limpid.Camera, limpid.Light, limpid.Optimization, limpid.ProgressBar, limpid.Settings,
           limpid.StructureShares, limpid.Viewpoint, limpid.Viewpoints]
#: Methods that the package itself calls.
INTERNAL = ("all_of", "as_header", "axes", "from_header", "in_core", "of", "views_in_core")
#: What is said of a number that has no unit.
WITHOUT_UNIT = re.compile(r"dimensionless|\bover\b|[Nn]umber of|Most viewpoints|[Cc]omponent|"
                          r"Directions that are scored|of any length|Points along|unit vectors?|"
                          r"Unit vector|What is upwards|label|2: the change|Which of the viewpoints|"
                          r"indices of")
NUMBER = re.compile(r"\b(float|int)\b")
UNIT = re.compile(r"\[[^\]]*\]|unit: \S|\([-\d]+, \d+\)")


def methods_of(one):
    """Public methods and properties that a class and its bases in the package define."""
    for name, value in inspect.getmembers(one):
        if name.startswith("_"):
            continue
        function = value.fget if isinstance(value, property) else value
        if inspect.isroutine(function) and function.__module__.startswith("limpid") and \
                name not in INTERNAL:
            yield f"{one.__name__}.{name}", function


def sections(docstring):
    """Entries of the sections of a docstring, {section: {name: (type, text)}}."""
    found = {}
    parts = re.split(r"^([A-Z]\w+)\n-+\n", inspect.cleandoc(docstring), flags=re.MULTILINE)
    for name, text in zip(parts[1::2], parts[2::2]):
        entries = re.findall(r"^(\S[^\n]*)\n((?:    [^\n]*\n?|\n)*)", text, re.MULTILINE)
        found[name] = {head.partition(" : ")[0]: (head.partition(" : ")[2], " ".join(body.split()))
                       for head, body in entries}
    return found


class TestNames(unittest.TestCase):
    def test_all_has_what_there_is(self):
        self.assertEqual(sorted(limpid.__all__), limpid.__all__)
        self.assertEqual({*limpid.__all__}, {"__version__", *(
            one.__name__ for one in (*FUNCTIONS, *CLASSES))})
        for name in limpid.__all__:
            self.assertTrue(hasattr(limpid, name), name)

    def test_the_package_is_typed(self):
        for name in ("py.typed", "_core.pyi"):
            self.assertTrue((PACKAGE / name).is_file(), name)
        self.assertIn("def optimize(", (PACKAGE / "_core.pyi").read_text(encoding="utf-8"))


class TestAnnotations(unittest.TestCase):
    def test_every_public_function_has_all(self):
        for name, function in [(one.__name__, one) for one in FUNCTIONS] + [
                pair for one in CLASSES for pair in methods_of(one)]:
            signature = inspect.signature(function)
            self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
            for parameter in list(signature.parameters.values()):
                if parameter.name not in ("self", "cls"):
                    self.assertIsNot(parameter.annotation, inspect.Parameter.empty,
                                     f"{name}: {parameter.name}")

    def test_every_attribute_has_one(self):
        for one in filter(dataclasses.is_dataclass, CLASSES):
            self.assertEqual({field.name for field in dataclasses.fields(one)} -
                             set(one.__annotations__), set())


class TestDocstrings(unittest.TestCase):
    def test_every_parameter_is_documented_as_the_signature_has_it(self):
        for name, function in [(one.__name__, one) for one in FUNCTIONS] + [
                pair for one in CLASSES for pair in methods_of(one)]:
            known = sections(function.__doc__)
            parameters = {key: value for key, value in inspect.signature(function).parameters.items()
                          if key not in ("self", "cls")}
            wanted = [{inspect.Parameter.VAR_KEYWORD: "**"}.get(value.kind, "") + key
                      for key, value in parameters.items()]
            self.assertEqual(list(known.get("Parameters", {})), wanted, name)
            isproperty = name == "Camera.cpos" or name == "Viewpoint.cpos"
            if inspect.signature(function).return_annotation != "None" and not isproperty:
                self.assertIn("Returns", known, name)
            for key, (_, text) in known.get("Parameters", {}).items():
                self.assertTrue(text.endswith("."), f"{name}: {key}: {text}")

    def test_every_attribute_is_documented(self):
        for one in filter(dataclasses.is_dataclass, CLASSES):
            known = sections(one.__doc__)
            entries = known.get("Attributes") or known["Parameters"]
            self.assertEqual(list(entries), [field.name for field in dataclasses.fields(one)],
                             one.__name__)

    def test_every_number_has_a_unit(self):
        without = []
        for one in (*FUNCTIONS, *CLASSES, *(function for each in CLASSES
                                           for _, function in methods_of(each))):
            for section in ("Parameters", "Attributes"):
                for key, (kind, text) in sections(one.__doc__).get(section, {}).items():
                    if NUMBER.search(kind) and not UNIT.search(text) and \
                            not WITHOUT_UNIT.search(text):
                        without.append(f"{one.__qualname__}: {key}: {text}")
        self.assertFalse(without, "\n".join(["These numbers have no unit."] + without))

    def test_settings_say_defaults_ranges_and_units(self):
        entries = sections(limpid.Settings.__doc__)["Parameters"]
        for field in dataclasses.fields(limpid.Settings):
            kind, text = entries[field.name]
            default = kind.rpartition("default ")[2]
            self.assertEqual(eval(default, {}), field.default, field.name)
            if isinstance(field.default, (int, float, tuple)) and \
                    not isinstance(field.default, bool):
                self.assertRegex(text, r"Range [\[(].*[\])], (unit: .+|dimensionless)\.$",
                                 field.name)


class TestMetadata(unittest.TestCase):
    def setUp(self):
        try:
            self.metadata = importlib.metadata.metadata("limpid")
        except importlib.metadata.PackageNotFoundError:
            self.skipTest("limpid is not installed as a distribution.")

    def test_is_whole(self):
        for name in ("Summary", "License-Expression", "License-File", "Keywords", "Project-URL",
                     "Classifier", "Requires-Python", "Description-Content-Type"):
            self.assertTrue(self.metadata.get_all(name), name)
        self.assertEqual(self.metadata["Version"], limpid.__version__)
        self.assertIn("Limpid developers", self.metadata["Author"] or self.metadata["Author-email"])
        self.assertIn("Typing :: Typed", self.metadata.get_all("Classifier"))

    def test_the_licence_is_in_it(self):
        files = [str(file) for file in importlib.metadata.files("limpid")]
        self.assertEqual(len([file for file in files if file.endswith("licenses/LICENSE")]), 1, files)


@unittest.skipIf(importlib.util.find_spec("mypy") is None, "mypy is not installed: types are not "
                 "checked")
class TestTypes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        # The types of PyVista and VTK take a minute, and no example has them.
        (cls.folder / "mypy.ini").write_text("[mypy]\nstrict = True\n"
                                             "[mypy-pyvista.*]\nfollow_imports = skip\n")

    def check(self, *arguments):
        run = subprocess.run([sys.executable, "-m", "mypy", *map(str, arguments)], cwd=self.folder,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return run.returncode, run.stdout

    def test_the_example_is_right(self):
        self.assertEqual(self.check(EXAMPLES / "python_package.py"),
                         (0, "Success: no issues found in 1 source file\n"))

    def test_mistakes_are_found(self):
        wrong = self.folder / "wrong.py"
        wrong.write_text("import limpid\nlimpid.optimize(mode='both')\n"
                         "limpid.Camera(position=3, focal_point=(0, 0, 0))\n", encoding="utf-8")
        code, said = self.check(wrong)
        self.assertEqual(code, 1)
        self.assertIn('wrong.py:2: error: Argument "mode"', said)
        self.assertIn('wrong.py:3: error: Argument "position"', said)


if __name__ == "__main__":
    unittest.main()
