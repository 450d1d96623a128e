# SPDX-License-Identifier: BSD-3-Clause
"""Version of the package, as its metadata has it."""

from importlib import metadata

__version__ = metadata.version("delaykit")
