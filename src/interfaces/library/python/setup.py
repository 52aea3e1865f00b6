"""A wheel of the module and the library that CMake has built: scripts/wheel.sh puts both into passo/."""

import os

from setuptools import Distribution, setup


class BinaryDistribution(Distribution):
    """Its wheel is for one platform and one version of Python."""

    def has_ext_modules(self) -> bool:
        return True


setup(
    name="passo",
    version=os.environ["PASSO_VERSION"],
    description="Motion control for stepper-driven machines: checks G-code, plans paths, gives times and steps",
    license="Apache-2.0",
    packages=["passo"],
    package_data={"passo": ["*.so", "*.so.1", "*.pyi", "py.typed"]},
    python_requires=">=3.8",
    install_requires=["numpy"],
    distclass=BinaryDistribution,
)
