"""Makes the site of pages that lie in the whole repository, so that links among them hold there as on GitHub."""

import logging
import os
import re
from pathlib import Path, PurePosixPath

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.nav import Link, Navigation, Section
from mkdocs.structure.pages import Page
from pygments.formatters import HtmlFormatter

ROOT = Path(__file__).parents[3]
DOXYGEN = ROOT / "build/reference/html"
STYLES = Path(__file__).with_name("site.css")
LINK = re.compile(r"\]\(([^)#:\s]+)(#[^)\s]*)?\)")
# Places on the site that do not follow from the path in the repository.
PLACES = {
    "README.md": ".",
    "host/docs/README.md": "pages",
    "tools/packaging/site/python.md": "reference/python",
}
log = logging.getLogger("mkdocs.hooks.geodisk")  # In strict mode, a warning fails the build.


def paths_of(nav: list | dict | str) -> list[str]:
    """Returns the paths of pages in the navigation."""
    if isinstance(nav, str):
        return [nav]
    parts = nav.values() if isinstance(nav, dict) else nav
    return [path for part in parts for path in paths_of(part)]


def place_of(path: str) -> str:
    """Returns the place on the site of a file of the repository."""
    place = re.sub(r"^(host/docs|tools|\.github)/", "", path)
    if not path.endswith(".md"):
        return place
    folder = PLACES.get(path, place.removesuffix(".md").removesuffix("/README").lower())
    return str(PurePosixPath(folder, "index.html"))


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Returns all of host/docs, the other pages of the navigation, those of Doxygen, and its styles."""
    theme = [file for file in files if file.src_dir != config.docs_dir]
    docs = Path(config.docs_dir)
    inside = [path.relative_to(ROOT).as_posix() for path in docs.rglob("*") if path.is_file()]
    site = [
        File(path, str(ROOT), config.site_dir, config.use_directory_urls, dest_uri=place_of(path))
        for path in sorted({*inside, *paths_of(config.nav)})
    ]
    made = [
        File.generated(config, f"reference/cpp/{path.relative_to(DOXYGEN).as_posix()}", abs_src_path=str(path))
        for path in DOXYGEN.rglob("*")
        if path.is_file()
    ]
    tables = File.generated(config, "site.css", abs_src_path=str(STYLES))
    colours = File.generated(config, "code.css", content=HtmlFormatter().get_style_defs(".highlight"))
    return Files([*theme, *site, *made, tables, colours])


def on_nav(nav: Navigation, config: MkDocsConfig, files: Files) -> None:
    """Adds Doxygen's pages, which are no pages of MkDocs."""
    reference = next(item for item in nav.items if isinstance(item, Section) and item.title == "Reference")
    reference.children.insert(1, Link("C and C++", "reference/cpp/index.html"))


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Lets links to files that are not on the site lead to the repository."""

    def to_repository(link: re.Match) -> str:
        path = os.path.normpath(os.path.join(os.path.dirname(page.file.src_uri), link[1]))
        if files.get_file_from_path(path):
            return link[0]
        if not (ROOT / path).exists():
            log.warning(f"{page.file.src_uri} links to {link[1]}, which does not exist")
        kind = "tree" if (ROOT / path).is_dir() else "blob"
        return f"]({config.repo_url}/{kind}/main/{path}{link[2] or ''})"

    return LINK.sub(to_repository, markdown)
