# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid for Spack: the plugin for ParaView, or the VTK modules.

    spack repo add Plugin/Packaging/spack/spack_repo/limpid
    spack install limpid                      # the plugin for ParaView
    spack install limpid ~paraview +vtk       # classes for VTK, with Python
    spack install limpid ~paraview            # the core alone
    spack install limpid +cuda cuda_arch=90

A release has no archive yet. Until then, `spack dev-build limpid@main` builds a checkout, or set `git`
to where the repository is. How far it was tried is in Plugin/Packaging/README.md.
"""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator
from spack_repo.builtin.build_systems.cuda import CudaPackage

from spack.package import *


class Limpid(CMakePackage, CudaPackage):
    """Extinction optimization for ParaView and VTK: makes transparent what hides the important
    structures of a volume, for the camera and the light."""

    license("BSD-3-Clause")

    version("main", branch="main")

    variant("paraview", default=True, description="Build the ParaView plugin")
    variant("vtk", default=False, description="Build the VTK modules, with Python wrapping")
    variant("gui", default=False, when="+paraview", description="Build the part for ParaView's window")
    conflicts("+vtk", when="+paraview", msg="One build makes the plugin or the VTK modules: ~paraview +vtk")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("python@3.8:", type="build")
    generator("ninja")

    depends_on("glm")
    depends_on("tbb")
    depends_on("zlib-api")
    depends_on("paraview@5.11: +python", when="+paraview")
    depends_on("paraview +qt", when="+gui")
    depends_on("vtk@9.2: +python", when="+vtk")
    depends_on("python@3", when="+vtk", type=("build", "link", "run"))
    extends("python", when="+vtk")

    def cmake_args(self):
        args = [
            self.define("LIMPID_BUILD_TESTING", False),
            self.define("LIMPID_WARNINGS_AS_ERRORS", False),
            self.define("LIMPID_ENABLE_VTK",
                        self.spec.satisfies("+paraview") or self.spec.satisfies("+vtk")),
            self.define_from_variant("LIMPID_ENABLE_PARAVIEW", "paraview"),
            self.define_from_variant("LIMPID_ENABLE_GUI", "gui"),
            self.define_from_variant("LIMPID_ENABLE_CUDA", "cuda"),
        ]
        if self.spec.satisfies("+vtk"):
            # Spack's own folder, which `extends` puts on PYTHONPATH.
            args.append(self.define("LIMPID_PYTHON_DESTINATION", python_platlib_of(self)))
        if self.spec.satisfies("+cuda"):
            args.append(self.builder.define_cuda_architectures(self))
        return args

    def plugin_folder(self, name):
        version = self.spec["paraview"].version.up_to(2)
        return join_path(self.prefix.lib, f"paraview-{version}", "plugins", name)

    def setup_run_environment(self, env):
        # ParaView looks into each folder of this variable for plugins of the folder's name.
        if self.spec.satisfies("+paraview"):
            for name in ("Limpid", "LimpidGui"):
                env.append_path("PV_PLUGIN_PATH", self.plugin_folder(name))

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        """Optimises a phantom by what was installed, and looks whether more of it can be seen."""
        scripts = join_path(self.stage.source_path, "Plugin", "Packaging")
        if self.spec.satisfies("+paraview"):
            plugin = join_path(self.plugin_folder("Limpid"), "Limpid.so")
            pvpython = Executable(join_path(self.spec["paraview"].prefix.bin, "pvpython"))
            pvpython(join_path(scripts, "test_plugin.py"), plugin)
        if self.spec.satisfies("+vtk"):
            self.spec["python"].command(join_path(scripts, "test_modules.py"), extra_env={
                "PYTHONPATH": join_path(self.prefix, python_platlib_of(self))})


def python_platlib_of(package):
    """The folder below the prefix for modules of Python."""
    return package.spec["python"].package.platlib
