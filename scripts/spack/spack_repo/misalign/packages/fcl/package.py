from spack_repo.builtin.build_systems.generic import Package

from spack.package import *


class Fcl(Package):
    """Flexible Collision Library: only as an external, see README.md."""

    has_code = False
    version("0.7")
