from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Misalign(CMakePackage):
    """Finds origami that simple springs deploy: draws random shifts of the vertices of a perforated rigid
    origami sheet, follows the exact folding motion, and keeps what deploys in an SQLite catalogue."""

    license("MIT")

    # It has no address to be fetched from: `spack develop` names its folder.
    version("1.1.0")

    variant("report", default=True, description="Carry the page of `misalign report` (npm packages)")
    variant("python", default=False, description="Build the Python module")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("help2man", type="build")
    depends_on("node-js@18:", type="build", when="+report")
    depends_on("npm", type="build", when="+report")

    depends_on("mpi")  # `--ranks` calls Open MPI's mpirun
    depends_on("eigen@3.4:3", type=("build", "link"))
    depends_on("sqlite@3.37:")
    depends_on("nlohmann-json@3.10:")
    depends_on("fmt")
    depends_on("spdlog")
    depends_on("cli11@2.1:", type="build")
    depends_on("boost@1.74:", type="build")
    depends_on("sundials@6:+CVODE")
    depends_on("flint@3:")
    depends_on("random123", type="build")
    depends_on("xxhash")
    depends_on("xsimd@8.1:", type="build")
    depends_on("matio")
    depends_on("cpp-httplib")
    # Spack's own repository has none of these: see README.md.
    depends_on("sqlitecpp")
    depends_on("fcl")
    depends_on("dxflib")

    extends("python", when="+python")
    depends_on("py-pybind11", type="build", when="+python")
    depends_on("py-numpy", type=("build", "run"), when="+python")

    def cmake_args(self):
        return [
            self.define("MISALIGN_TESTS", False),
            self.define_from_variant("MISALIGN_REPORT", "report"),
            self.define_from_variant("MISALIGN_PYTHON", "python"),
        ]
