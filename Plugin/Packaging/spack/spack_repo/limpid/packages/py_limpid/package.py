# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The Python package for numpy for Spack: see limpid beside it.

    spack install py-limpid
"""

from spack_repo.builtin.build_systems.python import PythonPackage

from spack.package import *


class PyLimpid(PythonPackage):
    """Extinction optimization for numpy and PyVista: makes transparent what hides the important
    structures of a volume, for the camera and the light."""

    license("BSD-3-Clause")

    version("main", branch="main")

    build_directory = "Plugin/Wheel"

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("python@3.9:", type=("build", "link", "run"))
    depends_on("py-scikit-build-core@0.10:", type="build")
    depends_on("py-nanobind@2.4:", type="build")
    depends_on("py-numpy@1.22:", type=("build", "run"))
    depends_on("glm", type="build")
    depends_on("tbb")

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        """Optimises a small volume, and looks whether more of it can be seen."""
        python(join_path(self.stage.source_path, "Plugin", "Packaging", "test_package.py"))
