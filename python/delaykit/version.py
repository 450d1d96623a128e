"""Version of the package, as its metadata has it."""

from importlib import metadata

__version__ = metadata.version("delaykit")
