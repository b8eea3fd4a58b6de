"""Pages beside what they quote: programs, messages and files."""

import pathlib
import re

import pytest

SOURCE = pathlib.Path(__file__).parents[2]
GUIDES = SOURCE / "host/docs/guides.md"


def lines_of(text):
    """Lines without their indentation, since a page shows parts of functions."""
    return [line.strip() for line in text.strip().splitlines()]


def test_guides_show_their_programs():
    """Each block of code is part of the file that was named last, word for word."""
    program, shown = None, 0
    token = re.compile(r"`(tools/examples/[\w/.]+\.\w+)`|^```(\w+)\n(.*?)^```$", re.M | re.S)
    for name, language, block in token.findall(GUIDES.read_text()):
        if name:
            program = SOURCE / name
            assert program.is_file(), name
        else:
            lines, part = lines_of(program.read_text()), lines_of(block)
            places = range(len(lines) - len(part) + 1)
            assert any(lines[at : at + len(part)] == part for at in places), f"{program}:\n{block}"
            shown += 1
    assert shown >= 6


@pytest.mark.parametrize(
    "page, language, first, test",
    [
        ("embedding", "cpp", "FrameNeighbours ", "embed/test_frame_neighbours.cpp"),
        ("update", "cpp", "const PreparedMesh prepared", "gpu/test_update.cpp"),
        ("update", "c", "geodisk_error error", "c/test_update.cpp"),
    ],
)
def test_pages_show_what_tests_compile(page, language, first, test):
    """The block that begins so is part of a test, but for comments."""
    text = (SOURCE / f"host/docs/{page}.md").read_text()
    block = re.search(rf"^```{language}\n({first}.*?)^```$", text, re.M | re.S).group(1)
    program = lines_of((SOURCE / "tests" / test).read_text())
    shown = [line for line in lines_of(block) if not line.startswith(("//", "/*")) and line]
    assert len(shown) >= 3 and [line for line in shown if line not in program] == []


def test_embedding_names_what_is_installed():
    """Headers, targets, pkg-config files and examples; no other files of the sources."""
    page = (SOURCE / "host/docs/embedding.md").read_text()
    prose = re.sub(r"^```.*?^```$", "", page, flags=re.M | re.S)
    quoted = [name.strip("<>") for name in re.findall(r"`([^`]*)`", prose)]
    headers = {name for name in quoted if re.fullmatch(r"geodisk/[\w/]+\.(hpp|h)", name)}
    places = {"geodisk/shaders": SOURCE / "shaders/shared", "geodisk": SOURCE / "host/include/geodisk"}
    for header in sorted(headers):
        folder, name = header.rsplit("/", 1)
        assert (places[folder] / name).is_file(), header
    examples = {name for name in quoted if re.fullmatch(r"(engine|record|paint)(/[\w.]+)?", name)}
    for name in sorted(examples):
        assert (SOURCE / "tools/examples" / name).exists(), name
    assert len(headers) > 5 and len(examples) > 4
    files = [name for name in quoted if re.match(r"(tools|tests|host|kernels_ref|shaders)/", name)]
    assert files == ["tools/examples/"]
    targets = {name for name in quoted if name in ("geodisk::geodisk", "geodisk::context", "geodisk::c")}
    exported = (SOURCE / "host/CMakeLists.txt").read_text()
    assert targets and all(f"add_library({target} ALIAS " in exported for target in targets)


def test_every_guide_is_told_of():
    page = GUIDES.read_text()
    for program in (SOURCE / "tools/examples/guides").iterdir():
        assert f"`tools/examples/guides/{program.name}`" in page, program.name
    for notebook in (SOURCE / "tools/examples/notebooks").glob("*.ipynb"):
        assert f"| `{notebook.name}` |" in page, notebook.name


def test_public_names_are_stable_or_experimental():
    """Comments of functions in geodisk.h and first comments of C++ headers end with the mark."""
    include = SOURCE / "host/include/geodisk"
    comments = re.findall(r"(.*)\nGEODISK_C_API[^;]*?\b(geodisk_\w+)\(", (include / "geodisk.h").read_text())
    functions = (SOURCE / "tests/c/symbols.txt").read_text().split()
    assert sorted(name for _, name in comments) == functions
    mark = re.compile(r"\b(Stable|Experimental)\.( \*/)?$")
    assert [name for comment, name in comments if not mark.search(comment)] == []
    headers = [*include.glob("*.hpp*"), SOURCE / "host/mpi/include/geodisk/mpi.hpp"]
    assert len(headers) > 30
    firsts = {path.name: path.read_text().split("\n#pragma once")[0] for path in headers}
    assert [name for name, first in firsts.items() if not mark.search(first)] == []


def test_samplers_of_other_projects_are_there():
    """tools/bench/peers names functions of peer_samplers.py and calls them by name."""
    peers = (SOURCE / "tools/bench/peers").read_text()
    functions = re.findall(r"^def (\w+)\(mesh, count, distance, seed\):",
                           (SOURCE / "tools/bench/peer_samplers.py").read_text(), re.M)
    named = re.findall(r'^    Peer\("(\w+)"', peers, re.M)
    assert len(named) >= 8 and sorted(named) == sorted(functions)


def pages():
    folders = (".github", "host", "kernels_ref", "shaders", "tests", "tools")
    return [*SOURCE.glob("*.md"), *(page for name in folders for page in (SOURCE / name).rglob("*.md"))]


def anchors_of(page):
    """Anchors of the headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.M)
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower() for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading).replace(" ", "-") for heading in plain}


def test_links_lead_somewhere():
    checked = 0
    for page in pages():
        for target, anchor in re.findall(r"\]\(([^)#:\s]*)(?:#([^)\s]+))?\)", page.read_text()):
            there = (page.parent / target).resolve() if target else page
            assert there.exists(), f"{page.name} links to {target}"
            if anchor and there.suffix == ".md":
                assert anchor in anchors_of(there), f"{page.name} links to {target}#{anchor}"
            checked += 1
    assert checked > 50


def literals_of(path):
    """What is in quotes, with literals that follow each other in one piece."""
    text = path.read_text(errors="replace").replace(r"\"", "'")
    return "\n".join(re.findall(r'"([^"\n]*)"', re.sub(r'"\s*f?"', "", text)))


def test_messages_of_troubleshooting_exist():
    """Each message of the page is in one source file, part by part between its omissions."""
    endings = {".cpp", ".hpp", ".py", ".cmake", ".txt"}
    folders = ("host/src", "tools")
    sources = [
        literals_of(path)
        for folder in folders
        for path in (SOURCE / folder).rglob("*")
        if path.suffix in endings
    ]
    page = (SOURCE / "host/docs/troubleshooting.md").read_text()
    messages = re.findall(r"^\| `([^`]+)` \|", page, re.M)
    assert len(messages) > 40
    gone = []
    for message in messages:
        parts = [part.strip() for part in message.split("…")]
        assert max(map(len, parts)) >= 10, f"too little to look for: {message}"
        if not any(all(part in source for part in parts) for source in sources):
            gone.append(message)
    assert gone == []


def test_tests_of_reliability_exist():
    """Each test and file that the last column names."""
    tests = list((SOURCE / "tests").rglob("*.cpp"))
    rows = re.findall(r"^\|.*\| ([^|]*) \|$", (SOURCE / "host/docs/reliability.md").read_text(), re.M)
    named = re.findall(r'"([^"]+)"', "\n".join(rows))
    files = re.findall(r"\btest_\w+\.cpp\b", "\n".join(rows))
    assert len(named) > 20 and len(files) > 10
    case = re.compile(r'TEST_CASE(?:_FIXTURE\([^"]*|\()"((?:[^"\\]|\\.)*)"')
    cases = [name for path in tests for name in case.findall(path.read_text())]
    gone = [name for name in named if not any(c.startswith(name.removesuffix(" ...")) for c in cases)]
    assert gone + [name for name in files if all(path.name != name for path in tests)] == []


def test_exclusions_are_those_of_the_library():
    """The last table of the page has the rules, in their order."""
    source = (SOURCE / "host/src/engine/request/request_rules.cpp").read_text()
    rules = re.findall(r'\{Field::(\w+), Field::(\w+),\s*"([^"]+)"\}', source)
    page = (SOURCE / "host/docs/exclusions.md").read_text()
    table = page.rpartition("|---|---|---|\n")[2]
    assert len(rules) > 30
    assert table == "".join(f"| `{a}` | `{b}` | {why} |\n" for a, b, why in rules)


def test_formats_are_those_of_the_program():
    """The first table of the page has a row of each format, and says how it reads back."""
    source = (SOURCE / "tools/files/samples/sample_format.cpp").read_text()
    rows = re.findall(r'^    \{"(\w+)", k(\w+), .*, (\w+)\},?$', source, re.M)
    page = (SOURCE / "host/docs/formats.md").read_text()
    table = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| .* \| ([\w ]+) \|$", page, re.M)
    stated = {name: read for names, read in table for name in re.findall(r"\w+", names)}
    whole = {True: "yes", False: "the points"}
    assert len(rows) >= 9
    assert stated == {
        name: "no" if reader == "nullptr" else whole[content == "Columns"]
        for name, content, reader in rows
    }
