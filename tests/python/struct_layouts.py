"""Writes a C program that prints the layout of every struct of some headers.

usage: struct_layouts.py HEADER... > PROGRAM.c
The program prints a line STRUCT SIZE for each struct, and then STRUCT FIELD OFFSET SIZE for each field of it.
"""

import pathlib
import re
import sys

STRUCT = re.compile(r"\bstruct\s+(\w+)\s*\{([^{}]*)\}")
#: The last name of a declaration, before the sizes of an array or the parameters of a function.
FIELD = re.compile(r"\(\s*\*\s*(\w+)\s*\)|(\w+)\s*(?:\[[^]]*\]\s*)*$")


def fields(body):
    """Returns the names of the fields of a struct, one for each declaration."""
    for declaration in filter(None, map(str.strip, body.split(";"))):
        function, value = FIELD.search(declaration).groups()
        yield function or value


def structs(header):
    """Returns name and body of each struct of a header."""
    return STRUCT.findall(re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL))


def main():
    headers = [pathlib.Path(name) for name in sys.argv[1:]]
    print("#include <stddef.h>\n#include <stdio.h>\n")
    print(*(f'#include "{header.name}"' for header in headers), sep="\n")
    print("\nint main(void) {")
    for header in headers:
        for struct, body in structs(header.read_text(encoding="utf-8")):
            print(f'    printf("{struct} %zu\\n", sizeof(struct {struct}));')
            for field in fields(body):
                print(
                    f'    printf("{struct} {field} %zu %zu\\n", offsetof(struct {struct}, {field}),'
                    f" sizeof(((struct {struct} *)0)->{field}));"
                )
    print("    return 0;\n}")


if __name__ == "__main__":
    main()
