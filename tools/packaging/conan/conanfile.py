"""The libraries of the checkout that this recipe lies in: conan create tools/packaging/conan"""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

ROOT = os.path.join("..", "..", "..")


class Geodisk(ConanFile):
    name = "geodisk"
    license = "MIT"
    description = "Random points on triangle meshes, no two closer than a minimum distance along the surface"
    homepage = "https://github.com/geodisk/geodisk"
    topics = ("poisson-disk", "blue-noise", "mesh", "geodesic", "vulkan")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "with_c": [True, False]}
    default_options = {"shared": False, "fPIC": True, "with_c": True}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        project = load(self, os.path.join(self.recipe_folder, ROOT, "CMakeLists.txt"))
        self.version = re.search(r"VERSION (\d+\.\d+\.\d+)", project).group(1)

    def export_sources(self):
        root = os.path.join(self.recipe_folder, ROOT)
        folders = ["host", "shaders", "tools/cmake", "tools/examples", "tools/packaging"]
        files = ["CMakeLists.txt", "LICENSE", "*.md", "kernels_ref/README.md", "tests/README.md",
                 "tools/python/README.md"]
        for pattern in [f"{folder}/*" for folder in folders] + files:
            copy(self, pattern, root, self.export_sources_folder, excludes="build/*")

    def layout(self):
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 20)

    def requirements(self):
        self.requires("vulkan-headers/[>=1.2.175]", transitive_headers=True)

    def build_requirements(self):
        self.tool_requires("glslang/[>=1.3]")

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["GEODISK_BUILD_C"] = bool(self.options.with_c)
        for part in ("TOOLS", "TESTS", "BENCH"):
            toolchain.cache_variables[f"GEODISK_BUILD_{part}"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share"))

    def package_info(self):
        # Its own CMake package has the targets: geodisk::geodisk, geodisk::context and geodisk::c.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/geodisk"]
        self.cpp_info.libs = ["geodisk_context", "geodisk_cpp"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread", "dl"]
