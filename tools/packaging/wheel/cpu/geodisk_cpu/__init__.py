"""The Vulkan loader and a Vulkan driver that runs on the CPU. geodisk finds them here."""

import os

_HERE = os.path.dirname(os.path.abspath(__file__))
LOADER = os.path.join(_HERE, "libvulkan.so.1")
DRIVER = os.path.join(_HERE, "driver.json")
