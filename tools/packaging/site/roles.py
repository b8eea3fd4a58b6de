"""Links for the roles of docstrings, such as :class:`Mesh`, which Markdown does not know."""

import re
from typing import Any

import griffe

ROLE = re.compile(r":(?:class|func|meth):`([\w.]+)`")


class Roles(griffe.Extension):
    def on_instance(self, *, obj: griffe.Object, **kwargs: Any) -> None:
        if obj.docstring:
            obj.docstring.value = ROLE.sub(r"[`\1`][geodisk.\1]", obj.docstring.value)
