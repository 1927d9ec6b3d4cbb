from spack_repo.builtin.build_systems.generic import Package

from spack.package import *


class Sqlitecpp(Package):
    """SQLite in C++: only as an external, see README.md."""

    has_code = False
    version("3.2")
