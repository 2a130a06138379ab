# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the recipes of other packagers have versions and options that CMake and the Python project
have, and whether Spack's give the options that their variants stand for."""

import pathlib
import re
import sys
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "Plugin" / "Packaging"
CONDA = sorted((PACKAGING / "conda-forge").glob("*/recipe.yaml"))
SPACK = PACKAGING / "spack" / "spack_repo" / "limpid" / "packages"


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def cmake():
    """All that CMake reads of this project, without the tests."""
    files = [ROOT / "CMakeLists.txt", *(ROOT / "Plugin").rglob("CMakeLists.txt"),
             *(ROOT / "Plugin" / "cmake").glob("*.cmake")]
    return "\n".join(path.read_text(encoding="utf-8") for path in files)


def options_of_cmake():
    return set(re.findall(r"(?:option|set)\s*\((LIMPID_\w+)", cmake())) | set(
        re.findall(r"cmake_dependent_option\s*\((LIMPID_\w+)", cmake()))


def needed(program):
    """The lowest version of a package that the Python project names."""
    return re.search(program + r">=([0-9.]+)", text("Plugin/Wheel/pyproject.toml")).group(1)


class Spec:
    """A package of Spack with some variants."""

    def __init__(self, *variants):
        self.variants = variants

    def satisfies(self, condition):
        return condition in self.variants

    def __getitem__(self, name):
        return types.SimpleNamespace(package=types.SimpleNamespace(platlib="lib/python/site-packages"))


class Package:
    """What a package inherits of Spack, as far as its options go."""

    def __init__(self, *variants):
        self.spec = Spec(*variants)
        self.builder = types.SimpleNamespace(
            define_cuda_architectures=lambda package: "-DCMAKE_CUDA_ARCHITECTURES=90")

    @staticmethod
    def define(name, value):
        return f"-D{name}={'ON' if value else 'OFF'}" if isinstance(value, bool) else f"-D{name}={value}"

    def define_from_variant(self, name, variant):
        return self.define(name, self.spec.satisfies(f"+{variant}"))


class Directives:
    """In place of Spack's: writes down which directives were called, with what."""

    def __init__(self):
        self.called = []

    def __getattr__(self, name):
        def directive(*arguments, **options):
            self.called.append((name, arguments, options))
            return lambda function: function
        return directive


def load(name):
    """The class of a package, and the directives that its body called."""
    directives = Directives()
    names = ("license", "version", "variant", "conflicts", "depends_on", "generator", "extends",
             "run_after", "on_package_attributes")
    spack = types.ModuleType("spack.package")
    vars(spack).update({each: getattr(directives, each) for each in names})
    modules = {"spack": types.ModuleType("spack"), "spack.package": spack}
    for kind, bases in (("cmake", ["CMakePackage"]), ("cuda", ["CudaPackage"]), ("python", ["PythonPackage"])):
        module = types.ModuleType(f"spack_repo.builtin.build_systems.{kind}")
        vars(module).update({base: type(base, (Package,) if kind != "cuda" else (), {}) for base in bases})
        vars(module)["generator"] = directives.generator
        modules[module.__name__] = module
    modules |= {each: types.ModuleType(each) for each in (
        "spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems")}
    before = dict(sys.modules)
    sys.modules.update(modules)
    try:
        namespace = {}
        exec(compile((SPACK / name / "package.py").read_text(encoding="utf-8"), name, "exec"), namespace)
    finally:
        for each in modules:
            sys.modules.pop(each)
        sys.modules.update(before)
    class_name = "".join(part.capitalize() for part in name.split("_"))
    return namespace[class_name], directives.called


class TestConda(unittest.TestCase):
    def test_have_the_version_of_the_project(self):
        version = re.search(r"project\(Limpid\s+VERSION ([0-9.]+)", text("CMakeLists.txt")).group(1)
        self.assertEqual(len(CONDA), 3)
        for path in CONDA:
            self.assertIn(f'version: "{version}"', path.read_text(encoding="utf-8"), path)

    def test_have_options_of_cmake(self):
        for path in CONDA:
            used = set(re.findall(r"-D(LIMPID_\w+)", path.read_text(encoding="utf-8")))
            self.assertLessEqual(used, options_of_cmake(), path)

    def test_want_what_the_project_wants(self):
        oldest = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)", text("CMakeLists.txt")).group(1)
        for path in CONDA:
            self.assertIn(f"cmake >={oldest}", path.read_text(encoding="utf-8"), path)
        recipe = text("Plugin/Packaging/conda-forge/limpid/recipe.yaml")
        for program in ("scikit-build-core", "nanobind", "numpy"):
            self.assertIn(f"{program} >={needed(program)}", recipe)

    def test_files_that_they_name_exist(self):
        for path in CONDA:
            for name in re.findall(r"Plugin/Packaging/\w+\.py", path.read_text(encoding="utf-8")):
                self.assertTrue((ROOT / name).is_file(), f"{path} names {name}")


class TestSpack(unittest.TestCase):
    def arguments(self, *variants):
        package, _ = load("limpid")
        return dict(argument[2:].split("=", 1) for argument in package(*variants).cmake_args())

    def test_has_options_of_cmake(self):
        used = {name for name in self.arguments("+vtk", "+cuda") if name.startswith("LIMPID_")}
        self.assertLessEqual(used, options_of_cmake())

    def test_variants_choose_what_is_built(self):
        for variants, vtk, paraview in ((["+paraview"], "ON", "ON"), (["+vtk"], "ON", "OFF"), ([], "OFF", "OFF")):
            with self.subTest(variants):
                arguments = self.arguments(*variants)
                self.assertEqual(arguments["LIMPID_ENABLE_VTK"], vtk)
                self.assertEqual(arguments["LIMPID_ENABLE_PARAVIEW"], paraview)
                self.assertEqual(arguments["LIMPID_ENABLE_CUDA"], "OFF")
        self.assertEqual(self.arguments("+paraview", "+cuda")["LIMPID_ENABLE_CUDA"], "ON")
        self.assertEqual(self.arguments("+paraview", "+gui")["LIMPID_ENABLE_GUI"], "ON")

    def test_wants_what_the_project_wants(self):
        oldest = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)", text("CMakeLists.txt")).group(1)
        versions = dict(re.findall(r"find_package\((ParaView|VTK) ([0-9.]+)", cmake()))
        wanted = {name: [arguments[0] for called, arguments, _ in load(name)[1] if called == "depends_on"]
                  for name in ("limpid", "py_limpid")}

        self.assertIn(f"cmake@{oldest}:", wanted["limpid"])
        self.assertIn(f"paraview@{versions['ParaView']}: +python", wanted["limpid"])
        self.assertIn(f"vtk@{versions['VTK']}: +python", wanted["limpid"])
        for program in ("scikit-build-core", "nanobind", "numpy"):
            self.assertIn(f"py-{program}@{needed(program)}:", wanted["py_limpid"])


if __name__ == "__main__":
    unittest.main()
