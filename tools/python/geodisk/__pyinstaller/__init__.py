"""Tells PyInstaller what programs that use geodisk need. It finds this by the entry point of the package."""

import os


def hook_dirs() -> list[str]:
    return [os.path.dirname(__file__)]
