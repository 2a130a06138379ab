# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Builds the recipes for conda-forge by rattler-build and runs the tests that stand in them.

    python build_conda.py FOLDER [RECIPE]...

Needs py-rattler-build, pip, and what Testing/install-packages.sh installs. The recipes want packages
of a channel; here they get stand-ins in FOLDER/channel, which lead to what Debian has installed: an
environment of Debian's Python, compilers by their names, and files of PyPI's packages. So the recipes
are parsed, solved, built, packed and tested as on another machine, but names and contents of the
channel's packages are not tried. What was built is in FOLDER/output.
"""

import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import rattler_build

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPES = ROOT / "Plugin" / "Packaging" / "conda-forge"
PYTHON = "/usr/bin/python3"
SITE = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
EMPTY = ("cmake", "ninja", "glm", "tbb-devel", "zlib", "libgl-devel", "libegl-devel", "qt6-main",
         "gcc_linux-64", "sysroot_linux-64")
#: Stand-ins with the contents of wheels.
WHEELS = ("pip", "numpy", "scikit-build-core", "nanobind")
ACTIVATE = """
export CC=/usr/bin/gcc CXX=/usr/bin/g++
export CMAKE_ARGS="-DCMAKE_INSTALL_PREFIX=$PREFIX -DCMAKE_INSTALL_LIBDIR=lib {launcher}"
"""


def printed_by(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout.strip()


def upstream_version(package):
    """Of a package of Debian, or 0."""
    found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], check=False, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    version = found.split(":")[-1].split("+")[0].split("-")[0].split("~")[0]
    return version or "0"


def vtk_folder():
    """Of the CMake files of Debian's VTK, which may be within ParaView."""
    return pathlib.Path(printed_by("bash", str(ROOT / "Testing" / "vtk-folder.sh")))


def vtk_version():
    text = next(vtk_folder().glob("*-config-version.cmake")).read_text(encoding="utf-8")
    return text.split('PACKAGE_VERSION "')[1].split('"')[0]


def minor(version):
    return ".".join(version.split(".")[:2])


class Channel:
    """A folder of packages that stand for others."""

    def __init__(self, folder):
        self.folder = folder / "channel"
        self.staged = folder / "staged"
        for used in (self.folder, self.staged):
            shutil.rmtree(used, ignore_errors=True)
        self.packages = {}

    def add(self, name, version="99", depends=(), files=()):
        """A package with the contents of files, by their paths in it."""
        content = self.staged / name
        (content / "share" / "stand-ins").mkdir(parents=True, exist_ok=True)
        (content / "share" / "stand-ins" / name).write_text(version)
        for path, text in dict(files).items():
            (content / path).parent.mkdir(parents=True, exist_ok=True)
            (content / path).write_text(text)
        self.pack(name, version, depends)

    def pack(self, name, version, depends=()):
        made = rattler_build.assemble_package(
            name, version, "linux-64", "0", self.folder / "linux-64", files_dir=self.staged / name,
            depends=list(depends), compression_level=1)
        content = pathlib.Path(made.path).read_bytes()
        self.packages[pathlib.Path(made.path).name] = {
            "name": name, "version": version, "build": "0", "build_number": 0,
            "depends": list(depends), "subdir": "linux-64", "size": len(content),
            "sha256": hashlib.sha256(content).hexdigest()}

    def add_python(self, version):
        """A virtual environment at the prefix, wherever that is."""
        programs = self.staged / "python" / "bin"
        programs.mkdir(parents=True)
        for name in ("python", "python3"):
            (programs / name).symlink_to(PYTHON)
        self.add("python", version, files={
            "pyvenv.cfg": f"home = /usr/bin\nversion = {version}\n", f"{SITE}/README.txt": ""})

    def add_wheel(self, name):
        """What pip would install, without what that depends on."""
        wheels = self.staged / "wheels" / name
        subprocess.run([sys.executable, "-m", "pip", "download", "--quiet", "--dest", wheels, name,
                        *(["--no-deps"] if name == "numpy" else [])], check=True)
        for wheel in wheels.glob("*.whl"):
            with zipfile.ZipFile(wheel) as archive:
                archive.extractall(self.staged / name / SITE)
        found, = wheels.glob(f"{name.replace('-', '_')}-*.whl")
        self.pack(name, found.name.split("-")[1], ["python"])

    def index(self):
        """Writes what the solver reads."""
        for platform, packages in (("linux-64", self.packages), ("noarch", {})):
            (self.folder / platform).mkdir(exist_ok=True)
            (self.folder / platform / "repodata.json").write_text(json.dumps({
                "info": {"subdir": platform}, "packages": {}, "packages.conda": packages}))


def make_channel(folder):
    channel = Channel(folder)
    for name in EMPTY:
        channel.add(name)
    launcher = ""
    if shutil.which("ccache") and "CCACHE_DIR" in os.environ:
        launcher = "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"
    activate = ACTIVATE.format(launcher=launcher)
    if launcher:
        activate += f"export CCACHE_DIR={os.environ['CCACHE_DIR']} CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$SRC_DIR\n"
    channel.add("gxx_linux-64", files={"etc/conda/activate.d/gxx.sh": activate})
    channel.add_python(printed_by(PYTHON, "-c", "import platform; print(platform.python_version())"))
    for name in WHEELS:
        channel.add_wheel(name)
    channel.add("paraview", upstream_version("paraview"))
    channel.add("vtk", vtk_version(), ["python"], {
        f"{SITE}/debian.pth": "/usr/lib/python3/dist-packages\n",
        "etc/conda/activate.d/vtk.sh": f"export VTK_DIR={vtk_folder()}\n"})
    channel.index()
    return channel


def variants():
    return rattler_build.VariantConfig({
        "c_compiler": ["gcc"], "cxx_compiler": ["gxx"], "c_stdlib": ["sysroot"],
        "python": [minor(printed_by(PYTHON, "-c", "import platform; print(platform.python_version())"))],
        "paraview": [minor(upstream_version("paraview"))], "vtk": [minor(vtk_version())]})


def build(name, channel, folder):
    recipe = rattler_build.Stage0Recipe.from_file(RECIPES / name / "recipe.yaml")
    rendered, = recipe.render(variants())
    result = rendered.run_build(
        rattler_build.ToolConfiguration(test_strategy="native"), output_dir=folder / "output", no_build_id=True,
        channels=[channel.folder.as_uri()])
    print(f"{name}: built and tested {[path.name for path in map(pathlib.Path, result.packages)]}")


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    names = sys.argv[2:] or sorted(path.parent.name for path in RECIPES.glob("*/recipe.yaml"))
    channel = make_channel(folder)
    for name in names:
        build(name, channel, folder)


if __name__ == "__main__":
    main()
