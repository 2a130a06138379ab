# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid for Spack. In a repository of packages of one's own it is packages/limpid/package.py:

    spack install limpid                      # the plugin for ParaView
    spack install limpid ~paraview +vtk       # classes for VTK, with Python
    spack install limpid +cuda cuda_arch=90

Not run: no machine that Limpid was built on so far has Spack. A release has no archive yet; until
then, set `git` to where the repository is, or build a checkout by `spack dev-build limpid@main`.
"""

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
        """Loads the plugin, optimises a phantom, and looks whether more of it can be seen."""
        if self.spec.satisfies("+paraview"):
            plugin = join_path(self.plugin_folder("Limpid"), "Limpid.so")
            script = join_path(self.stage.source_path, "Plugin", "Packaging", "test_plugin.py")
            Executable(join_path(self.spec["paraview"].prefix.bin, "pvpython"))(script, plugin)
