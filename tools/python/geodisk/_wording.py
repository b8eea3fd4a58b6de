"""Messages of the library and the program, in words of this package."""

from __future__ import annotations

import re

# Options of the program that functions of this package have as parameters.
_PARAMETERS = {
    option: option.replace("-", "_")
    for option in (
        "allow-outside attributes avoid background columns count cut darts density device edge-lengths face-keys keep-seams mesh-format "
        "metric min-distance tolerance pool-ratio radius radius-factor seed size stop-count style up view weld"
    ).split()
}
# With the suffix of the options of two meshes. Not within the name of a file.
_OPTION = re.compile(r"(?<![^\s(])--([a-z]+(?:-[a-z]+)*?)(?:-[ab])?(?![\w./-])")


def in_python(message: str) -> str:
    """Returns the message with the parameters that are meant by options, and by fields of C.

    Leaves out advice on options that no function has.
    """
    message = re.sub(r" \(see geodisk \w+ --help\)", "", message)
    message = re.sub(r"\b(?:params|request)->", "", message)
    said, *advice = message.split("; ")
    kept = [said, *(clause for clause in advice if set(_OPTION.findall(clause)) <= _PARAMETERS.keys())]

    def parameter(option: re.Match[str]) -> str:
        return _PARAMETERS.get(option[1], option[1].replace("-", "_"))

    return _OPTION.sub(parameter, "; ".join(kept))
